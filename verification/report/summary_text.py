"""Texts of a verification report: Markdown summary for a pull request, JUnit table, log lines."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree

from verification.exhibits.chart import value_text
from verification.judging.outcome import (
    SYMBOLS,
    WORDS,
    CaseOutcome,
    Status,
    Verdict,
    clearance_text,
    failure_line,
    judged_errors,
)
from verification.problems.problem import ReferenceKind
from verification.regression.comparison import NOISE
from verification.report.changes import case_rows, change_rows, changes_text, origins
from verification.running.report_record import Report
from verification.running.sources import age_text, is_current
from verification.running.study import measured_text, study_failure_line

MAX_LINES = 40  # of failures, and of changes: a pull request's comment holds 65 kB
TIMES = (3.0, 10.0)  # factors of an error that a verdict should detect
OUTSIDE = {
    ReferenceKind.CLOSED_FORM, ReferenceKind.SEMI_CLOSED, ReferenceKind.THEORY,
    ReferenceKind.EXTERNAL_CODE,
}  # fmt: skip


def counts_text(report: Report) -> str:
    """Summarise a report in one line: numbers of verdicts by status, covering stated errors, and
    studies."""
    found = [verdict.covered for _, verdict in judged_errors(report.cases)]
    failed = len(report.failed_studies)
    older = sum(study.status is Status.FAIL for study in report.studies) - failed
    open_ = sum(study.status is Status.INCONCLUSIVE for study in report.studies)
    parts = [
        ", ".join(f"{report.counts[status]} {word}" for status, word in (
            (Status.PASS, "passed"), (Status.FAIL, "failed"), (Status.INCONCLUSIVE, "inconclusive")
        ))
    ]  # fmt: skip
    parts += [f"{sum(map(bool, found))} of {len(found)} stated errors cover"] if found else []
    parts += [f"{failed} of the studies failed"] if failed else []
    parts += [f"{older} of the studies failed and are older than the code"] if older else []
    parts += [f"{open_} {'study' if open_ == 1 else 'studies'} inconclusive"] if open_ else []
    return "; ".join(parts)


def uncovered_lines(report: Report) -> list[str]:
    """Return one log line for each stated error that is smaller than the difference from the
    reference."""
    return [
        f"UNCOVERED {case.name}/{verdict.name} [{verdict.run}]: "
        f"{value_text(abs((verdict.value or 0.0) - verdict.reference), verdict.unit)} from the "
        f"reference, {value_text(verdict.stated_error, verdict.unit)} stated"
        for case, verdict in judged_errors(report.cases)
        if not verdict.covered
    ]


def failure_lines(report: Report) -> list[str]:
    """Return one log line for each failed verdict, and for each failed study of the current source
    code.

    If the stated errors of the report fail as a whole, each that is too small has a line, too.
    """
    lines = [failure_line(case.name, verdict, report.level) for case, verdict in report.failures]
    lines += uncovered_lines(report) if report.errors_too_small else []
    return lines + [study_failure_line(study) for study in report.failed_studies]


def power_text(report: Report) -> str:
    """Describe the sensitivity of the verdicts of a report to larger errors, in one line.

    The text states the share of verdicts that would still pass if the error were 3 or 10 times as
    large. Only passed verdicts with an independent reference count. Without such verdicts the text
    is empty.
    """
    judged = [
        (verdict.error, verdict.allowed)
        for case in report.cases
        for verdict in case.verdicts
        if verdict.status is Status.PASS and verdict.tolerance_kind != "order"
        and verdict.reference_kind in OUTSIDE and verdict.error is not None
    ]  # fmt: skip
    if not judged:
        return ""
    passing, hidden = (
        [
            sum(t * e <= u and (t - 1) * e < least for e, u in judged) / len(judged)
            for t in TIMES
        ]
        for least in (float("inf"), NOISE)
    )  # fmt: skip
    return (
        f"Of {len(judged)} numbers with a reference from outside, {passing[0]:.0%} would pass "
        f"with an error three times as large and {passing[1]:.0%} with ten times; "
        f"{hidden[0]:.0%} and {hidden[1]:.0%} without that the comparison with baselines tells it "
        "as worse"
    )


def render_summary(report: Report) -> str:
    """Render the Markdown summary of a report: status, failures, changes, and one table row per
    case."""
    return "\n".join(_summary_lines(report)) + "\n"


def _summary_lines(report: Report) -> Iterator[str]:
    yield f"# {_status_text(report.status)}: slipstick verify, {report.level}"
    yield ""
    yield f"{counts_text(report)}, in {len(report.cases)} cases."
    if age := age_text(report.provenance):
        yield f"The report is {age}."
    if power := power_text(report):
        yield f"{power}."
    failed = report.status is Status.FAIL
    lines = [f"`{line}`" for line in failure_lines(report)] if failed else uncovered_lines(report)
    if lines:
        yield ""
    yield from (f"- {line}" for line in lines[:MAX_LINES])
    if len(lines) > MAX_LINES:
        yield f"- and {len(lines) - MAX_LINES} more"
    yield ""
    yield from _change_lines(report)
    yield ""
    if report.studies:
        told = (
            f"{study.name} {_status_text(study.status)} ({study.level}{measured_text(study)})"
            for study in report.studies
        )
        yield f"Studies: {', '.join(told)}."
        yield ""
    yield "| case | verdict | verdicts | closest to its limit |"
    yield "| --- | --- | --- | --- |"
    for case in report.cases:
        status, closest = _status_text(case.status), _closest_verdict_text(case)
        yield f"| {case.name} | {status} | {len(case.verdicts)} | {closest} |"


def _status_text(status: Status) -> str:
    return f"{SYMBOLS[status]} {WORDS[status]}"


def _closest_verdict_text(case: CaseOutcome) -> str:
    """Describe the verdict of a verification case that is nearest to its tolerance, for the
    summary."""

    def use(verdict: Verdict) -> float:
        return verdict.clearance or 0.0

    known = [verdict for verdict in case.verdicts if verdict.clearance is not None]
    worst = max(known, key=use, default=None)
    return "–" if worst is None else f"{worst.name} [{worst.run}]: {clearance_text(worst)}"


def _change_lines(report: Report) -> Iterator[str]:
    """Yield the Markdown lines of the summary on changes of results since the recorded baseline."""
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
    for row in rows[:MAX_LINES]:
        quantity = f"{row.case}/{row.name} [{row.run}]"
        cells = (row.kind, quantity, row.was, row.now, row.moved, row.remark)
        yield f"| {' | '.join(cell.replace('|', '/') for cell in cells)} |"
    if len(rows) > MAX_LINES:
        yield ""
        yield f"and {len(rows) - MAX_LINES} more; `slipstick maintain compare` lists them."


Made = tuple[str, Status, str, str]  # name, outcome, message, text


def render_junit(report: Report) -> str:
    """Render a verification report as JUnit XML, with one test suite per case and one suite of
    studies.

    Each verdict is a test case. Only studies of the current source code are included. Times are
    left out, because they differ between runs. Changes since the baseline are text output of a
    suite and not failures.
    """
    root = ElementTree.Element("testsuites", name=f"slipstick verify, {report.level}")
    for case in report.cases:
        verdicts = [
            (
                f"{v.name} [{v.run}]",
                v.status,
                failure_line(case.name, v, report.level)
                if v.status is Status.FAIL
                else f"inconclusive: {v.because}",
                v.because,
            )
            for v in case.verdicts
        ]
        lines = [row.line for row in case_rows(case) if row.kind.matters]
        _add_test_suite(root, case.name, verdicts, lines if case.baseline else ["no baseline yet"])
    own = [study for study in report.studies if is_current(study.provenance)]
    failed = [study for study in own if study.status is Status.FAIL]
    if own:
        studies = [
            (one.name, Status.FAIL if one in failed else Status.PASS,
             study_failure_line(one) if one in failed else "", "")
            for one in own
        ]  # fmt: skip
        _add_test_suite(root, "studies", studies)
    for name in ("tests", "failures", "errors", "skipped"):
        root.set(name, str(sum(int(suite.get(name, 0)) for suite in root)))
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _add_test_suite(
    root: ElementTree.Element, name: str, made: list[Made], lines: list[str] | None = None
) -> None:
    ends = [status for _, status, _, _ in made]
    suite = ElementTree.SubElement(
        root, "testsuite", name=name, tests=str(len(made)), errors="0",
        failures=str(ends.count(Status.FAIL)), skipped=str(ends.count(Status.INCONCLUSIVE)),
    )  # fmt: skip
    kinds = {Status.FAIL: "failure", Status.INCONCLUSIVE: "skipped"}
    for title, status, message, text in made:
        element = ElementTree.SubElement(suite, "testcase", classname=name, name=title)
        if status in kinds:
            child = ElementTree.SubElement(element, kinds[status], message=message)
            child.text = text if status is Status.FAIL else None
    if lines:
        ElementTree.SubElement(suite, "system-out").text = "\n".join(lines)
