"""Tests of the command line: messages, exit codes, imports, and files that must stay unchanged."""

import errno
import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from command import slipstick
from synthetic_result import synthetic_result

from contact_results.blas_threads import VARIABLES
from contact_results.directory.file_names import SUMMARY
from contact_results.solvers import SolverName
from contact_scene.solver_errors import (
    AccuracyOutOfReach,
    ContactAtWindowEdge,
    ContactAtZoneEdge,
    ContactNotResolved,
    GrossSliding,
    NotConverged,
    NothingTouches,
    ResourceRefused,
    SolverError,
    SurfacesOverlap,
    UnsupportedScene,
)
from fem_reference.mesh.gmsh_mesh import GmshMissing
from semi_analytical.discretised import CellSolver
from slipstick.cli import main

ROOT = Path(__file__).resolve().parents[1]

SCENE = """
title = "Ball on a flat"
[indenter]
shape = "paraboloid"
radius = "18 mm"
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[body]
material = { young_modulus = "420 GPa", poisson_ratio = 0.3 }
[friction]
coefficient = 0.1
[[loading]]
normal_force = "1 kN"
[[loading]]
tangential_force = ["90 N", 0]
increments = 3
[[loading]]
tangential_force = ["-90 N", 0]
increments = 2
"""
HEAVY = ("scipy", "matplotlib", "h5py", "pint", "jinja2", "skfem", "semi_analytical")


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


@pytest.fixture
def solver(monkeypatch: pytest.MonkeyPatch) -> Callable[[Exception | None], None]:
    """Replace the solver by one that hands out a ready result, or fails as it is told."""

    def replace_by(failure: Exception | None) -> None:
        def run(solver: CellSolver, progress: Any, store: Any = None) -> Any:
            result = synthetic_result()
            for increment in result.increments:
                progress(increment)
            if failure is not None:
                raise failure
            return result

        monkeypatch.setattr(CellSolver, "run", run)

    return replace_by


IMPORTING = """
import json, sys
from slipstick.cli import main
for command, leaving in json.loads(sys.argv[1]):
    try: main(command)
    except SystemExit as left: assert (left.code or 0) == leaving, left.code
    print("\\nimported", *{name.partition(".")[0] for name in sys.modules})
"""


def imported_after(*commands: tuple[object, ...], leaving: int = 0) -> list[set[str]]:
    """Top-level modules that a fresh process has imported after each command; the last ends so."""
    codes = [0] * (len(commands) - 1) + [leaving]
    asked = [([*map(str, c)], code) for c, code in zip(commands, codes, strict=True)]
    outcome = subprocess.run(
        [sys.executable, "-c", IMPORTING, json.dumps(asked)],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    told = [line.split() for line in outcome.stdout.splitlines() if line.startswith("imported ")]
    assert len(told) == len(commands)
    return [{*names[1:]} for names in told]


# ---- starting ---------------------------------------------------------------------------------


def test_help_schema_check_and_mistakes_import_nothing_heavy(scene: Path) -> None:
    commands = (
        ("--help",),
        ("maintain", "schema", "summary"),
        ("check", scene),
        ("check", "absent.toml"),
    )
    helped, *others = imported_after(*commands, leaving=2)
    assert not helped & {*HEAVY, "numpy", "pydantic"}
    for imported in others:
        assert not imported & {*HEAVY, "verification"}


@pytest.mark.parametrize("solver", [SolverName.SEMI_ANALYTICAL, SolverName.FEM])
def test_a_solver_is_used_without_the_other_and_without_the_harness(
    scene: Path, solver: SolverName
) -> None:
    own, other = ("fem_reference", "semi_analytical")[:: 1 if solver.is_fem else -1]
    coarse = ("semi_analytical.cells=[16,16]", "fem_reference.elements_per_radius=4")
    asked = (scene, "--solver", solver, *(word for each in coarse for word in ("--set", each)))
    out = scene.parent / "out"
    run = ("run", *asked, "-o", out, "--figures", "none", "--no-error")
    for imported in imported_after(("plan", *asked), run):
        assert own in imported
        assert not imported & {other, "rich", "verification"}
    assert (out / SUMMARY).exists()


def test_contact_without_friction_is_solved_without_scipy(tmp_path: Path) -> None:
    run = ("run", "scenes/hertz.toml", "-o", tmp_path / "out", "--figures", "none", "--no-error")
    assert "scipy" not in imported_after(run)[0]


# ---- failures of a run ------------------------------------------------------------------------

FAILURES = {
    2: (
        GrossSliding("tangential force exceeds the limit"),
        ContactAtWindowEdge("contact touches the edge"),
        ContactAtZoneEdge("contact touches the end of the fine rings"),
        AccuracyOutOfReach("no grid can meet the request"),
        UnsupportedScene("no layers yet"),
        GmshMissing("gmsh cannot be loaded"),
        OSError(errno.EACCES, "Permission denied", "out/result.h5"),
    ),
    3: (
        NotConverged("pressure", 100, 1e-3, 1e-8),
        ContactNotResolved("the contact is smaller than the cells"),
        NothingTouches("no cell touches"),
        SurfacesOverlap(1e-2, 3, 1e-3),
    ),
    4: (
        ResourceRefused("needs 80 GB"),
        MemoryError("Unable to allocate 80 GiB"),
        OSError(errno.ENOSPC, "No space left on device", "out/result.h5"),
    ),
    70: (ZeroDivisionError("a defect"), ValueError("another")),
}


def test_every_error_of_a_solver_has_a_stated_code() -> None:
    stated = {type(failure) for failures in FAILURES.values() for failure in failures}
    assert {*SolverError.__subclasses__(), NothingTouches} <= stated


@pytest.mark.parametrize(
    ("code", "failure"), [(code, each) for code, failures in FAILURES.items() for each in failures]
)
def test_failure_ends_with_its_code_one_message_and_no_files(
    scene: Path, solver: Any, capsys: pytest.CaptureFixture[str], code: int, failure: Exception
) -> None:
    solver(failure)
    assert slipstick("run", scene, "--output", scene.parent / "out") == code
    errors = capsys.readouterr().err
    assert errors.count("error: ") == 1
    assert "Traceback" not in errors
    assert os.listdir(scene.parent) == [scene.name]


@pytest.mark.parametrize(("asked", "used"), [(None, "1"), ("3", "3")])
def test_commands_use_one_thread_unless_told(
    asked: str | None, used: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
        if asked is not None:
            monkeypatch.setenv(name, asked)
    with pytest.raises(SystemExit):
        main(["--version"])
    assert [os.environ[name] for name in VARIABLES] == [used] * len(VARIABLES)
