"""Errors that solvers state are judged, and tolerances follow the errors."""

from __future__ import annotations

from pathlib import Path

import pytest
from command import slipstick

from slipstick.cli.commands.compare import exit_code_of
from verification.cases.hertz import hertz_point
from verification.judging.case import Level
from verification.judging.change import ChangeKind
from verification.judging.declared_case import Within, case, judged
from verification.judging.judgement import judge
from verification.judging.observables import APPROACH, CONTACT_RADIUS, PEAK_PRESSURE
from verification.judging.outcome import CaseOutcome, Status, Verdict
from verification.judging.refinement_levels import (
    RefinementLevels,
    on_cells,
    on_elements,
    on_radii,
)
from verification.problems.hertz import BALL
from verification.regression import tolerances
from verification.regression.acceptance import baselines_of
from verification.regression.baseline_files import read_baselines
from verification.regression.comparison import compared
from verification.regression.refusal import BaselineRefused
from verification.regression.tolerances import (
    LEAST,
    Acceptance,
    Tolerance,
    Tolerances,
    accept_tolerances,
    held_to,
    proposed,
    read_tolerances,
    text_of,
)
from verification.report.summary_text import counts_text, uncovered_lines
from verification.running.report_record import Provenance, Report, count, load_report

COMMIT = "1a2b3c4d5e6f708192a3b4c5d6e7f8091a2b3c4d"
LADDERS = {
    "cells": on_cells(BALL, (32,)),
    "elements": on_elements(BALL, (12,)),
    "radii": on_radii(BALL, "ball"),
}


def report_of(*cases: CaseOutcome, kernel: str = "Haswell", level: str = "quick") -> Report:
    return Report(
        level=level,
        counts=count(cases),
        cases=cases,
        omissions=(),
        provenance=Provenance(
            program_version="0.1.0", commit=COMMIT, changed=False, command="slipstick verify",
            date="2026-11-21T12:00:00+00:00", machine={"arithmetic": kernel}, libraries={},
            seconds={},
        ),
    )  # fmt: skip


@pytest.fixture(scope="module")
def outcome() -> CaseOutcome:
    return settled(judge(hertz_point(cells=(32, 48, 64))).model_copy(update={"charts": ()}), 0.0)


def settled(outcome: CaseOutcome, change: float) -> CaseOutcome:
    """The case with this last change of the edge correction in all runs."""
    runs = tuple(run.model_copy(update={"edge_change": change}) for run in outcome.runs)
    return outcome.model_copy(update={"runs": runs})


def changed(
    outcome: CaseOutcome, *, times: float = 1.0, covered: bool | None = None
) -> CaseOutcome:
    """The case with errors so many times as large, or with stated errors that (do not) cover."""

    def one(v: Verdict) -> Verdict:
        if covered is not None:
            return v if v.covered is None else v.model_copy(update={"covered": covered})
        if v.error is None or v.value is None or v.tolerance_kind == "order":
            return v
        error = times * v.error
        status = Status.PASS if error <= v.allowed else Status.FAIL
        value = v.reference + times * (v.value - v.reference)
        return v.model_copy(update={"error": error, "value": value, "status": status})

    return outcome.model_copy(update={"verdicts": tuple(map(one, outcome.verdicts))})


# ---- stated errors -----------------------------------------------------------------------------


@pytest.mark.parametrize("ladder", LADDERS.values(), ids=LADDERS)
def test_each_solver_states_the_errors_of_judged_scalars(ladder: RefinementLevels) -> None:
    rows = [Within(what, 1.0, "why") for what in (APPROACH, CONTACT_RADIUS, PEAK_PRESSURE)]
    planted = case("planted", "title", "problem", judged(ladder, rows))
    found = judge(planted).verdicts
    stated = [verdict for verdict in found if verdict.stated_error is not None]
    assert [verdict.name for verdict in stated] == [row.what.name for row in rows]
    assert all(verdict.covered for verdict in stated)


def test_a_stated_error_that_is_too_small_is_named_and_red(outcome: CaseOutcome) -> None:
    good, poor = report_of(outcome), report_of(changed(outcome, covered=False))
    assert uncovered_lines(good) == []
    lines = uncovered_lines(poor)
    assert lines[0].startswith("UNCOVERED hertz_point/")
    assert f"0 of {len(lines)} stated errors cover" in counts_text(poor)
    report = compared(poor, baselines_of(good, "why"))
    kinds = [
        v.regression.kind for v in report.cases[0].verdicts if v.regression and v.covered is False
    ]
    assert set(kinds) == {ChangeKind.WORSE}
    assert exit_code_of(report) == 7
    assert exit_code_of(compared(good, baselines_of(good, "why"))) == 0


@pytest.mark.parametrize(("uncovered", "status"), [(1, Status.PASS), (2, Status.FAIL)])
def test_a_full_report_needs_95_percent(
    outcome: CaseOutcome, uncovered: int, status: Status
) -> None:
    one = next(verdict for verdict in outcome.verdicts if verdict.covered)
    verdicts = [
        one.model_copy(update={"name": f"number {n}", "covered": n >= uncovered}) for n in range(20)
    ]
    case = outcome.model_copy(update={"verdicts": tuple(verdicts)})
    assert report_of(case, level="full").status is status
    assert report_of(case).status is Status.PASS


# ---- tolerances --------------------------------------------------------------------------------


def test_accepted_tolerances_are_twice_the_largest_error_over_kernels(
    outcome: CaseOutcome, tmp_path: Path
) -> None:
    reports = [report_of(outcome), report_of(changed(outcome, times=1.2), kernel="SkylakeX")]
    count = accept_tolerances(reports, "as  derived", tmp_path)
    known = read_tolerances("quick", tmp_path)
    (acceptance,) = known.accepted
    assert (acceptance.because, acceptance.kernels) == ("as derived", ("Haswell", "SkylakeX"))
    (held,) = held_to([outcome], known)
    assert count == sum(verdict.bound is not None for verdict in held.verdicts) > 1
    for verdict, was in zip(held.verdicts, outcome.verdicts, strict=True):
        assert verdict.status is was.status
        if verdict.bound is None:
            slack = was.error is not None and was.allowed > 3 * max(1.2 * was.error, LEAST)
            assert was.tolerance_kind == "order" or not slack
            continue
        assert was.error is not None
        assert verdict.bound == was.allowed
        assert verdict.allowed == pytest.approx(2.4 * was.error + LEAST, rel=0.05)
    (worse,) = held_to([changed(outcome, times=3)], known)
    failed = [v for v in worse.verdicts if v.bound is not None and v.error > 4 * LEAST]
    assert failed
    assert all(verdict.status is Status.FAIL for verdict in failed)
    assert proposed([report_of(held)]) == {}


def test_a_tolerance_allows_for_the_last_change_of_the_edge_correction(
    outcome: CaseOutcome,
) -> None:
    settled_at = [proposed([report_of(settled(outcome, change))]) for change in (0.0, 1e-6, 1.0)]
    exact, loose, unsettled = (found.get(outcome.name, {}) for found in settled_at)
    assert unsettled == {}
    assert loose
    for key, tolerance in loose.items():
        assert tolerance.allowed == pytest.approx(2 * tolerance.error + LEAST + 0.5e-6, rel=0.05)
        assert tolerance.allowed >= exact[key].allowed


def test_a_tolerance_never_exceeds_the_bound_of_its_case(outcome: CaseOutcome) -> None:
    reports = [report_of(changed(outcome, times=1e6))]
    assert proposed(reports) == {}
    one = outcome.verdicts[0]
    wide = {"allowed": 2 * one.allowed, "error": one.allowed}
    known = Tolerances.model_validate(
        {"level": "quick", "accepted": [{"because": "why", "commit": None, "kernels": [],
         "tolerances": {outcome.name: {text_of(one): wide}}}]}
    )  # fmt: skip
    assert held_to([outcome], known) == (outcome,)


def test_tolerances_need_a_reason_and_one_level(outcome: CaseOutcome, tmp_path: Path) -> None:
    with pytest.raises(BaselineRefused, match="reason"):
        accept_tolerances([report_of(outcome)], " ", tmp_path)
    with pytest.raises(BaselineRefused, match="name one level"):
        proposed([report_of(outcome), report_of(outcome, level="full")])
    (tmp_path / "quick.json").write_text("{")
    with pytest.raises(BaselineRefused, match="are damaged"):
        read_tolerances("quick", tmp_path)


@pytest.mark.parametrize("level", [level.name.lower() for level in Level])
def test_every_accepted_tolerance_belongs_to_a_recorded_number(level: str) -> None:
    """A number that gets another name loses its tolerance, unless that is accepted anew."""
    recorded = {
        (case, f"{quantity.name} [{quantity.key[2]}] {quantity.tolerance_kind}")
        for case, baseline in read_baselines().items()
        if level in baseline.levels
        for quantity in baseline.levels[level].quantities
    }
    accepted = read_tolerances(level).accepted
    assert all(one.because for one in accepted)
    named = [pair for one in accepted for pair in one.tolerances.items()]
    assert {(case, key) for case, keys in named for key in keys} <= recorded


def test_verify_judges_by_the_accepted_tolerances(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Below each error, so that every number fails that passes by the bound of its case."""
    verify = ("verify", "dissimilar_bodies", "--output", tmp_path)
    assert slipstick(*verify) == 0
    measured = load_report(tmp_path / "report.json").cases[0]
    tight = {text_of(v): Tolerance(allowed=0.9 * v.error, error=0.45 * v.error)
             for v in measured.verdicts if v.error and v.error > LEAST}  # fmt: skip
    accepted = Acceptance(because="why", commit=None, kernels=(), tolerances={measured.name: tight})
    known = Tolerances(level="quick", accepted=(accepted,))
    monkeypatch.setattr(tolerances, "read_tolerances", lambda level: known)
    assert slipstick(*verify) == 1
    failed = capsys.readouterr().out.count("\nFAIL dissimilar_bodies/")
    assert failed >= len(tight) - 1 > 1
