"""Tests of the command line: messages, exit codes, imports, and files that must stay unchanged."""

import errno
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from command import slipstick
from synthetic_result import synthetic_result

import semi_analytical
from contact_results.blas_threads import VARIABLES
from contact_results.directory.file_names import SUMMARY
from contact_scene.solver_errors import (
    ContactAtWindowEdge,
    GrossSliding,
    NotConverged,
    ResourceRefused,
    UnsupportedScene,
)
from slipstick.cli import main
from slipstick.solvers.names import SolverName

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
        def solve(
            scene: Any, discretisation: Any, progress: Any, plan: Any, store: Any = None
        ) -> Any:
            result = synthetic_result()
            for increment in result.increments:
                progress(increment)
            if failure is not None:
                raise failure
            return result

        monkeypatch.setattr(semi_analytical, "solve_discretised", solve)

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
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
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


@pytest.mark.parametrize(
    ("command", "words"),
    [
        ("verify hertz_pont fem_herz", "'hertz_pont', did you mean hertz_point?; "
         "no case is called 'fem_herz', did you mean fem_hertz?"),
        ("verify xyz", "no case is called 'xyz'; 'slipstick verify --list --level quick' lists"),
        ("maintain study coated_tractions", "did you mean coated-tractions?"),
        ("maintain study meshh scene.toml", "did you mean mesh?"),
        ("maintain study mesh scene.toml --cells 8", "got 8, expected at least 16"),
        ("maintain study mesh scene.toml --levels 99", "got 99, expected at most 10"),
        ("verify --workers two", "got 'two', expected a whole number"),
        ("verify --level quik", "'--level': 'quik' is not one of 'quick', 'standard', 'full'"),
    ],
)  # fmt: skip
def test_bad_arguments_are_told_with_what_was_expected(
    command: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert slipstick(*command.split()) == 2
    told = " ".join(capsys.readouterr().err.replace("│", " ").split())
    assert words in told


def test_package_runs_as_the_command() -> None:
    outcome = subprocess.run(
        [sys.executable, "-m", "slipstick", "--version"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert outcome.stdout.startswith("slipstick ")


# ---- check and schema -------------------------------------------------------------------------


def test_check_lists_every_mistake(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = scene.read_text(encoding="utf-8")
    scene.write_text(text.replace("radius", "radus").replace("0.1", "-0.1"), encoding="utf-8")
    assert slipstick("check", scene) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert f"{scene}:5: indenter.radus" in output.err
    assert f"{scene}:10: friction.coefficient" in output.err
    assert "Traceback" not in output.err


def test_check_speaks_json(scene: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert slipstick("check", scene, "--json") == 0
    assert json.loads(capsys.readouterr().out) == {"valid": True, "problems": [], "warnings": []}
    assert slipstick("check", scene, "--json", "--set", "indenter.radus=1") == 2
    outcome = json.loads(capsys.readouterr().out)
    assert outcome["valid"] is False
    assert outcome["problems"][0]["key"] == "indenter.radus"


# ---- failures of a run ------------------------------------------------------------------------

FAILURES = {
    2: (
        GrossSliding("tangential force exceeds the limit"),
        ContactAtWindowEdge("contact touches the edge"),
        UnsupportedScene("no layers yet"),
        OSError(errno.EACCES, "Permission denied", "out/result.h5"),
    ),
    3: (NotConverged("pressure", 100, 1e-3, 1e-8),),
    4: (
        ResourceRefused("needs 80 GB"),
        MemoryError("Unable to allocate 80 GiB"),
        OSError(errno.ENOSPC, "No space left on device", "out/result.h5"),
    ),
    70: (ZeroDivisionError("a defect"), ValueError("another")),
}


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


def test_run_reports_progress_and_outcome(
    scene: Path, solver: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    solver(None)
    assert (
        slipstick("run", scene, "--output", scene.parent / "out", "--figures", "none", "--no-error")
        == 0
    )
    output = capsys.readouterr()
    assert [line.partition(",")[0] for line in output.err.splitlines()] == [
        "step 1/3",
        "step 2/3",
        "step 3/3",
    ]
    assert "24 x 20 cells" in output.out
    assert "1e-08" in output.out
    assert re.search(r"3 +1 +8 +0.4 +3 +-90 ", output.out)
    timing = json.loads((scene.parent / "out" / "timing.json").read_text(encoding="utf-8"))
    assert timing["program"] == "slipstick"
    assert set(timing["wall_seconds"]) >= {"read", "solve", "write"}


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
