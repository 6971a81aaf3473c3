"""Error budgets: the parts of an error, and what refining takes off them."""

from __future__ import annotations

from dataclasses import fields

import pytest

from contact_results.figures import style
from verification.cases.catalogue import CASES
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.report.drawing import draw
from verification.running.row import CaseRecord, value_of
from verification.running.study import Settings
from verification.studies.error_budget.budget import (
    BUDGETS,
    DOMAIN,
    INCREMENTS,
    MESH,
    SPRINGS,
    TOLERANCE,
    TOTAL,
    Budget,
    parts_of,
)
from verification.studies.error_budget.study import STUDY, cases, chart
from verification.studies.work_precision.contacts import CONTACTS
from verification.studies.work_precision.setting import Method, PrecisionCase

SETTINGS = Settings(Level.QUICK)


def measured(case: PrecisionCase, mesh: float = 1.0, tolerance: float = 0.0) -> CaseRecord:
    """An error that is the sum of known parts: h², 1/k and the solver's tolerance."""
    increments = 0.1 / case.increments if case.increments else 0.0
    error = mesh / case.fineness**2 + increments + tolerance * case.tolerance
    return CaseRecord(measures=dict.fromkeys(CONTACTS[case.contact].errors, error))


def records(**options: float) -> dict[str, CaseRecord]:
    return {case.name: measured(case, **options) for case in cases(SETTINGS)}


@pytest.mark.parametrize("budget", BUDGETS, ids=lambda budget: str(budget.case))
def test_one_choice_is_refined_at_a_time(budget: Budget) -> None:
    base = budget.base(Level.QUICK)
    for name, finer in budget.refined(Level.QUICK).items():
        changed = {f.name for f in fields(base) if getattr(base, f.name) != getattr(finer, f.name)}
        expected = {
            MESH: {"fineness"}, INCREMENTS: {"increments"}, SPRINGS: {"penalty"},
            TOLERANCE: {"tolerance"},
            DOMAIN: {"box"} if base.by_sections else {"window", "fineness"},
        }  # fmt: skip
        assert changed == expected[name]


@pytest.mark.parametrize("budget", BUDGETS, ids=lambda budget: str(budget.case))
def test_a_larger_window_keeps_the_cells(budget: Budget) -> None:
    base, wide = budget.base(Level.QUICK), budget.refined(Level.QUICK)[DOMAIN]
    if budget.method is Method.SURFACE:
        assert wide.window / wide.fineness == base.window / base.fineness


def test_every_budget_belongs_to_a_case_of_the_catalogue() -> None:
    assert {budget.case for budget in BUDGETS} <= set(CASES)


def test_parts_are_what_refinement_takes_off() -> None:
    budget = next(b for b in BUDGETS if b.case == "frictional_indentation")
    base = budget.base(Level.QUICK)
    found = {case: measured(case) for case in budget.cases(Level.QUICK)}
    for part in parts_of(budget, Level.QUICK, found):
        assert part.measures[TOTAL] == pytest.approx(1 / base.fineness**2 + 0.1 / base.increments)
        assert part.measures[MESH] == pytest.approx(0.75 / base.fineness**2)
        assert part.measures[INCREMENTS] == pytest.approx(0.05 / base.increments)
        assert part.measures[TOLERANCE] == 0
        assert part.words["largest"] == INCREMENTS


def test_parts_shrink_when_refined() -> None:
    budget = next(b for b in BUDGETS if b.case == "hertz_point")
    case = PrecisionCase("hertz", Method.SURFACE, 16)
    rows = {n: PrecisionCase("hertz", Method.SURFACE, n).compute() for n in (16, 32, 64)}
    assert budget.contact == case.contact
    for name in case.solved.errors:
        coarse, middle, fine = (value_of(rows[n], name) for n in (16, 32, 64))
        assert abs(middle - fine) < abs(coarse - middle)


def test_a_lost_refinement_leaves_its_part_out() -> None:
    budget = BUDGETS[0]
    found = {case: measured(case) for case in budget.cases(Level.QUICK)}
    del found[budget.refined(Level.QUICK)[DOMAIN]]
    (first, *_) = parts_of(budget, Level.QUICK, found)
    assert DOMAIN not in first.measures
    assert MESH in first.measures
    del found[budget.base(Level.QUICK)]
    assert parts_of(budget, Level.QUICK, found) == ()


def test_the_study_passes_on_known_parts_and_fails_on_a_loose_solver() -> None:
    good = STUDY.conclude(SETTINGS, records())
    assert not good.failed
    assert [c.name for c in good.charts] == [f"budget_{b.case}" for b in BUDGETS]
    loose = STUDY.conclude(SETTINGS, records(tolerance=1e5))
    failed = [s.claim for s in loose.statements if s.outcome is Status.FAIL]
    assert failed == ["the solver's tolerance is no part of any error"]
    assert STUDY.conclude(SETTINGS, {}).failed


@pytest.mark.parametrize("budget", BUDGETS[:1], ids=lambda budget: str(budget.case))
def test_a_budget_is_drawn_with_a_row_for_every_part(budget: Budget) -> None:
    found = {case: measured(case) for case in budget.cases(Level.QUICK)}
    shown = chart(budget, parts_of(budget, Level.QUICK, found))
    assert len(shown.rows[0][0].y_places) == len(budget.refined(Level.QUICK)) + 1
    with style.figure_style():
        assert draw(shown).axes
