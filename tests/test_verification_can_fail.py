"""Defects planted in the solver are seen by the verification, which passes without them."""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from semi_analytical import increment, stick_slip
from semi_analytical.errors import NotConverged
from semi_analytical.model import ContactModel
from semi_analytical.operator import NormalOperator, TangentialOperator
from verification.cases.case import Case
from verification.cases.fretting_loop import fretting_loop_on
from verification.cases.hertz_point import hertz_on
from verification.cases.judgement import judge, solve_run
from verification.cases.load_paths import load_paths_on
from verification.cases.near_sliding import near_sliding_on
from verification.cases.outcome import CaseOutcome, Status
from verification.cases.refinement import refinement

Patch = pytest.MonkeyPatch

CASES: dict[str, Callable[[], Case]] = {
    "hertz_point": lambda: hertz_on(refinement(32, 128)),
    "fretting_loop": lambda: fretting_loop_on((96,), quarter=2),
    "near_sliding": lambda: near_sliding_on(64),
    "load_paths": lambda: load_paths_on(32),
}


def failed(outcome: CaseOutcome) -> set[str]:
    return {verdict.name for verdict in outcome.verdicts if verdict.status is Status.FAIL}


@cache
def healthy(name: str) -> CaseOutcome:
    return judge(CASES[name]())


def scale(patch: Patch, owner: type, factor: float) -> None:
    whole = owner.__call__
    patch.setattr(owner, "__call__", lambda self, traction: factor * whole(self, traction))


def normal_operator_stiff(patch: Patch) -> None:
    scale(patch, NormalOperator, 1 / 1.003)


def normal_operator_soft(patch: Patch) -> None:
    scale(patch, NormalOperator, 1.003)


def tangential_operator_soft(patch: Patch) -> None:
    scale(patch, TangentialOperator, 1.003)


def friction_off_by_root_two(patch: Patch) -> None:
    patch.setattr(
        ContactModel,
        "friction_coefficient",
        property(lambda self: self.scene.friction.coefficient * np.sqrt(2)),
    )


def slip_memory_dropped(patch: Patch) -> None:
    whole = increment.slip_and_stick

    def forgetful(model: Any, pressure: Any, last: Any, *rest: Any) -> Any:
        return whole(model, pressure, stick_slip.untouched(model.grid.cells), *rest)

    patch.setattr(increment, "slip_and_stick", forgetful)


def gap_too_deep(patch: Patch) -> None:
    patch.setattr(
        ContactModel,
        "of",
        classmethod(lambda cls, scene, grid, whole=ContactModel.of: deeper(whole(scene, grid))),
    )


def deeper(model: ContactModel) -> ContactModel:
    model.gap = 1.003 * model.gap
    return model


DEFECTS = {
    normal_operator_stiff: ("hertz_point", "approach"),
    normal_operator_soft: ("hertz_point", "peak_pressure"),
    gap_too_deep: ("hertz_point", "approach"),
    tangential_operator_soft: ("fretting_loop", "largest_shift_error"),
    friction_off_by_root_two: ("fretting_loop", "largest_shear_error"),
    slip_memory_dropped: ("fretting_loop", "energy_per_cycle"),
}


@pytest.mark.parametrize("name", CASES)
def test_healthy_solver_passes(name: str) -> None:
    assert failed(healthy(name)) == set()


@pytest.mark.parametrize("plant", DEFECTS, ids=lambda plant: plant.__name__)
def test_planted_defect_fails(plant: Callable[[Patch], None], monkeypatch: Patch) -> None:
    name, quantity = DEFECTS[plant]
    plant(monkeypatch)
    assert quantity in failed(judge(CASES[name]()))


def test_friction_defect_is_seen_while_sliding(monkeypatch: Patch) -> None:
    friction_off_by_root_two(monkeypatch)
    assert "sliding_force" in failed(judge(CASES["near_sliding"]()))


def test_residual_above_tolerance_fails(monkeypatch: Patch) -> None:
    case = CASES["load_paths"]()
    lax = {run.label: run for run in case.runs}

    def solve(run: Any) -> Any:
        loose = type(run)(run.label, run.scene, run.grid, 1e-4)
        return solve_run(loose) if run.label == next(iter(lax)) else solve_run(run)

    assert failed(judge(case, solve)) == {"largest_residual"}


def test_solver_that_gives_up_fails_and_the_rest_is_still_judged() -> None:
    case = CASES["near_sliding"]()

    def solve(run: Any) -> Any:
        if run is case.runs[0]:
            raise NotConverged("the shear", 60, 1e-3, 1e-8)
        return solve_run(run)

    outcome = judge(case, solve)
    assert failed(outcome) == {"solved"}
    assert "1.00e-03" in outcome.verdicts[0].meaning
    assert len(outcome.runs) == len(case.runs) - 1
    assert outcome.count(Status.PASS) > 1
