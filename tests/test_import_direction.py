"""Tests of the import order: scene <- contact_solver <- solvers <- results <- errors <-
verification <- command.

CONTRIBUTING.md states the order. `ORDERS` holds the reading order of a package: a module imports
only from entries above its own. An entry that is a package stands for all its modules, which may
have an order of their own. A new module has to be placed in its list.
"""

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
# From the ground up: a package imports those before it, but for what FORBIDDEN says.
PACKAGES = (
    *("contact_scene", "contact_solver", "semi_analytical", "fem_reference", "radial"),
    *("contact_results", "contact_errors", "verification", "slipstick"),
)

ORDER = (
    "grid",
    "frf",
    "influence",
    "operator",
    "edge",
    "increment_counts",
    "plan",
    "fields",
    "memory",
    "model",
    "increments",
    "coupled",
    "edge_correction",
    "stiffness",
    "history",
    "stress",
    "surface_tensile_stress",
    "default_grid",
    "resolution",
    "solve",
)

ORDERS = {
    "contact_solver": (
        "residuals",
        "slip_compliance_bins",
        "multipliers",
        "rigid_motion",
        "conjugate_gradients",
        "admissible_pressure",
        "pressure",
        "admissible_shear",
        "gross_slip",
        "zones",
        "linearised_shear",
        "shear",
        "binned_preconditioner",
        "dense_inverse",
        "coupled_problem",
        "unequal_areas",
        "alternating_iteration",
        "natural_map",
        "krylov",
        "linearised_contact",
        "newton_iterate",
        "newton_increment",
        "proximal_point",
        "globalisation",
        "tangent",
    ),
    "semi_analytical": ORDER,
    "semi_analytical.operator": (
        "domain",
        "box",
        "transforms",
        "spectra",
        "operator",
        "points",
    ),
    "semi_analytical.edge": (
        "clipped_power_means",
        "quadratic",
        "fit",
        "half_width",
        "contact_area",
        "shape",
        "edge_geometry",
        "film",
        "kernels",
        "film_shape",
        "subcell_tractions",
        "displacement",
        "corrected",
    ),
    "semi_analytical.edge_correction": (
        "operators",
        "shear_at_edge",
        "pressure",
        "shear",
        "stick_area",
        "correction",
    ),
    "fem_reference": (
        "memory",
        "scales",
        "mesh",
        "elasticity",
        "plan",
        "loads",
        "fields",
        "energy",
        "model",
        "compliance",
        "contact",
        "history",
        "stress",
        "expected_radius",
        "solve",
    ),
    "radial": (
        "response",
        "normal",
        "angular_grid",
        "plan",
        "fields",
        "output_points",
        "largest_contact",
        "memory",
        "frictional",
        "tangential",
        "torsion",
        "history",
        "stress",
    ),
    "fem_reference.mesh": ("section_outline", "section_mesh", "gmsh_mesh"),
    "fem_reference.elasticity": (
        *("motion", "section_basis", "weak_form", "numbering"),
        *("factored_section", "compliance", "hat_functions"),
    ),
    "fem_reference.contact": (
        "friction_limit",
        "point_state",
        "augmented_lagrangian",
        "point_contact",
        "point_problem",
        "free_motion",
        "increment",
        "increment_report",
        "stiffness",
        "method",
    ),
    "contact_results": (
        "blas_threads",
        "number_text",
        "radial_method",
        "omitted_parts",
        "directory",
        "surface",
        "result_warnings",
        "loop",
        "edge_slip",
        "cycles",
        "key_numbers",
        "files",
        "stress",
        "figures",
        "result_files",
        "stress_result",
    ),
    "contact_errors": (
        *("error_formula", "known_pressing", "cost_estimate", "coarse_solves", "trial_solve"),
        *("on_cells", "on_elements", "on_radii", "stress_errors", "adaptive_refinement"),
    ),
    "verification.challenge": (
        *("requested_quantities", "cases", "files", "solver_process", "python_api"),
        "saved_judgements",
    ),
    "slipstick": (
        *(
            "solvers",
            "solving",
            "tables",
            "sweep",
            "sweep_chart",
            "against",
            "expected",
            "critical_load",
            "cli",
            "__main__",
        ),
    ),
    # Its floors: what judges stands on what is known, what is shown on what was judged.
    "verification": (
        *(
            "closed_forms",
            "references",
            "baselines",
            "norms",
            "quantities",
            "solver",
            "convergence",
            "exhibits",
        ),
        *("problems", "laws", "observed"),
        "judging",
        *("running", "regression"),
        *("cases", "defects", "challenge", "peers", "adapters", "studies"),
        *("report", "judged_by_pytest"),
    ),
    "verification.studies.stability": ("contacts", "study"),
}

# What the modules within each name may not import.
FORBIDDEN = {
    "contact_scene": ("semi_analytical", "fem_reference", "verification", "scipy"),
    "semi_analytical": ("fem_reference", "verification"),
    "fem_reference": ("semi_analytical", "verification"),
    "radial": ("semi_analytical", "fem_reference", "verification"),
    "verification.closed_forms": ("contact_scene", "semi_analytical", "fem_reference"),
    # It sees arrays and callables: a dense 4x4 matrix is as good an operator as any.
    "contact_solver": ("contact_scene",),
}
# Array types, errors and the comparison with the friction limit are no part of a scene.
BESIDE_THE_SCENE = (
    "contact_scene.array_types",
    "contact_scene.friction_limit",
    "contact_scene.solver_errors",
)
# What the radial solver has from the semi-analytical one: how layers answer one wavenumber.
SHARED = "semi_analytical.frf"
ONLY_SCRIPTS = ("tests", "examples")


def within(name: str, package: str) -> bool:
    """Whether a dotted name is the package or something in it."""
    return name == package or name.startswith(package + ".")


def module_name(path: Path, root: Path) -> str:
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def modules(root: Path) -> dict[str, Path]:
    """All modules of our packages under root, by dotted name."""
    paths = sorted(path for package in PACKAGES for path in (root / package).rglob("*.py"))
    return {module_name(path, root): path for path in paths}


def imports(name: str, path: Path, known: dict[str, Path]) -> Iterator[str]:
    """Dotted names that a module imports: anywhere in it, lazily or for its annotations only."""
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), filename=str(path))):
        match node:
            case ast.Import():
                yield from (alias.name for alias in node.names)
            case ast.ImportFrom():
                ancestors = package.split(".")[: len(package.split(".")) - node.level + 1]
                prefix = ".".join(ancestors) if node.level else ""
                source = ".".join(part for part in (prefix, node.module) if part)
                for alias in node.names:
                    member = f"{source}.{alias.name}"
                    yield member if member in known else source
            case ast.Call(func=ast.Attribute(attr="import_module") | ast.Name(id="__import__")):
                yield from (arg.value for arg in node.args[:1] if isinstance(arg, ast.Constant))


def rank(name: str, package: str) -> int | None:
    """Place of a module in the order of a package; None for the package itself or a stranger."""
    member = name[len(package) + 1 :].partition(".")[0]
    return ORDERS[package].index(member) if member in ORDERS[package] else None


def objection(name: str, target: str) -> str | None:
    """Why module `name` may not import `target`; None if it may."""
    for package, forbidden in FORBIDDEN.items():
        if target in BESIDE_THE_SCENE:
            continue
        if within(name, "radial") and within(target, SHARED):
            continue
        if within(name, package) and any(within(target, other) for other in forbidden):
            return f"{name} imports {target}: {package} must not"
    if any(within(target, script) for script in ONLY_SCRIPTS):
        return f"{name} imports {target}: nothing imports scripts"
    if within(name, "verification.closed_forms"):
        allowed = {"numpy", "scipy", *sys.stdlib_module_names}
        if not within(target, "verification.closed_forms") and target.split(".")[0] not in allowed:
            return f"{name} imports {target}: closed forms rest on numpy and scipy alone"
    house, room = name.partition(".")[0], target.partition(".")[0]
    if house in PACKAGES and room in PACKAGES and PACKAGES.index(room) > PACKAGES.index(house):
        return f"{name} imports {target}: {room} stands above {house}"
    for package in ORDERS:
        if name == package or not (within(name, package) and within(target, package)):
            continue
        own, other = rank(name, package), rank(target, package)
        if target == package:
            return f"{name} imports {target}: import from the module that defines it"
        if own is not None and other is not None and other > own:
            return f"{name} imports {target}: which stands below it in its order"
    return None


def violations(root: Path) -> list[str]:
    """All broken rules under root, one sentence each."""
    known = modules(root)
    found = [
        f"{name} has no place in the order of {package}"
        for name in known
        for package in ORDERS
        if name != package and within(name, package) and rank(name, package) is None
    ]
    for name, path in known.items():
        reasons = (objection(name, target) for target in imports(name, path, known))
        found += [reason for reason in reasons if reason]
    return found


def test_imports_go_one_way() -> None:
    assert violations(ROOT) == []


def test_what_takes_as_long_as_a_contact_is_imported_where_it_is_called() -> None:
    """Of scipy, a tenth of a second each: films and fitted edges alone need them."""
    slow = {f"scipy.{part}" for part in ("interpolate", "optimize", "sparse", "spatial")}
    modules = [
        path
        for name in ("contact_solver", "semi_analytical")
        for path in (ROOT / name).rglob("*.py")
    ]
    assert modules
    for path in modules:
        top = ast.parse(path.read_text(encoding="utf-8")).body
        found = {node.module for node in top if isinstance(node, ast.ImportFrom)}
        found |= {name.name for node in top if isinstance(node, ast.Import) for name in node.names}
        assert not found & slow, path


def test_results_bring_in_no_solver_by_themselves() -> None:
    """Whoever has the results of one solver need not import the other."""
    ours = sorted(name for name in modules(ROOT) if within(name, "contact_results"))
    script = f"""
import importlib, sys
for name in {ours}:
    importlib.import_module(name)
solvers = {{"contact_solver", "semi_analytical", "fem_reference", "radial"}}
print(*{{*solvers, "verification"}} & set(sys.modules))"""
    ran = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert ran.stdout.split() == []


PLANTED = {
    "contact_scene/body.py": "from semi_analytical.grid import SurfaceGrid",
    "contact_scene/geometry.py": "import scipy.special",
    "semi_analytical/history.py": "def march():\n    from verification import metrics",
    "semi_analytical/operator.py": "from fem_reference import mesh",
    "semi_analytical/grid.py": "from .solve import solve",
    "semi_analytical/model.py": "from semi_analytical import SurfaceGrid",
    "semi_analytical/frf/half_space.py": "from ..operator import InfluenceOperator",
    "contact_solver/pressure.py": "from contact_scene import Scene",
    "contact_solver/shear.py": "from semi_analytical import grid",
    "contact_solver/rigid_motion.py": "from contact_solver.pressure import solve_pressure",
    "semi_analytical/helpers.py": "import math",
    "fem_reference/elasticity/motion.py": "import importlib\n"
    "importlib.import_module('semi_analytical.grid')",
    "fem_reference/elasticity/hat_functions.py": "from fem_reference.model import ContactModel",
    "fem_reference/meshes.py": "import numpy as np",
    "radial/normal/disc.py": "from semi_analytical.grid import SurfaceGrid",
    "radial/plan.py": "from fem_reference.plan import plan",
    "contact_results/files.py": "from verification.norms import relative_l2",
    "contact_results/stress/points.py": "from contact_results.figures import stress_plot",
    "slipstick/solving.py": "from slipstick.cli import terminal",
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
    "semi_analytical/influence/from_frf.py": "from ..frf.half_space import f\nfrom . import cell",
    "semi_analytical/influence/cell.py": "from semi_analytical.grid import SurfaceGrid",
    "semi_analytical/frf/half_space.py": "import numpy as np",
    "fem_reference/elasticity/hat_functions.py": "from .compliance import Nodal",
    "fem_reference/elasticity/compliance.py": "from .motion import motion",
    "radial/response/bodies.py": "from semi_analytical.frf.half_space import f",
    "semi_analytical/solve.py": "from . import grid\nfrom contact_scene import Scene",
    "verification/closed_forms/hertz.py": "import scipy.special\nfrom . import quadrature",
    "verification/closed_forms/flat_punch.py": "from numpy import pi",
    "verification/cases.py": "import semi_analytical, fem_reference, contact_scene",
}


def plant(root: Path, sources: dict[str, str]) -> None:
    for name, source in sources.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(source + "\n", encoding="utf-8")


@pytest.mark.parametrize("file", PLANTED)
def test_planted_violation_is_caught(tmp_path: Path, file: str) -> None:
    plant(tmp_path, SOUND | {file: PLANTED[file]})
    assert len(violations(tmp_path)) == 1


def test_sound_imports_pass(tmp_path: Path) -> None:
    plant(tmp_path, SOUND)
    assert violations(tmp_path) == []
