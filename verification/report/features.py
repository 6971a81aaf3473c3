"""What the program promises, each promise in one line with the figures of this report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from verification.exhibits.numbers import plain
from verification.judging.outcome import CaseOutcome, RunRecord, Status
from verification.report.files import SHEETS
from verification.report.prices import cost_sentence
from verification.report.sections import study_section
from verification.running.record import StudyRecord
from verification.running.report_record import Report

FORCED = "forced_effects"


@dataclass(frozen=True)
class Feature:
    """A promise.

    status   None where this report has nothing on it
    figures  what was found, or the command that finds it
    anchor   of what shows it
    page     that it is on; empty for the front
    """

    promise: str
    status: Status | None
    figures: str
    anchor: str
    page: str = ""

    @property
    def address(self) -> str:
        """As seen from the front."""
        return f"{self.page}#{self.anchor}"


def features(report: Report) -> tuple[Feature, ...]:
    """Planning, accuracy and its cost, stability, stated errors."""
    return (
        _planned(report),
        _studied(report, "Know what accuracy costs", "work-precision", cost_sentence),
        _studied(report, "Stay stable in hard cases", "stability"),
        _studied(report, "State an error for every number, and keep it", "error-coverage"),
    )


def _planned(report: Report) -> Feature:
    promise = "Simulate only the effects that a scene calls for"
    case = next((case for case in report.cases if case.name == FORCED), None)
    pairs = {} if case is None else _pairs(case)
    ratios = [
        run.convolutions / plan.convolutions for run, plan in pairs.values() if plan.convolutions
    ]
    if case is None or not ratios:
        command = f"slipstick verify {FORCED} --level {report.level}"
        return Feature(promise, None, f"not in this report; {command} measures it", "cases")
    errors = [verdict.error for verdict in case.verdicts if frozenset(verdict.runs) in pairs]
    apart = max((error for error in errors if error is not None), default=0.0)
    return Feature(
        promise,
        case.status,
        f"with every effect forced on, {len(ratios)} scenes give the same answer within "
        f"{plain(apart, 2)} and take {plain(min(ratios), 2)} to {plain(max(ratios), 2)} times the "
        "convolutions",
        FORCED,
        SHEETS,
    )


def _pairs(case: CaseOutcome) -> dict[frozenset[str], tuple[RunRecord, RunRecord]]:
    """Runs with effects forced on, each with the one as planned, by the labels of both."""
    runs = {run.label: run for run in case.runs}
    return {
        frozenset((run.label, run.planned)): (run, runs[run.planned])
        for run in case.runs
        if run.planned in runs
    }


def _studied(
    report: Report, promise: str, name: str, short: Callable[[StudyRecord], str] = lambda _: ""
) -> Feature:
    """What a study says in short or answers; what it judged, where it does neither."""
    section = study_section(report, name)
    anchor = f"study-{name}"
    if section.record is None:
        return Feature(promise, None, f"not in this report; {section.command} finds it", anchor)
    said = short(section.record) or _found(section.record)
    return Feature(promise, section.record.status, said, anchor)


def _found(record: StudyRecord) -> str:
    conclusion = record.conclusion
    if conclusion.answer:
        return f"{conclusion.answer} (level {record.level})"
    return claims_line(record)


def claims_line(record: StudyRecord) -> str:
    """How many of the claims of a study hold."""
    judged = [s.outcome for s in record.conclusion.statements if s.outcome is not None]
    good = judged.count(Status.PASS)
    return f"{good} of its {len(judged)} judged claims hold (level {record.level})"
