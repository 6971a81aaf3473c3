"""Tests of the judgement of orders, tolerances and worst runs in verification cases."""

from dataclasses import replace
from math import nan
from types import SimpleNamespace

import numpy as np
import pytest

from verification.judging.case import (
    Case,
    Derived,
    NotYetAsymptotic,
    Order,
    Quantity,
    Required,
)
from verification.judging.judgement import judge_order, judge_quantity, judge_worst
from verification.judging.outcome import Status, Verdict
from verification.problems.problem import Reference, ReferenceKind, identity
from verification.solver import Solver

SIZES = 0.1 * 2.0 ** (-np.arange(6) / 2)


def verdict_on(
    results,
    of,
    evaluate,
    expected,
    *not_yet,
    **more,
):
    """The verdict on the order of results by label, which have a size each."""
    runs = tuple(
        SimpleNamespace(label=label, solver=Solver.CELLS, spacing=result.size)
        for label, result in results.items()
    )
    order = Order(
        "order",
        of,
        "a planted value",
        tuple(results),
        evaluate,
        expected,
        "planted",
        *not_yet,
        **more,
    )
    return judge_order(order, Case("planted", "", "", runs, (), orders=(order,)), results)


def judged(errors: np.ndarray, expected: float) -> Verdict:
    """The verdict on levels with these errors, one run each or several (sizes, runs)."""
    results = {
        f"{n}, {k}": SimpleNamespace(error=error, size=SIZES[n])
        for n, row in enumerate(np.reshape(errors, (len(SIZES), -1)))
        for k, error in enumerate(row)
    }
    return verdict_on(results, "tangential shift", lambda result: result.error, expected)


def test_runs_of_one_size_tell_the_order_that_each_alone_hides(rng):
    """Errors that change their sign from run to run, as where a circle falls on the cells."""
    signed = SIZES[:, None] ** 2.5 * np.sin(rng.uniform(0, 2 * np.pi, (len(SIZES), 96)))
    together = judged(signed, 2.5)
    assert together.status is Status.PASS
    assert together.order.sizes == pytest.approx(SIZES)
    alone = [judged(np.abs(column), 2.5).status for column in signed.T]
    assert alone.count(Status.INCONCLUSIVE) > len(alone) / 2
    assert judged(signed * SIZES[:, None], 2.5).status is Status.FAIL


@pytest.mark.parametrize(
    ("reference", "status", "clearance"), [(0.0, Status.PASS, 0.0), (0.5, Status.FAIL, None)]
)
def test_values_that_refinement_does_not_change_are_judged_exactly(reference, status, clearance):
    labels = "coarse", "finer", "finest"
    runs = tuple(
        SimpleNamespace(label=label, spacing=size)
        for label, size in zip(labels, SIZES, strict=False)
    )
    quantity = Quantity(
        "constant",
        "",
        "",
        "finest",
        lambda result: result,
        identity(reference, "planted"),
        Derived(labels, 1.0, 1.0, "planted"),
        1.0,
    )
    case = Case("planted", "", "", runs, (quantity,))
    verdict = judge_quantity(quantity, case, dict.fromkeys(labels, 0.0))
    assert (verdict.allowed, verdict.status, verdict.clearance) == (0.0, status, clearance)


def test_a_stated_error_covers_no_more_than_itself_and_that_of_the_reference():
    quantity = Quantity(
        "one",
        "",
        "",
        "run",
        float,
        Reference(0.0, ReferenceKind.CLOSED_FORM, "planted", 0.25),
        Required(1.0, "planted"),
        1.0,
    )
    case = Case("planted", "", "", (), (quantity,))
    found = [
        judge_quantity(
            replace(quantity, tolerance=Required(allowed, "planted")), case, {"run": x}, 0.5
        ).model_dump()
        for x, allowed in ((-0.74, 1.0), (0.74, 1.0), (0.76, 1.0), (0.1, 0.2), (0.3, 0.2))
    ]
    assert [(v.covered, v.status) for v in map(Verdict.model_validate, found)] == [
        *((True, Status.PASS), (True, Status.PASS), (False, Status.PASS)),
        # nobody can judge to less than the uncertainty of the reference, 0.25
        *((True, Status.INCONCLUSIVE), (True, Status.FAIL)),
    ]
    with pytest.raises(ValueError, match="needs an uncertainty > 0"):
        replace(quantity, reference=replace(quantity.reference, uncertainty=0.0))


@pytest.mark.parametrize(
    ("tight", "loose", "worst"),
    [
        *((1e-3, 5e-3, "tight"), (1e-5, 5e-3, "loose"), (1e-5, nan, "loose")),
        (0.0, 9e-13, "tight"),  # the first of equal ones, as both are round-off
    ],
)
def test_the_worst_run_is_the_nearest_to_its_own_tolerance(tight, loose, worst):
    allowed = {"tight": 1e-4, "loose": 1e-2}
    runs = tuple(SimpleNamespace(label=one, tolerance=size) for one, size in allowed.items())
    found, case = {"tight": tight, "loose": loose}, Case("planted", "", "", runs, ())
    verdict = judge_worst(case, found, "", "", "", "", lambda run: run.tolerance)
    assert verdict.run == worst
    assert (verdict.status is Status.PASS) is (found[worst] <= allowed[worst])


# ---- changes between levels


HALVED = 0.25 * 2.0 ** -np.arange(6)
LIMIT = 3.0


def judged_change(errors, expected, not_yet=None, sizes=HALVED, apart=1):
    """The verdict on levels with these errors, the limit unknown to the judge."""
    results = {
        f"level {n}": SimpleNamespace(size=size, value=LIMIT + error)
        for n, (size, error) in enumerate(zip(sizes, errors, strict=True))
    }
    return verdict_on(
        results,
        "approach",
        lambda one, other: abs(one.value - other.value),
        expected,
        not_yet,
        refined="increments",
        size=lambda result: result.size,
        apart=apart,
    )


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_planted_order_passes_and_another_fails(order):
    verdict = judged_change(0.1 * HALVED**order, order)
    assert verdict.status is Status.PASS
    assert verdict.value == pytest.approx(order, abs=1e-6)
    assert judged_change(0.1 * HALVED**order, order + 0.5).status is Status.FAIL


def test_changes_over_two_levels_tell_the_same_order():
    sizes = 0.25 * 2.0 ** (-np.arange(9) / 2)
    verdict = judged_change(0.1 * sizes**1.5, 1.5, sizes=sizes, apart=2)
    assert verdict.value == pytest.approx(1.5, abs=1e-6)
    assert verdict.order.sizes == pytest.approx(sizes[:-2])
    assert "7 changes" in verdict.because


def test_levels_that_are_not_asymptotic_yet_may_be_off_by_what_is_known():
    errors = 0.1 * HALVED**1.35
    assert judged_change(errors, 1.5).status is Status.FAIL
    known = judged_change(errors, 1.5, NotYetAsymptotic(0.2, "a planted reason"))
    assert known.status is Status.PASS
    assert known.allowed == 0.2
    assert "a planted reason" in known.because
    assert (
        judged_change(errors, 1.6, NotYetAsymptotic(0.2, "a planted reason")).status is Status.FAIL
    )
    for allowance in (0.0, 0.25):
        with pytest.raises(ValueError, match="needs less"):
            NotYetAsymptotic(allowance, "any order would do")
