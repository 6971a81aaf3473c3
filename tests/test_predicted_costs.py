"""Prices are near what is paid, and a price that is not is seen."""

from __future__ import annotations

import pytest

from contact_errors import ladder_on_elements
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.row import CaseRecord
from verification.running.study import Settings
from verification.studies.predicted_costs import (
    ENOUGH,
    PREDICTED,
    TOOK,
    PricedCase,
    cases,
    conclude,
    is_near,
)

SETTINGS = Settings(Level.STANDARD)


def record(predicted: float, took: float) -> CaseRecord:
    return CaseRecord(
        parameters={"family": "hertz", "number": 0, "asked": "1%"},
        measures={PREDICTED: predicted, TOOK: took},
        counters={"rounds_predicted": 2, "rounds": 2},
    )


@pytest.mark.parametrize(
    ("predicted", "took", "near"),
    [(3.0, 5.9, True), (5.9, 3.0, True), (3.0, 6.1, False), (0.1, 1.9, True), (0.1, 2.1, False)],
)
def test_a_price_is_near_within_a_factor_of_two_and_below_a_second(
    predicted: float, took: float, near: bool
) -> None:
    assert is_near(record(predicted, took)) is near


@pytest.mark.parametrize(
    ("near", "far", "outcome"),
    [
        (ENOUGH, 0, Status.PASS),
        (ENOUGH - 1, 0, Status.INCONCLUSIVE),
        (ENOUGH - 7, 7, Status.FAIL),
    ],
)
def test_prices_are_judged_by_their_share(near: int, far: int, outcome: Status) -> None:
    prices = [record(4.0, 3.0)] * near + [record(4.0, 1.0)] * far
    names = (case.name for case in cases(SETTINGS))
    found = conclude(SETTINGS, dict(zip(names, prices, strict=False)))
    assert found.statements[1].outcome is outcome


def test_every_case_has_its_own_name() -> None:
    names = [case.name for case in cases(SETTINGS)]
    assert len(set(names)) == len(names) > ENOUGH


def test_a_cost_that_grows_as_the_square_of_the_elements_is_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Most of what few elements take does not grow with them."""
    case = PricedCase("sections-coated-twisted", 1, 1)
    own = case.compute()
    assert own.measures[TOOK]
    monkeypatch.setattr(ladder_on_elements, "ELEMENTS_OF_REST", 0)
    dear = case.compute()
    assert dear.counters == own.counters
    ratio = dear.measures[PREDICTED] / dear.measures[TOOK]
    assert ratio > 1.5 * own.measures[PREDICTED] / own.measures[TOOK]
