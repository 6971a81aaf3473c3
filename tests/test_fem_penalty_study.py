"""The study of the penalty: what it computes, and that its statements can fail."""

from collections.abc import Callable
from math import pi

import pytest

from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.row import CaseRecord, parameters_of
from verification.running.study import Conclusion, Settings
from verification.studies.penalty.case import HERTZIAN, PenaltyCase
from verification.studies.penalty.study import STUDY

SETTINGS = Settings(Level.QUICK)
Change = Callable[[PenaltyCase, CaseRecord], CaseRecord]


def ideal(case: PenaltyCase) -> CaseRecord:
    """What springs in series with an exact mesh would give."""
    k = case.springs_per_radius
    left = 1 / k if case.augmentations == 0 else 1e-3 / k
    frictionless = case.contact == HERTZIAN
    errors = {"peak": -0.54 * left, "ripple": 1e-2} if frictionless else {"shear": 1e-3}
    return CaseRecord(
        parameters=parameters_of(case) | {"springs_per_radius": k},
        measures={
            "approach": left / pi + 1e-7,
            "pressure": left,
            **errors,
            "overlap": left,
            "systems_per_increment": 10.0,
            "largest_residual": 1e-10,
        },
        counters={
            "increments": 1 if frictionless else case.increments,
            "halvings": 0,
            "by_springs": 1,
            "systems": 10,
        },
        seconds=1.0,
    )


def concluded(change: Change = lambda case, record: record) -> Conclusion:
    records = {case.name: change(case, ideal(case)) for case in STUDY.cases(SETTINGS)}
    return STUDY.conclude(SETTINGS, records)


def failed(conclusion: Conclusion) -> list[str]:
    return [s.claim for s in conclusion.statements if s.outcome is Status.FAIL]


def test_every_case_has_a_name_of_its_own() -> None:
    for level in Level:
        names = [case.name for case in STUDY.cases(Settings(level))]
        assert len(set(names)) == len(names)


def test_ideal_springs_pass() -> None:
    conclusion = concluded()
    assert not conclusion.failed
    assert all(s.outcome in (Status.PASS, None) for s in conclusion.statements)
    assert len(conclusion.charts) == 5
    assert all(panel.curves for c in conclusion.charts for row in c.rows for panel in row)


@pytest.mark.parametrize(
    ("update", "claim"),
    [
        ({"largest_residual": 2e-8}, "every increment converges"),
        ({"approach": 5e-3}, "springs alone make the approach"),
        ({"peak": -3e-3}, "Hertz at c = 10"),
        ({"shear": 4e-2}, "pressing with friction"),
    ],
)
def test_every_judged_statement_can_fail(update: dict[str, float], claim: str) -> None:
    conclusion = concluded(
        lambda case, record: record.model_copy(update={"measures": record.measures | update})
    )
    assert any(text.startswith(claim) for text in failed(conclusion))


def test_missing_cases_leave_it_open() -> None:
    conclusion = STUDY.conclude(SETTINGS, {})
    judged = [s.outcome for s in conclusion.statements if s.outcome is not None]
    assert set(judged) == {Status.INCONCLUSIVE}
    assert conclusion.charts == ()


def test_case_measures_its_errors() -> None:
    bare, augmented = (PenaltyCase(HERTZIAN, 8, 10.0, n).compute() for n in (0, 1))
    k = PenaltyCase(HERTZIAN, 8, 10.0, 0).springs_per_radius
    assert bare.parameters["springs_per_radius"] == k
    assert value(bare, "approach") * k == pytest.approx(1 / pi, rel=0.1)
    assert abs(value(augmented, "approach")) < 0.1 * value(bare, "approach")
    assert value(augmented, "overlap") < 0.2 * value(bare, "overlap")
    frictional = PenaltyCase("weak", 8, increments=3).compute()
    assert frictional.counters["increments"] == 3
    assert "shear" in frictional.measures
    assert value(frictional, "largest_residual") <= 1e-8


def value(record: CaseRecord, name: str) -> float:
    found = record.measures[name]
    assert found is not None
    return found
