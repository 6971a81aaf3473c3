"""Orders of cases that are taken from the changes between levels, on planted levels."""

from types import SimpleNamespace

import numpy as np
import pytest

from verification.judging.case import Case
from verification.judging.order_of_convergence import (
    Followed,
    NotYetAsymptotic,
    OrderOfChange,
    Refinement,
)
from verification.judging.outcome import Status
from verification.judging.verdicts import judge_order
from verification.solver import Solver

SIZES = 0.25 * 2.0 ** -np.arange(6)
LIMIT = 3.0


def judged(errors, expected, not_yet=None):
    """The verdict on levels with these errors, the limit unknown to the judge."""
    results = {
        f"level {n}": SimpleNamespace(size=size, value=LIMIT + error)
        for n, (size, error) in enumerate(zip(SIZES, errors, strict=True))
    }
    order = OrderOfChange(
        "order", Followed.APPROACH, Refinement.INCREMENTS, "a planted value", tuple(results),
        lambda one, other: abs(one.value - other.value), lambda result: result.size, expected,
        "planted", not_yet,
    )  # fmt: skip
    runs = tuple(SimpleNamespace(label=label, solver=Solver.CELLS) for label in results)
    case = Case("planted", "planted", "", runs, (), orders=(order,))
    return judge_order(order, case, results)


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_planted_order_passes_and_another_fails(order):
    verdict = judged(0.1 * SIZES**order, order)
    assert verdict.status is Status.PASS
    assert verdict.value == pytest.approx(order, abs=1e-6)
    assert judged(0.1 * SIZES**order, order + 0.5).status is Status.FAIL


def test_changes_over_two_levels_tell_the_same_order():
    sizes = 0.25 * 2.0 ** (-np.arange(9) / 2)
    results = {
        f"level {n}": SimpleNamespace(size=size, value=LIMIT + 0.1 * size**1.5)
        for n, size in enumerate(sizes)
    }
    runs = tuple(SimpleNamespace(label=label, solver=Solver.CELLS) for label in results)
    order = OrderOfChange(
        "order", Followed.APPROACH, Refinement.INCREMENTS, "a planted value", tuple(results),
        lambda one, other: abs(one.value - other.value), lambda result: result.size, 1.5,
        "planted", apart=2,
    )  # fmt: skip
    verdict = judge_order(order, Case("planted", "", "", runs, (), orders=(order,)), results)
    assert verdict.value == pytest.approx(1.5, abs=1e-6)
    assert verdict.order.sizes == pytest.approx(sizes[:-2])
    assert "7 changes" in verdict.because


def test_planted_first_order_term_fails_a_second_order_value():
    assert judged(0.1 * SIZES**2 + 0.05 * SIZES, 2.0).status is Status.FAIL


def test_levels_that_are_not_asymptotic_yet_may_be_off_by_what_is_known():
    errors = 0.1 * SIZES**1.35
    assert judged(errors, 1.5).status is Status.FAIL
    known = judged(errors, 1.5, NotYetAsymptotic(0.2, "a planted reason"))
    assert known.status is Status.PASS
    assert known.allowed == 0.2
    assert "a planted reason" in known.because
    assert judged(errors, 1.6, NotYetAsymptotic(0.2, "a planted reason")).status is Status.FAIL
    for allowance in (0.0, 0.25):
        with pytest.raises(ValueError, match="needs less"):
            NotYetAsymptotic(allowance, "any order would do")
