"""Tests of exit codes: a failed run ends with the code of its error, one message and no files."""

import errno
import os

import pytest
from command import slipstick
from scene_texts import STEEL_BALL_PRESSED
from small_result import small_result

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
from slipstick.cli.terminal import print_message

SCENE = f"""
title = "Ball on a flat"
{STEEL_BALL_PRESSED}
[[loading]]
tangential_force = ["90 N", 0]
increments = 3
[[loading]]
tangential_force = ["-90 N", 0]
increments = 2
"""


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE, encoding="utf-8")
    return path


@pytest.fixture
def solver(monkeypatch):
    """Replace the solver by one that hands out a ready result, or fails as it is told."""

    def replace_by(failure: Exception | None) -> None:
        def run(solver, progress, store=None):
            result = small_result()
            for increment in result.increments:
                progress(increment)
            if failure is not None:
                raise failure
            return result

        monkeypatch.setattr(CellSolver, "run", run)

    return replace_by


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


def test_every_error_of_a_solver_has_a_stated_code():
    stated = {type(failure) for failures in FAILURES.values() for failure in failures}
    assert {*SolverError.__subclasses__(), NothingTouches} <= stated


@pytest.mark.parametrize(
    ("code", "failure"), [(code, each) for code, failures in FAILURES.items() for each in failures]
)
def test_failure_ends_with_its_code_one_message_and_no_files(scene, solver, capsys, code, failure):
    solver(failure)
    assert slipstick("run", scene, "--output", scene.parent / "out") == code
    errors = capsys.readouterr().err
    assert errors.count("error: ") == 1
    assert "Traceback" not in errors
    assert os.listdir(scene.parent) == [scene.name]


def test_an_environment_variable_shows_where_an_error_happened(scene, solver, capsys, monkeypatch):
    monkeypatch.setenv("SLIPSTICK_DEBUG", "1")
    solver(ZeroDivisionError("a defect"))
    assert slipstick("run", scene, "--output", scene.parent / "out") == 70
    assert "Traceback" in capsys.readouterr().err


def test_points_and_depths_are_refused_before_the_solve(scene, solver):
    solver(NotConverged("pressure", 100, 1e-3, 1e-8))
    for place in (("--depths", "-1 um"), ("--at", "0,0,-1 um")):
        assert slipstick("stress", scene, *place, "--output", scene.parent / "out") == 2


def test_a_message_shows_control_characters_by_their_codes(capsys):
    print_message("µ\x1b[2J\n")
    assert capsys.readouterr().err == "µ\\x1b[2J\\n\n"
