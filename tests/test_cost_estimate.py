"""Tests of the CPU time that `slipstick plan` estimates, against the time of runs."""

import time
from pathlib import Path

import pytest

from contact_errors.coarse_solves import stated_errors
from contact_errors.cost_estimate import (
    estimated_run_seconds,
)
from contact_errors.trial_solve import estimate_seconds
from contact_results.solvers import SolverName
from contact_scene import read_scene_file
from contact_scene.discretised import Work
from contact_scene.disk_cache import without_cache
from fem_reference.discretised import ELEMENT_OVERHEAD
from semi_analytical.discretised import CELL_OVERHEAD, CellSolver
from slipstick.cli.time_estimate import estimated_time, time_text

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
def test_runs_take_half_to_twice_the_estimate(scene, name):
    solver = name.solver.of_file(read_scene_file(SCENES / f"{scene}.toml"))
    with without_cache():
        began = time.process_time()
        result = solver.run()
        stated_errors(result)
        taken = time.process_time() - began
        run = solver.fineness_of(result)
        began = time.process_time()
        stated = estimate_seconds(solver, run)
        trial = time.process_time() - began
    stated, taken = max(LEAST_SECONDS, stated), max(LEAST_SECONDS, taken)
    assert 1 / FACTOR <= stated / taken <= FACTOR
    assert trial <= SHARE * taken


def test_a_plan_solves_a_few_increments_alone(monkeypatch):
    solved = []
    solve = CellSolver.solve

    def counted(solver, fineness, *further):
        solved.append(fineness.increments)
        return solve(solver, fineness, *further)

    monkeypatch.setattr(CellSolver, "solve", counted)
    solver = CellSolver.of_file(read_scene_file(SCENES / "fretting_loop.toml"))
    assert estimated_time(solver).startswith("about")
    assert solved == [(2, 2, 2)]


def test_a_worked_example():
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
def test_a_time_is_told_in_the_unit_that_suits_it(seconds, text):
    assert time_text(seconds) == text
