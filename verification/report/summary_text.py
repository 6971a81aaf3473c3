"""`summary.md`: the report for a pull request."""

from __future__ import annotations

from collections.abc import Iterator

from verification.judging.outcome import CaseOutcome, Status
from verification.judging.status_words import SYMBOLS, WORDS
from verification.judging.verdict_text import clearance_text, failure_line
from verification.report.changes import change_rows, changes_text, origins
from verification.report.counts import counts_text, uncovered_lines
from verification.report.power import power_text
from verification.running.report_record import Report
from verification.running.sources import age_text
from verification.running.study_text import measured_text, study_failure_line

MOST_LINES = 40  # of failures, and of changes: a pull request's comment holds 65 kB


def failure_lines(report: Report) -> list[str]:
    """One line for every failed verdict, and for every failed study of the same sources."""
    lines = [failure_line(case.name, verdict, report.level) for case, verdict in report.failures]
    lines += uncovered_lines(report) if report.errors_too_small else []
    return lines + [study_failure_line(study) for study in report.failed_studies]


def render_summary(report: Report) -> str:
    """Verdict, failures and one row per case, in Markdown."""
    return "\n".join(_lines(report)) + "\n"


def _lines(report: Report) -> Iterator[str]:
    yield f"# {SYMBOLS[report.status]} {WORDS[report.status]}: slipstick verify, {report.level}"
    yield ""
    yield f"{counts_text(report)}, in {len(report.cases)} cases."
    if age := age_text(report.provenance):
        yield f"The report is {age}."
    if power := power_text(report):
        yield f"{power}."
    if report.status is Status.FAIL:
        yield ""
        lines = failure_lines(report)
        yield from (f"- `{line}`" for line in lines[:MOST_LINES])
        if len(lines) > MOST_LINES:
            yield f"- and {len(lines) - MOST_LINES} more"
    elif uncovered := uncovered_lines(report):
        yield ""
        yield from (f"- {line}" for line in uncovered[:MOST_LINES])
    yield ""
    yield from _changes(report)
    yield ""
    if report.studies:
        yield (
            "Studies: "
            + ", ".join(
                f"{study.name} {SYMBOLS[study.status]} {WORDS[study.status]} ({study.level}"
                f"{measured_text(study)})"
                for study in report.studies
            )
            + "."
        )
        yield ""
    yield "| case | verdict | verdicts | closest to its limit |"
    yield "| --- | --- | --- | --- |"
    for case in report.cases:
        status = f"{SYMBOLS[case.status]} {WORDS[case.status]}"
        yield f"| {case.name} | {status} | {len(case.verdicts)} | {_closest(case)} |"


def _closest(case: CaseOutcome) -> str:
    """The verdict that uses most of what is allowed."""
    known = [verdict for verdict in case.verdicts if verdict.clearance is not None]
    if not known:
        return "–"
    worst = max(known, key=lambda verdict: verdict.clearance or 0.0)
    return f"{worst.name} [{worst.run}]: {clearance_text(worst)}"


def _changes(report: Report) -> Iterator[str]:
    """What is new since the baseline."""
    yield f"Since the baseline: {changes_text(report)}."
    for origin, names in origins(report):
        text = f"- {len(names)} of the cases: {origin.name}, {origin.date[:10]}, {origin.reason}"
        yield f"{text}; differs here: {'; '.join(origin.differs)}" if origin.differs else text
    rows = change_rows(report)
    if not rows:
        return
    yield ""
    yield "| change | quantity | was | is | moved by | remark |"
    yield "| --- | --- | --- | --- | --- | --- |"
    for row in rows[:MOST_LINES]:
        quantity = f"{row.case}/{row.name} [{row.run}]"
        cells = (row.kind, quantity, row.was, row.now, row.moved, row.remark)
        yield f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"
    if len(rows) > MOST_LINES:
        yield ""
        yield f"and {len(rows) - MOST_LINES} more; `slipstick maintain compare` lists them."
