"""Orders of cases that are taken from the changes between levels, on planted levels."""

from types import SimpleNamespace

import numpy as np
import pytest

from verification.cases.case import Case, OrderOfChange
from verification.cases.outcome import Status
from verification.cases.verdicts import judge_order

SIZES = 0.25 * 2.0 ** -np.arange(6)
LIMIT = 3.0


def judged(errors, expected):
    """The verdict on levels with these errors, the limit unknown to the judge."""
    results = {
        f"level {n}": SimpleNamespace(size=size, value=LIMIT + error)
        for n, (size, error) in enumerate(zip(SIZES, errors, strict=True))
    }
    order = OrderOfChange(
        "order", "a planted value", tuple(results), lambda one, other: abs(one.value - other.value),
        lambda result: result.size, expected, "planted",
    )  # fmt: skip
    case = Case("planted", "planted", "", (), (), orders=(order,))
    return judge_order(order, case, results)


@pytest.mark.parametrize("order", [1.0, 1.5, 2.0])
def test_planted_order_passes_and_another_fails(order):
    verdict = judged(0.1 * SIZES**order, order)
    assert verdict.status is Status.PASS
    assert verdict.value == pytest.approx(order, abs=1e-6)
    assert judged(0.1 * SIZES**order, order + 0.5).status is Status.FAIL


def test_planted_first_order_term_fails_a_second_order_value():
    assert judged(0.1 * SIZES**2 + 0.05 * SIZES, 2.0).status is Status.FAIL


def test_planted_noise_is_inconclusive(rng):
    errors = 0.1 * SIZES * (1 + 0.7 * rng.standard_normal(6))
    assert judged(errors, 1.0).status is Status.INCONCLUSIVE


def test_levels_that_do_not_change_fail():
    assert judged(0 * SIZES, 1.0).status is Status.FAIL
