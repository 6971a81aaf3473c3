"""Tests of the study of stated errors: its counts, and its detection of a wrong error estimate."""

from collections.abc import Mapping, Sequence

import pytest

from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
)
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.problems.drawn.drawing import APPROACH, Truth
from verification.running.study import CaseRecord, Row, Settings
from verification.studies.error_coverage import (
    ASKED,
    REQUESTS,
    TRUE,
    Coverage,
    Share,
    cases,
    conclude,
    coverage_row,
)

SETTINGS = Settings(Level.FULL)


def row(
    wrong: float,
    stated: float,
    status: ErrorStatus = ErrorStatus.ESTIMATED,
    uncertain: float = 1e-9,
) -> Row:
    """Judge an approach of 2 by its relative errors."""
    truth = Truth(1, APPROACH, 2.0, 2 * uncertain)
    error = StatedError(error=2 * stated, parts={"cells": 2 * stated}, status=status)
    return coverage_row(truth, 2.0 * (1 + wrong), error)


MARKED = row(1e-3, 2e-3, ErrorStatus.NOT_CONVERGED)
JUDGED = {"covered", "tight", "wide", "false_marks"}
# A number, the shares that it belongs to, and those in which it counts.
COUNTED = {
    "covered": (row(1e-3, 1.1e-3), {"covered", "tight"}, JUDGED),
    "ten times too large": (row(1e-3, 1.1e-2), {"covered"}, JUDGED),
    "thirty times too large": (row(1e-3, 3.1e-2), {"covered", "wide"}, JUDGED),
    "below the eighth digit": (row(0.0, 5e-9, uncertain=0.0), {"covered", "tight"}, JUDGED),
    "missed": (row(-1e-3, 0.9e-3), {"tight"}, JUDGED),
    "covered up to the reference": (row(1e-3, 1e-3 - 1e-10), {"covered", "tight"}, JUDGED),
    "undecided": (row(1e-3, 1e-3, uncertain=2e-4), {"undecided"}, {"undecided"}),
    "missed in any case": (row(1e-3, 1e-4, uncertain=2e-4), {"tight"}, JUDGED),
    "falsely marked": (MARKED, {"apart", "false_marks"}, {"apart", "false_marks"}),
    "rightly marked": (
        row(1e-3, 2e-2, ErrorStatus.NOT_CONVERGED),
        {"apart"},
        {"apart", "false_marks"},
    ),
    "wrongly exact": (row(1e-3, 0.0, ErrorStatus.EXACT), {"tight"}, JUDGED),
    "exact": (row(0.0, 0.0, ErrorStatus.EXACT, uncertain=0.0), {"covered", "tight"}, JUDGED),
}


@pytest.mark.parametrize("name", COUNTED)
def test_each_number_is_counted_once(name):
    one, inside, counted = COUNTED[name]
    shares = (
        Share(int(share in inside), int(share in counted))
        for share in ("covered", "tight", "wide", "apart", "false_marks")
    )
    assert Coverage.of(APPROACH, [one]) == Coverage(
        APPROACH, *shares, int("undecided" in inside), 0
    )


def records(rows: Sequence[Row], ratios: Sequence[float] = ()) -> Mapping[str, CaseRecord]:
    """Records of one scene, and of requests by true error over request."""
    scene, *others = cases(SETTINGS)
    requests = others[-REQUESTS:]
    made = {scene.name: CaseRecord(parameters={"family": "balls"}, parts=tuple(rows))}
    for case, ratio in zip(requests, ratios, strict=False):
        outcome = {"outcome": "met" if ratio else "stopped"}
        made[case.name] = CaseRecord(measures={ASKED: 1e-2, TRUE: 1e-2 * ratio}, words=outcome)
    return made


@pytest.mark.parametrize(
    ("missed", "of", "outcome"),
    [
        (7, 100, Status.PASS),
        (9, 100, Status.FAIL),
        (3, 50, Status.INCONCLUSIVE),
        (6, 50, Status.FAIL),
        (21, 400, Status.PASS),
        (22, 400, Status.FAIL),
    ],
)
def test_a_family_fails_if_its_coverage_is_significantly_below_that_of_all(missed, of, outcome):
    """By the binomial distribution, P(X <= of - missed) < 0.01 at a true fraction of 0.97."""
    rows = [row(1e-3, 2e-3)] * (of - missed) + [row(1e-3, 5e-4)] * missed
    (family,) = (s for s in conclude(SETTINGS, records(rows)).statements if "family" in s.claim)
    assert family.outcome is outcome


@pytest.mark.parametrize(
    ("ratios", "outcome"),
    [
        ([0.5] * 58 + [1.5] * 2, Status.PASS),
        ([0.5] * 57 + [1.5] * 3, Status.FAIL),
        ([0.5] * 59 + [2.5], Status.FAIL),
        ([0.5] * 28 + [1.5] * 2 + [0.0] * 30, Status.FAIL),
        ([0.5] * 59, Status.INCONCLUSIVE),
    ],
)
def test_requests_are_judged_by_true_errors(ratios, outcome):
    *_, statement = conclude(SETTINGS, records([], ratios)).statements
    assert statement.outcome is outcome
