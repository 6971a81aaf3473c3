"""Tests of the import directions: scene <- contact_solver <- solvers <- results <- errors <-
verification <- command.

CONTRIBUTING.md states them. `LAYERS` holds the packages from the ground up: a module imports from
its own row and earlier ones only. The modules and folders of a package have no circle of imports.
"""

import ast
import re
import sys
from collections.abc import Iterator
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
# A package imports only from its own row and earlier ones, but for what FORBIDDEN says.
LAYERS = (
    ("contact_scene",),
    ("contact_solver",),
    ("semi_analytical",),
    ("fem_reference",),
    ("radial",),
    ("contact_results",),
    ("contact_errors",),
    ("verification.closed_forms", "verification.references", "verification.baselines"),
    ("verification.norms", "verification.quantities", "verification.solver"),
    ("verification.convergence", "verification.exhibits"),
    ("verification.problems", "verification.laws", "verification.observed"),
    ("verification.judging",),
    ("verification.running", "verification.regression"),
    ("verification.cases", "verification.defects", "verification.challenge"),
    ("verification.studies",),
    ("verification.report", "verification.judged_by_pytest"),
    ("verification",),
    ("slipstick",),
)
PACKAGES = tuple(dict.fromkeys(name.partition(".")[0] for row in LAYERS for name in row))

# What the modules of a package may not import from earlier rows or libraries, and exceptions.
FORBIDDEN = {
    "contact_scene": (("scipy",), ()),
    # It knows arrays and functions: a dense 4x4 matrix is as good an operator as any.
    "contact_solver": (
        ("contact_scene",),
        tuple(
            f"contact_scene.{name}" for name in ("array_types", "friction_limit", "solver_errors")
        ),
    ),
    "fem_reference": (("semi_analytical",), ()),
    # The response of layers to one wavenumber is shared.
    "radial": (("semi_analytical", "fem_reference"), ("semi_analytical.frf",)),
}


def within(name: str, *packages: str) -> bool:
    """Whether a dotted name is one of the packages or something in it."""
    return any(name == one or name.startswith(f"{one}.") for one in packages)


def module_name(path: Path, root: Path) -> str:
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def modules(root: Path) -> dict[str, Path]:
    """All modules of our packages under root, by dotted name."""
    paths = sorted(path for package in PACKAGES for path in (root / package).rglob("*.py"))
    return {module_name(path, root): path for path in paths}


def imports(path: Path, known: dict[str, Path]) -> Iterator[str]:
    """Dotted names that a module imports: anywhere in it, lazily or for its annotations only.

    Ruff admits absolute imports alone.
    """
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), filename=str(path))):
        match node:
            case ast.Import():
                yield from (alias.name for alias in node.names)
            case ast.ImportFrom(module=str() as source):
                members = (f"{source}.{alias.name}" for alias in node.names)
                yield from (member if member in known else source for member in members)
            case ast.Call(func=ast.Attribute(attr="import_module") | ast.Name(id="__import__")):
                yield from (arg.value for arg in node.args[:1] if isinstance(arg, ast.Constant))
            case ast.Constant(value=str() as text) if re.fullmatch(r"[\w.]+:\w+", text):
                yield text.partition(":")[0]  # an object that pkgutil.resolve_name imports


def layer(name: str) -> int | None:
    """Number of the row that holds a module; None for a module that is not ours."""
    return next((n for n, row in enumerate(LAYERS) if within(name, *row)), None)


def objection(name: str, target: str) -> str | None:
    """Why module `name` may not import `target`; None if it may."""
    for package, (forbidden, allowed) in FORBIDDEN.items():
        if within(name, package) and within(target, *forbidden) and not within(target, *allowed):
            return f"{name} imports {target}: {package} must not"
    if within(target, "tests", "examples"):
        return f"{name} imports {target}: nothing imports scripts"
    if within(name, "verification.closed_forms"):
        allowed = ("verification.closed_forms", "numpy", "scipy", *sys.stdlib_module_names)
        if not within(target, *allowed):
            return f"{name} imports {target}: closed forms rest on numpy and scipy alone"
    own, other = layer(name), layer(target)
    if own is not None and other is not None and other > own:
        return f"{name} imports {target}: {LAYERS[other]} stand above {LAYERS[own]}"
    if target in PACKAGES and within(name, target):
        return f"{name} imports {target}: import from the module that defines it"
    return None


def circles(imported: dict[str, list[str]], packages: set[str]) -> Iterator[str]:
    """Circles of imports between the modules and folders of packages.

    imported  imported names by the name of the module
    packages  packages whose modules and folders have no circle
    """
    for package in packages:
        graph = {}
        for name, targets in imported.items():
            if name != package and within(name, package):
                inside = [t for t in targets if t != package and within(t, package)]
                member, *others = (
                    one[len(package) + 1 :].partition(".")[0] for one in (name, *inside)
                )
                graph[member] = graph.get(member, set()) | ({*others} - {member})
        try:
            TopologicalSorter(graph).prepare()
        except CycleError as error:
            yield f"{package} has a circle of imports: {' <- '.join(error.args[1])}"


def violations(root: Path) -> list[str]:
    """All broken rules under root, one sentence each."""
    known = modules(root)
    imported = {name: list(imports(path, known)) for name, path in known.items()}
    reasons = [objection(name, t) for name, targets in imported.items() for t in targets]
    # In `contact_scene`, `reading` has the units of values as well as the files of scenes.
    packages = {name.rpartition(".")[0] for name in known} - {"", "contact_scene"}
    reasons += circles(imported, packages)
    return [reason for reason in reasons if reason]


def test_imports_go_one_way():
    assert violations(ROOT) == []


PLANTED = {
    "contact_scene/body.py": "from semi_analytical.grid import SurfaceGrid",
    "contact_scene/geometry.py": "import scipy.special",
    "semi_analytical/history.py": "def march():\n    from verification import metrics",
    "semi_analytical/operator.py": "from fem_reference import mesh",
    "semi_analytical/grid.py": "from semi_analytical import solve",
    "semi_analytical/model.py": "from semi_analytical import SurfaceGrid",
    "semi_analytical/frf/half_space.py": "from semi_analytical.influence.cell import f",
    "contact_solver/pressure.py": "from contact_scene import Scene",
    "contact_solver/shear.py": "from semi_analytical import grid",
    "fem_reference/elasticity/motion.py": "import importlib\n"
    "importlib.import_module('semi_analytical.grid')",
    "radial/normal/disc.py": "from semi_analytical.grid import SurfaceGrid",
    "radial/plan.py": "from fem_reference.plan import plan",
    "radial/fields.py": "SOLVER = 'fem_reference.plan:plan'",
    "contact_results/files.py": "from verification.norms import relative_l2",
    "verification/judging/case.py": "from verification.cases import catalogue",
    "verification/running/study.py": "def draw():\n    from verification.report import page",
    "verification/report/page.py": "from slipstick.cli import terminal",
    "verification/closed_forms/hertz.py": "from contact_scene import Scene",
    "verification/closed_forms/quadrature.py": "from verification.norms import relative_error",
    "verification/closed_forms/flat_punch.py": "import pint",
    "verification/cases.py": "from tests.strategies import scenes",
}
SOUND = {
    "semi_analytical/__init__.py": "from semi_analytical.solve import solve",
    "semi_analytical/grid.py": "from dataclasses import dataclass",
    "semi_analytical/influence/from_frf.py": "from semi_analytical.frf.half_space import f",
    "semi_analytical/influence/cell.py": "from semi_analytical.grid import SurfaceGrid",
    "semi_analytical/frf/half_space.py": "import numpy as np",
    "fem_reference/elasticity/hat_functions.py": "from fem_reference.elasticity import compliance",
    "fem_reference/elasticity/compliance.py": "from fem_reference.elasticity.motion import motion",
    "radial/response/bodies.py": "from semi_analytical.frf.half_space import f",
    "semi_analytical/solve.py": "from semi_analytical import grid\nfrom contact_scene import Scene",
    "verification/closed_forms/hertz.py": "import scipy.special",
    "verification/closed_forms/flat_punch.py": "from numpy import pi",
    "verification/cases.py": "import semi_analytical, fem_reference, contact_scene",
}


def plant(root: Path, sources: dict[str, str]) -> None:
    for name, source in sources.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(source + "\n", encoding="utf-8")


@pytest.mark.parametrize("file", PLANTED)
def test_planted_violation_is_caught(tmp_path, file):
    plant(tmp_path, SOUND | {file: PLANTED[file]})
    assert len(violations(tmp_path)) == 1


def test_sound_imports_pass(tmp_path):
    plant(tmp_path, SOUND)
    assert violations(tmp_path) == []
