"""Every number of a report against the recorded one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from verification.judging.change import Change, Gone, GoneCase, Origin, commit_text
from verification.regression.baseline import (
    Baseline,
    Key,
    RecordedBy,
    RecordedFinding,
    RecordedQuantity,
    Recording,
    key_of,
    recorded_by,
)
from verification.regression.counters import counter_changes
from verification.regression.number_change import finding_change, quantity_change
from verification.regression.refusal import BaselineRefused

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.running.report_record import Report


def compared(report: Report, baselines: Mapping[str, Baseline]) -> Report:
    """The report with its verdicts on regression; an earlier comparison in it is replaced.

    A case without a baseline of the report's level has none: `CaseOutcome.baseline` is None. What
    is recorded of the level and not in the report is gone, unless its cases were chosen.
    """
    made_by = recorded_by(report.provenance, reason="")
    cases = tuple(
        _compared(case, _recording(baselines.get(case.name), report.level), made_by)
        for case in report.cases
    )
    return report.model_copy(
        update={
            "cases": cases,
            "gone": tuple(_gone_cases(report, baselines)),
        }
    )


def refuse_if_not_whole(report: Report, baselines: Mapping[str, Baseline]) -> None:
    """Raise BaselineRefused, with the names, if chosen cases alone ran and others are recorded."""
    missing = [name for name, _ in _missing(report, baselines)] if report.chosen else []
    if missing:
        raise BaselineRefused(
            f"the report is of chosen cases; {len(missing)} that are recorded at level "
            f"{report.level} were not run: {', '.join(missing)}; --chosen compares those that were"
        )


def _gone_cases(report: Report, baselines: Mapping[str, Baseline]) -> Iterator[GoneCase]:
    for name, recorded in () if report.chosen else _missing(report, baselines):
        since = commit_text(recorded.by.commit, changed=recorded.by.changed)
        yield GoneCase(name=name, since=since)


def _missing(report: Report, baselines: Mapping[str, Baseline]) -> Iterator[tuple[str, Recording]]:
    """What is recorded at the report's level of cases that it does not have, by name."""
    present = {case.name for case in report.cases}
    for name, baseline in sorted(baselines.items()):
        recorded = _recording(baseline, report.level)
        if recorded is not None and name not in present:
            yield name, recorded


def _recording(baseline: Baseline | None, level: str) -> Recording | None:
    return None if baseline is None else baseline.levels.get(level)


def _compared(case: CaseOutcome, recorded: Recording | None, made_by: RecordedBy) -> CaseOutcome:
    if recorded is None:
        return _without_comparison(case)
    origin = Origin(
        commit=recorded.by.commit,
        changed=recorded.by.changed,
        date=recorded.by.date,
        reason=recorded.by.reason,
        differs=tuple(_differences(recorded.by, made_by)),
    )
    quantities = {quantity.key: quantity for quantity in recorded.quantities}
    findings = {finding.key: finding for finding in recorded.findings}
    verdicts = tuple(
        verdict.model_copy(
            update={"regression": quantity_change(verdict, quantities.get(key_of(verdict)), origin)}
        )
        for verdict in case.verdicts
    )
    measured = tuple(
        finding.model_copy(
            update={"regression": finding_change(finding, findings.get(key_of(finding)), origin)}
        )
        for finding in case.findings
    )
    return case.model_copy(
        update={
            "baseline": origin,
            "verdicts": verdicts,
            "findings": measured,
            "counts": tuple(counter_changes(case, recorded)),
            "gone": tuple(_gone(case, recorded)),
        }
    )


def _without_comparison(case: CaseOutcome) -> CaseOutcome:
    nothing: Change | None = None
    return case.model_copy(
        update={
            "baseline": None,
            "verdicts": tuple(v.model_copy(update={"regression": nothing}) for v in case.verdicts),
            "findings": tuple(f.model_copy(update={"regression": nothing}) for f in case.findings),
            "counts": (),
            "gone": (),
        }
    )


def _gone(case: CaseOutcome, recorded: Recording) -> Iterator[Gone]:
    present: set[Key] = {key_of(verdict) for verdict in case.verdicts}
    present |= {key_of(finding) for finding in case.findings}
    numbers: tuple[RecordedQuantity | RecordedFinding, ...] = (
        *recorded.quantities,
        *recorded.findings,
    )
    for number in numbers:
        if number.key not in present:
            yield Gone(name=number.name, run=number.run, unit=number.unit, was=number.value)
    labels = {run.label for run in case.runs}
    for run in recorded.runs:
        if run.label not in labels:
            yield Gone(name="run", run=run.label, unit="", was=None)


def _differences(then: RecordedBy, now: RecordedBy) -> Iterator[str]:
    """What explains other last digits: processor, Python and libraries."""
    facts = [("processor", then.processor, now.processor), ("Python", then.python, now.python)]
    for name in sorted(then.libraries.keys() | now.libraries.keys()):
        facts.append((name, then.libraries.get(name), now.libraries.get(name)))
    for name, was, here in facts:
        if was != here:
            yield f"{name}: {here or 'none'}, was {was or 'none'}"
