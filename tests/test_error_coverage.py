"""Tests of the study of stated errors: its counts of covered, tight and marked errors."""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from contact_scene.quantities.stated_error import (
    ErrorStatus,
    StatedError,
)
from verification.judging.case import Level
from verification.problems.drawn.drawing import APPROACH, Truth
from verification.problems.problem import Reference, ReferenceKind
from verification.running.study import Row, Settings
from verification.studies.error_coverage import (
    Coverage,
    Share,
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
    truth = Truth(1, APPROACH, Reference(2.0, ReferenceKind.CLOSED_FORM, "test", 2 * uncertain))
    error = StatedError(error=2 * stated, parts={"cells": 2 * stated}, status=status)
    return coverage_row(truth, 2.0 * (1 + wrong), error)


def coverage(rows: Sequence[Row]) -> Coverage:
    return Coverage.of(APPROACH, rows)


def test_the_interval_is_that_of_clopper_and_pearson() -> None:
    assert Share(95, 100).interval == pytest.approx((0.88717, 0.98357), abs=1e-5)
    assert Share(10, 10).interval == pytest.approx((0.69150, 1.0), abs=1e-5)
    assert Share(0, 10).interval == pytest.approx((0.0, 0.30850), abs=1e-5)


MARKED = row(1e-3, 2e-3, ErrorStatus.NOT_CONVERGED)
JUDGED = {"covered", "tight", "wide", "false_marks"}
# A number, the shares that it belongs to, and those in which it counts.
COUNTED: dict[str, tuple[Row, set[str], set[str]]] = {
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
def test_each_number_is_counted_once(name: str) -> None:
    one, inside, counted = COUNTED[name]
    shares = (
        Share(int(share in inside), int(share in counted))
        for share in ("covered", "tight", "wide", "apart", "false_marks")
    )
    assert coverage([one]) == Coverage(APPROACH, *shares, int("undecided" in inside), 0)
