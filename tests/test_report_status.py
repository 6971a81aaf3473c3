"""Tests of the status of a report: failures, contradictions, and studies that it shows."""

from xml.etree import ElementTree

import pytest
from report_examples import (
    a_case,
    made_by,
    report_of,
    study,
    three_cases,
    verdict,
)

from verification.cases.catalogue import choose
from verification.cases.requirements import unmet
from verification.judging.case import Level
from verification.judging.outcome import (
    Status,
    verdict_order_text,
)
from verification.report.page import render_page
from verification.report.summary_text import (
    failure_lines,
    render_junit,
    render_summary,
)
from verification.running.provenance import Provenance
from verification.running.study import LostCase, StudyRecord

OTHER = made_by().model_copy(update={"sources": "those", "commit": "abc1234" + 33 * "0"})


@pytest.mark.parametrize(
    ("half_width", "text"),
    [
        (0.004, "1.900 ± 0.004"),
        (0.49, "1.90 ± 0.49"),
        (0.51, "not known"),
        (63.5, "not known"),
    ],
)
def test_an_order_that_its_interval_says_nothing_of_is_no_number(half_width, text):
    order = verdict("order", 1.9, 2.0).model_copy(update={"interval": half_width})
    assert verdict_order_text(order) == text


def made(record: StudyRecord, provenance: Provenance, *, failed: bool = False) -> StudyRecord:
    (statement,) = record.conclusion.statements
    said = statement.model_copy(update={"outcome": Status.FAIL}) if failed else statement
    conclusion = record.conclusion.model_copy(update={"statements": (said,)})
    return record.model_copy(update={"conclusion": conclusion, "provenance": provenance})


def test_failed_study_of_the_same_sources_fails_the_report():
    report = report_of(three_cases().cases, (made(study("stability"), made_by(), failed=True),))
    assert report.counts[Status.FAIL] == 0
    assert report.status is Status.FAIL
    (line,) = failure_lines(report)
    assert line.startswith("FAIL study stability: A study: A study; reproduce: slipstick")
    assert line in render_summary(report)
    junit = ElementTree.fromstring(render_junit(report).partition("\n")[2])
    assert junit.get("failures") == "1"
    assert len(junit.findall("testsuite[@name='studies']/testcase/failure")) == 1
    assert junit.get("tests") == str(len(junit.findall("testsuite/testcase")))
    assert "1 of the studies failed" in render_page(report)


def test_requirement_that_no_passing_case_shows_fails_the_report():
    declared = choose(Level.QUICK)
    assert unmet(declared, [a_case(case.name) for case in declared]) == ()
    errors = [0.02 if "rig" in case.shows else 0.0 for case in declared]
    outcomes = [a_case(case.name, error) for case, error in zip(declared, errors, strict=True)]
    (missing,) = unmet(declared, outcomes)
    report = three_cases().model_copy(update={"unmet": (missing,)})
    assert report.status is Status.FAIL
    assert failure_lines(report) == [f"FAIL requirement {missing}: no passing case shows it"]
    for text in (render_page(report), render_summary(report), render_junit(report)):
        assert missing in text


@pytest.mark.parametrize(("uncovered", "status"), [(1, Status.PASS), (2, Status.FAIL)])
def test_a_full_report_needs_95_percent(uncovered, status):
    one = verdict("radius", 1.0, 1.0)
    stated = [{"name": f"{n}", "stated_error": 1.0, "covered": n >= uncovered} for n in range(20)]
    verdicts = tuple(one.model_copy(update=each) for each in stated)
    report = report_of((a_case("one").model_copy(update={"verdicts": verdicts}),))
    assert report.model_copy(update={"level": "full"}).status is status
    assert report.status is Status.PASS


def test_study_that_lost_a_case_fails_the_report():
    lost = (LostCase(name="cell-7", reason="its worker was killed"),)
    record = study("stability").model_copy(update={"lost": lost})
    (line,) = failure_lines(report_of(three_cases().cases, (record,)))
    assert "cell-7 was lost: its worker was killed" in line


def test_study_of_other_sources_is_marked_and_judges_nothing():
    report = report_of(three_cases().cases, (made(study("stability"), OTHER, failed=True),))
    assert report.status is Status.PASS
    assert failure_lines(report) == []
    for text in (render_page(report), render_summary(report)):
        assert "older than the code: measured at abc1234" in text
