"""Tests of the CPU time that `slipstick plan` estimates, against the time of runs."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from contact_errors.coarse_solves import Fineness
from contact_errors.cost_estimate import (
    CELL_OVERHEAD,
    ELEMENT_OVERHEAD,
    Work,
    estimated_run_seconds,
)
from contact_errors.on_cells import CellSolver
from contact_errors.trial_solve import estimate_seconds
from contact_scene import SceneFile, read_scene_file
from contact_scene.disk_cache import without_cache
from slipstick.solvers.names import SolverName
from slipstick.solvers.solver import time_text

SCENES = Path(__file__).parents[1] / "scenes"
FACTOR = 2.0
LEAST_SECONDS = 1.0  # less is stated as less than that
SHARE = 0.2  # of the time of a run that its estimate may take


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "name"),
    [
        ("hertz", SolverName.SEMI_ANALYTICAL),
        ("coated_ball", SolverName.SEMI_ANALYTICAL),
        ("torsion", SolverName.SEMI_ANALYTICAL),
        ("coated_fretting", SolverName.SEMI_ANALYTICAL),
        ("fretting_loop", SolverName.SEMI_ANALYTICAL),
        ("coated_fretting", SolverName.RADIAL),
        ("fretting_loop", SolverName.RADIAL),
        ("fretting_loop", SolverName.FEM_COMPLEMENTARITY),
    ],
)
def test_runs_take_half_to_twice_the_estimate(scene: str, name: SolverName) -> None:
    contents, solver = read_scene_file(SCENES / f"{scene}.toml"), name.solver
    posed, fineness = contents.scene, solver.fineness(contents)
    refinable = solver.refined(posed, fineness)
    with without_cache():
        began = time.process_time()
        result = solver.solve(posed, fineness, solver.plan(posed, fineness))
        solver.errors(result)
        taken = time.process_time() - began
        run = refinable.fineness_of(result)
        began = time.process_time()
        stated = estimate_seconds(refinable, run)
        trial = time.process_time() - began
    stated, taken = max(LEAST_SECONDS, stated), max(LEAST_SECONDS, taken)
    assert 1 / FACTOR <= stated / taken <= FACTOR
    assert trial <= SHARE * taken


def test_a_plan_solves_a_few_increments_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    solved: list[tuple[int, ...]] = []
    solve = CellSolver.solve

    def counted(solver: CellSolver, fineness: Fineness, *further: Any) -> Any:
        solved.append(fineness.increments)
        return solve(solver, fineness, *further)

    monkeypatch.setattr(CellSolver, "solve", counted)
    contents, solver = read_scene_file(SCENES / "fretting_loop.toml"), SolverName.SEMI_ANALYTICAL
    rows = dict(solver.solver.work(contents.scene, *_planned(contents, solver)))
    assert rows["time"].startswith("about")
    assert solved == [(2, 2, 2)]


def _planned(contents: SceneFile, name: SolverName) -> tuple[Any, Any]:
    """Return the discretisation of a scene file for a solver, and the plan of its solve."""
    fineness = name.solver.fineness(contents)
    return fineness, name.solver.plan(contents.scene, fineness)


def test_a_worked_example() -> None:
    # (65536 + 16384)/(1024 + 16384) = 4.705882, to the power 1.1: 5.4942; with 1/4 and 4/25 of the
    # cells in the coarse solves 2.00526 and 1.61201; times 10/4 increments.
    coarse, fine = (Work(n**2, count, CELL_OVERHEAD) for n, count in ((32, 4), (256, 10)))
    estimate = estimated_run_seconds(2.0, 0.0, coarse, fine)
    assert estimate == pytest.approx(2 * 2.5 * (5.4942 + 2.00526 + 1.61201), rel=1e-4)
    # (576 + 1024)/(64 + 1024) = 1.470588, to the power 1.1: 1.52840; with 1/4 and 4/25 of the
    # unknowns 1.08117 and 1.02851; times 70/60 and 3 harmonics, also for the increment error.
    coarse, fine = (Work(n**2, count, ELEMENT_OVERHEAD) for n, count in ((8, 60), (24, 210)))
    estimate = estimated_run_seconds(1.0, 0.5, coarse, fine)
    assert estimate == pytest.approx(3.5 * (1.5284 + 1.08117 + 1.02851 + 0.5), rel=1e-4)


@pytest.mark.parametrize(
    ("seconds", "text"),
    [
        (0.5, "less than 1 s"),
        (90.0, "about 90 s"),
        (113.0, "about 110 s"),
        (6e2, "about 10 min"),
        (3.6e4, "about 10 h"),
    ],
)
def test_a_time_is_told_in_the_unit_that_suits_it(seconds: float, text: str) -> None:
    assert time_text(seconds) == text
