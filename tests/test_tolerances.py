"""Tests of accepted tolerances: they follow the errors and never exceed the bound of a case."""

from __future__ import annotations

from pathlib import Path

import pytest
from report_examples import report_by

from verification.cases.indenters import hertz_point
from verification.judging.case import SOLVER_TOLERANCE, Level
from verification.judging.judgement import judge
from verification.judging.outcome import (
    CaseOutcome,
    Status,
    Verdict,
)
from verification.regression.baseline import BaselineRefused, read_baselines
from verification.regression.tolerances import (
    LEAST,
    MOVED,
    Tolerances,
    accept_tolerances,
    held_to,
    proposed,
    read_tolerances,
    text_of,
)


@pytest.fixture(scope="module")
def outcome() -> CaseOutcome:
    return settled(judge(hertz_point(cells=(32, 48, 64))).model_copy(update={"charts": ()}), 0.0)


def settled(outcome: CaseOutcome, change: float) -> CaseOutcome:
    """The case with this last change of the edge correction in all runs."""
    runs = tuple(run.model_copy(update={"edge_change": change}) for run in outcome.runs)
    return outcome.model_copy(update={"runs": runs})


def changed(outcome: CaseOutcome, times: float) -> CaseOutcome:
    """The case with errors so many times as large."""

    def one(v: Verdict) -> Verdict:
        if v.error is None or v.value is None or v.tolerance_kind == "order":
            return v
        error = times * v.error
        status = Status.PASS if error <= v.allowed else Status.FAIL
        value = v.reference + times * (v.value - v.reference)
        return v.model_copy(update={"error": error, "value": value, "status": status})

    return outcome.model_copy(update={"verdicts": tuple(map(one, outcome.verdicts))})


FLOOR = LEAST * SOLVER_TOLERANCE  # of errors of a run without edge correction


def test_accepted_tolerances_are_twice_the_largest_error_over_kernels(
    outcome: CaseOutcome, tmp_path: Path
) -> None:
    reports = [
        report_by(outcome, machine={"arithmetic": "Haswell"}),
        report_by(changed(outcome, 1.2), machine={"arithmetic": "SkylakeX"}),
    ]
    count = accept_tolerances(reports, "as  derived", tmp_path)
    known = read_tolerances("quick", tmp_path)
    assert [(one.because, one.kernels) for one in known.accepted] == [
        ("as derived", ("Haswell", "SkylakeX"))
    ]
    (held,) = held_to([outcome], known)
    assert count == sum(verdict.bound is not None for verdict in held.verdicts) > 1
    for verdict, was in zip(held.verdicts, outcome.verdicts, strict=True):
        assert verdict.status is was.status
        if verdict.bound is None:
            slack = was.error is not None and was.allowed > 3 * max(1.2 * was.error, FLOOR)
            assert was.tolerance_kind == "order" or not slack
            continue
        assert was.error is not None
        assert verdict.bound == was.allowed
        assert verdict.allowed == pytest.approx(2.4 * was.error + FLOOR, rel=0.05)
    (worse,) = held_to([changed(outcome, 3)], known)
    failed = [v for v in worse.verdicts if v.bound is not None and v.error > 4 * FLOOR]
    assert failed
    assert all(verdict.status is Status.FAIL for verdict in failed)
    uncertain = tuple(
        v.model_copy(update={"reference_uncertainty": 0.6 * v.allowed * v.scale})
        for v in outcome.verdicts
    )
    (held,) = held_to([outcome.model_copy(update={"verdicts": uncertain})], known)
    for verdict, was in zip(held.verdicts, outcome.verdicts, strict=True):
        assert verdict.allowed == (0.6 if verdict.bound else 1.0) * was.allowed


def test_a_tolerance_allows_for_the_last_change_of_the_edge_correction(
    outcome: CaseOutcome,
) -> None:
    settled_at = [proposed([report_by(settled(outcome, change))]) for change in (0.0, 1e-6, 1.0)]
    exact, loose, unsettled = (found.get(outcome.name, {}) for found in settled_at)
    assert unsettled == {}
    assert loose
    for key, tolerance in loose.items():
        assert tolerance.allowed == pytest.approx(
            2 * tolerance.error + FLOOR + MOVED * 1e-6, rel=0.05
        )
        assert tolerance.allowed >= exact[key].allowed


def test_a_tolerance_never_exceeds_the_bound_of_its_case(outcome: CaseOutcome) -> None:
    reports = [report_by(changed(outcome, 1e6))]
    assert proposed(reports) == {}
    one = outcome.verdicts[0]
    wide = {"allowed": 2 * one.allowed, "error": one.allowed}
    of_case = {outcome.name: {text_of(one): wide}}
    accepted = {"because": "why", "commit": None, "kernels": [], "tolerances": of_case}
    known = Tolerances.model_validate({"level": "quick", "accepted": [accepted]})
    assert held_to([outcome], known) == (outcome,)


def test_a_damaged_file_of_tolerances_is_named(tmp_path: Path) -> None:
    (tmp_path / "quick.json").write_text("{")
    with pytest.raises(BaselineRefused, match=r"quick\.json is damaged: got no JSON"):
        read_tolerances("quick", tmp_path)


@pytest.mark.parametrize("level", [level.name.lower() for level in Level])
def test_every_accepted_tolerance_belongs_to_a_recorded_number(level: str) -> None:
    """A number that gets another name loses its tolerance, unless that is accepted anew."""
    recorded = {
        (case, f"{quantity.name} [{quantity.key[1]}] {quantity.tolerance_kind}")
        for case, baseline in read_baselines().items()
        if level in baseline.levels
        for quantity in baseline.levels[level].quantities
    }
    accepted = read_tolerances(level).accepted
    assert all(one.because for one in accepted)
    named = [pair for one in accepted for pair in one.tolerances.items()]
    assert {(case, key) for case, keys in named for key in keys} <= recorded
