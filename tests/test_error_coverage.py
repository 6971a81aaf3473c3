"""The verdict on stated errors: what it counts, and that it sees an estimator that is wrong."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from contact_errors.error_formula import Comparison
from contact_errors.stress_errors import above_the_middle
from contact_scene.stated_error import ErrorStatus, StatedError
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.problems.drawn.known_scene import APPROACH, Truth
from verification.problems.reference import Reference, ReferenceKind
from verification.running.row import CaseRecord, Row
from verification.running.study import Settings
from verification.studies.error_coverage.case import judged
from verification.studies.error_coverage.coverage import Coverage, Share
from verification.studies.error_coverage.study import ENOUGH, STUDY, cases, conclude

SETTINGS = Settings(Level.STANDARD)


def row(wrong: float, stated: float, status: ErrorStatus = ErrorStatus.ESTIMATED) -> Row:
    """Of an approach of 2."""
    truth = Truth(1, APPROACH, Reference(2.0, ReferenceKind.CLOSED_FORM, "test", 1e-9))
    error = StatedError(error=2 * stated, parts={"cells": 2 * stated}, status=status)
    return judged(truth, 2.0 * (1 + wrong), error)


def worked_example() -> Coverage:
    """Runs that err by ±h²/100 about 2, on cells of side 0.1, with coarse solves on cells of 0.2.

    Either way (0.0004 - 0.0001)/(2^1.2 - 1) = 0.00023 is stated, and 0.0001 is wrong.
    """
    rows = []
    for sign in (-1, 1):
        run, coarse = ([{APPROACH: np.array([2 + sign * h**2 / 100])}] for h in (0.1, 0.2))
        error = Comparison("cells", run, coarse, [2.0]).part_of(0, APPROACH, 2.0)
        assert error is not None
        rows.append(row((run[0][APPROACH][0] - 2) / 2, float(error[0]) / 2))
    return Coverage.of(APPROACH, rows)


def test_the_interval_is_that_of_clopper_and_pearson() -> None:
    assert Share(95, 100).interval == pytest.approx((0.88717, 0.98357), abs=1e-5)
    assert Share(10, 10).interval == pytest.approx((0.69150, 1.0), abs=1e-5)
    assert Share(0, 10).interval == pytest.approx((0.0, 0.30850), abs=1e-5)


def test_covered_is_within_and_tight_is_of_the_size() -> None:
    rows = [row(1e-3, 1.1e-3), row(1e-3, 1.1e-2), row(-1e-3, 0.9e-3), row(1e-3, 1e-3 - 1e-10)]
    found = Coverage.of(APPROACH, rows)
    assert (found.covered.count, found.tight.count) == (3, 3)


def records(rows: Sequence[Row]) -> Mapping[str, CaseRecord]:
    (first, *_) = cases(SETTINGS)
    return {
        first.name: CaseRecord(
            parameters={
                "family": "hertz",
                "homogeneous": True,
                "friction": False,
                "loop": False,
                "solver": "fem",
            },
            parts=tuple(rows),
        )
    }


@pytest.mark.parametrize(
    ("rows", "outcome"),
    [
        ([row(1e-3, 2e-3)] * ENOUGH, Status.PASS),
        ([row(1e-3, 2e-3)] * (ENOUGH - 1), Status.INCONCLUSIVE),
        ([row(1e-3, 2e-3)] * 94 + [row(1e-3, 5e-4)] * 6, Status.FAIL),
        ([row(1e-3, 2e-3)] * 59 + [row(1e-3, 2e-2)] * 41, Status.FAIL),
        (
            [row(1e-3, 2e-3)] * ENOUGH + [row(1e-3, 5e-4, ErrorStatus.NOT_CONVERGED)] * 50,
            Status.PASS,
        ),
    ],
    ids=["good", "too few", "too small", "too large", "not converged is counted apart"],
)
def test_a_kind_is_judged_by_what_is_demanded(rows: list[Row], outcome: Status) -> None:
    found = conclude(SETTINGS, records(rows))
    (statement,) = (s for s in found.statements if s.claim.startswith("approach"))
    assert statement.outcome is outcome


def test_every_case_has_its_own_name() -> None:
    names = [case.name for case in cases(SETTINGS)]
    assert len(set(names)) == len(names) >= 300
    assert STUDY.cases(Settings(Level.QUICK)) == cases(Settings(Level.QUICK))


def _third(part_of: Callable[..., Any]) -> Callable[..., Any]:
    return lambda *of: part_of(*of) / 3


def _exchanged(part_of: Callable[..., Any]) -> Callable[..., Any]:
    """The run takes the place of its coarse solve."""
    return lambda self, *of: part_of(replace(self, coarse=self.base), *of)


def _one_sided(part_of: Callable[..., Any]) -> Callable[..., Any]:
    """An excess of the coarse solve over the run counts as nothing."""

    return lambda self, step, name, order: (
        part_of(self, step, name, order) * (self.base[step][name] > self.coarse[step][name])
    )


def test_an_estimator_that_is_right_covers_what_is_wrong_and_no_more() -> None:
    assert worked_example() == Coverage(APPROACH, Share(2, 2), Share(2, 2))


@pytest.mark.parametrize(
    ("planted", "still_covered"),
    [(_third, 0), (_exchanged, 0), (_one_sided, 1)],
    ids=["a third as large", "a level exchanged", "one-sided"],
)
def test_a_defect_of_the_estimator_is_seen(
    planted: Callable[..., Any], still_covered: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Comparison, "part_of", planted(Comparison.part_of))
    found = worked_example()
    assert found.covered == Share(still_covered, 2)
    assert not found.good


def test_between_three_points_a_parabola_is_highest_at_its_top() -> None:
    """f = 5 - 3 (x - 0.2)² by x = -0.7, 0, 1.1: its top is 3·0.04 above the middle point."""
    x = np.array([-0.7, 0.0, 1.1])
    assert above_the_middle(x, 5 - 3 * (x - 0.2) ** 2) == pytest.approx(0.12)
    assert above_the_middle(x, 5 + 3 * x) == 0
