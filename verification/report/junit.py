"""`junit.xml`: verdicts as test cases, for the tools of continuous integration."""

from __future__ import annotations

from xml.etree import ElementTree

from verification.judging.outcome import CaseOutcome, Status, Verdict
from verification.judging.verdict_text import failure_line
from verification.report.changes import case_rows
from verification.running.record import StudyRecord
from verification.running.report_record import Report
from verification.running.sources import is_current
from verification.running.study_text import study_failure_line


def render_junit(report: Report) -> str:
    """One suite per case, one test case per verdict; without times, which differ between runs.
    Studies of the same sources make one more suite.

    What is new since the baseline is text of its suite: it is no failure.
    """
    own = [study for study in report.studies if is_current(study.provenance)]
    root = ElementTree.Element(
        "testsuites", name=f"slipstick verify, {report.level}",
        tests=str(sum(report.counts.values()) + len(own)),
        failures=str(report.counts[Status.FAIL] + len(report.failed_studies)),
        errors="0", skipped=str(report.counts[Status.INCONCLUSIVE]),
    )  # fmt: skip
    for case in report.cases:
        suite = ElementTree.SubElement(
            root, "testsuite", name=case.name, tests=str(len(case.verdicts)),
            failures=str(case.count(Status.FAIL)), errors="0",
            skipped=str(case.count(Status.INCONCLUSIVE)),
        )  # fmt: skip
        for verdict in case.verdicts:
            _add(suite, case, verdict, report.level)
        _add_changes(suite, case)
    if own:
        _add_studies(root, own)
    ElementTree.indent(root)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _add(suite: ElementTree.Element, case: CaseOutcome, verdict: Verdict, level: str) -> None:
    name = f"{verdict.name} [{verdict.run}]"
    element = ElementTree.SubElement(suite, "testcase", classname=case.name, name=name)
    if verdict.status is Status.FAIL:
        message = failure_line(case.name, verdict, level)
        ElementTree.SubElement(element, "failure", message=message).text = verdict.because
    elif verdict.status is Status.INCONCLUSIVE:
        ElementTree.SubElement(element, "skipped", message=f"inconclusive: {verdict.because}")


def _add_studies(root: ElementTree.Element, studies: list[StudyRecord]) -> None:
    failures = [study for study in studies if study.status is Status.FAIL]
    suite = ElementTree.SubElement(
        root, "testsuite", name="studies", tests=str(len(studies)), failures=str(len(failures)),
        errors="0", skipped="0",
    )  # fmt: skip
    for study in studies:
        element = ElementTree.SubElement(suite, "testcase", classname="studies", name=study.name)
        if study in failures:
            ElementTree.SubElement(element, "failure", message=study_failure_line(study))


def _add_changes(suite: ElementTree.Element, case: CaseOutcome) -> None:
    lines = [row.line for row in case_rows(case) if row.kind.matters]
    if case.baseline is None:
        lines = ["no baseline yet"]
    if lines:
        ElementTree.SubElement(suite, "system-out").text = "\n".join(lines)
