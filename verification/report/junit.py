"""`junit.xml`: verdicts as test cases, for the tools of continuous integration."""

from __future__ import annotations

from xml.etree import ElementTree

from verification.judging.outcome import Status
from verification.judging.verdict_text import failure_line
from verification.report.changes import case_rows
from verification.running.report_record import Report
from verification.running.sources import is_current
from verification.running.study_text import study_failure_line

Made = tuple[str, Status, str, str]  # name, outcome, message, text


def render_junit(report: Report) -> str:
    """Return one suite per case with a test case per verdict, and one suite of the studies of the
    same sources; without times, which differ between runs.

    Changes since the baseline are text of their suite: they are no failures.
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
        _suite(root, case.name, verdicts, lines if case.baseline else ["no baseline yet"])
    own = [study for study in report.studies if is_current(study.provenance)]
    failed = [study for study in own if study.status is Status.FAIL]
    if own:
        studies = [
            (one.name, Status.FAIL if one in failed else Status.PASS,
             study_failure_line(one) if one in failed else "", "")
            for one in own
        ]  # fmt: skip
        _suite(root, "studies", studies)
    for name in ("tests", "failures", "errors", "skipped"):
        root.set(name, str(sum(int(suite.get(name, 0)) for suite in root)))
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _suite(
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
