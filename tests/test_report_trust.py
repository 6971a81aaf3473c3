"""Tests of inconsistent reports, records and baselines: contradictions are detected."""

import errno
import fcntl
import json
import os
import subprocess
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from command import slipstick
from report_examples import case, made_by, report_of, run_record, study, verdict

from slipstick.cli.errors import ExitCode, exit_code
from verification.cases.catalogue import choose
from verification.cases.requirements import unmet
from verification.judging.case import Level
from verification.judging.outcome import CaseOutcome, Status, verdict_order_text
from verification.regression.baseline import accept
from verification.report.file_names import JUNIT, PAGE, RECORD, SHEETS, SUMMARY
from verification.report.files import set_aside_report, write_report
from verification.report.page import render_page
from verification.report.summary_text import (
    failure_lines,
    render_junit,
    render_summary,
)
from verification.running import provenance
from verification.running.provenance import Provenance
from verification.running.report_record import EARLIER, Report, load_report
from verification.running.study import LostCase, StudyRecord

REASON = "as computed"
OTHER = made_by().model_copy(update={"sources": "those", "commit": "abc1234" + 33 * "0"})


def a_case(name: str, error: float = 0.002) -> CaseOutcome:
    """A case of two quantities, of which one has this error; 0.01 is allowed."""
    values = {"approach": (1.0 + error, 1.0), "radius": (2.0, 2.0)}
    return case(name, values, run_record(32, None), drawn=False)


def three_cases() -> Report:
    return report_of(tuple(a_case(name) for name in ("one", "three", "two")))


@pytest.fixture
def places(tmp_path: Path) -> tuple[Path, Path]:
    """A report of three cases and its baselines."""
    report, baselines = tmp_path / "report", tmp_path / "baselines"
    report.mkdir()
    write_report(three_cases(), report)
    accept(three_cases(), REASON, baselines, with_changes=True)
    return report, baselines


def edited(record: Path, edit: Callable[[dict[str, Any]], object]) -> None:
    content = json.loads(record.read_text(encoding="utf-8"))
    edit(content)
    record.write_text(json.dumps(content), encoding="utf-8")


# ---- the report before -------------------------------------------------------------------------


FILES = {PAGE, SHEETS, RECORD, JUNIT, SUMMARY}


def files_in(directory: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in directory.iterdir() if path.is_file()}


def test_earlier_report_waits_aside_until_the_new_one_is_whole(places: tuple[Path, Path]) -> None:
    report, baselines = places
    (report / "of_mine.txt").touch()
    before = files_in(report)
    for _ in range(2):  # the second call finds what a killed verification has left
        set_aside_report(report)
        assert files_in(report) == {"of_mine.txt": b""}
        assert files_in(report / EARLIER) == {name: before[name] for name in FILES}
    for place, code in ((report, 2), (report / EARLIER, 0)):
        assert slipstick("maintain", "compare", place, "--baseline", baselines) == code
    write_report(report_of(three_cases().cases[:1]), report)
    assert files_in(report).keys() == FILES | {"of_mine.txt"}
    assert not (report / EARLIER).exists()


@pytest.mark.parametrize("moved", range(len(FILES)))
def test_end_in_the_middle_of_setting_aside_costs_no_numbers(
    places: tuple[Path, Path], monkeypatch: pytest.MonkeyPatch, moved: int
) -> None:
    report, _ = places
    record = (report / RECORD).read_bytes()
    calls = iter(range(moved))
    move = os.replace

    def replace(source: Path, target: Path) -> None:
        if next(calls, None) is None:
            raise KeyboardInterrupt
        move(source, target)

    with monkeypatch.context() as patch:
        patch.setattr("verification.report.files.os.replace", replace)
        with pytest.raises(KeyboardInterrupt):
            set_aside_report(report)
    assert len(files_in(report)) == len(FILES) - moved
    set_aside_report(report)
    assert files_in(report) == {}
    assert (report / EARLIER / RECORD).read_bytes() == record


def test_what_is_not_ours_stays_where_a_report_would_wait(places: tuple[Path, Path]) -> None:
    report, _ = places
    (report / EARLIER).mkdir()
    (report / EARLIER / "of_mine.txt").touch()
    set_aside_report(report)
    write_report(three_cases(), report)
    assert files_in(report / EARLIER) == {"of_mine.txt": b""}


# ---- reports and records that were changed -------------------------------------------------------


def first_verdict(report: dict[str, Any]) -> dict[str, Any]:
    verdict: dict[str, Any] = report["cases"][0]["verdicts"][0]
    return verdict


FORGERIES: dict[str, tuple[Callable[[dict[str, Any]], object], str]] = {
    "no value": (lambda r: first_verdict(r).update(value=None, error=None), "status is pass"),
    "vague order that passes": (
        lambda r: first_verdict(r).update(tolerance_kind="order", interval=0.4),
        "its status is pass",
    ),
    "case twice": (lambda r: r["cases"].append(r["cases"][0]), "a case twice: one"),
    "run of a verdict": (lambda r: first_verdict(r).update(runs=["x"]), "the run 'x' not at all"),
    "run as planned": (
        lambda r: r["cases"][0]["runs"][0].update(planned="y"),
        "the run 'y' not at all",
    ),
}


@pytest.mark.parametrize("forgery", FORGERIES)
def test_report_that_contradicts_itself_is_refused(tmp_path: Path, forgery: str) -> None:
    edit, said = FORGERIES[forgery]
    write_report(three_cases(), tmp_path)
    edited(tmp_path / RECORD, edit)
    with pytest.raises(ValueError, match=said):
        load_report(tmp_path / RECORD)


@pytest.mark.parametrize(
    ("half_width", "text"),
    [
        (0.004, "1.900 ± 0.004"),
        (0.49, "1.90 ± 0.49"),
        (0.51, "not known"),
        (63.5, "not known"),
    ],
)
def test_an_order_that_its_interval_says_nothing_of_is_no_number(
    half_width: float, text: str
) -> None:
    order = verdict("order", 1.9, 2.0).model_copy(update={"interval": half_width})
    assert verdict_order_text(order) == text


# ---- places that do not take what is written -----------------------------------------------------


def test_reports_into_one_directory_are_written_one_after_the_other(tmp_path: Path) -> None:
    descriptor = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(descriptor, fcntl.LOCK_EX)
    writing = threading.Thread(target=write_report, args=(three_cases(), tmp_path))
    writing.start()
    writing.join(0.5)
    assert writing.is_alive()
    assert list(tmp_path.iterdir()) == []
    os.close(descriptor)
    writing.join(20)
    assert load_report(tmp_path / RECORD) == three_cases()


def test_full_disk_leaves_no_record_and_names_the_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_report(three_cases(), tmp_path)

    def full(self: Path, text: str, **options: Any) -> int:
        if "summary" in self.name:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        return write_text(self, text, **options)

    write_text = Path.write_text
    monkeypatch.setattr(Path, "write_text", full)
    with pytest.raises(OSError, match="No space") as raised:
        write_report(report_of((a_case("one", 0.02),)), tmp_path)
    assert raised.value.filename == str(tmp_path / "summary.md")
    assert exit_code(raised.value) is ExitCode.RESOURCES_REFUSED
    assert {path.name for path in tmp_path.iterdir()} == FILES - {RECORD}


def test_kept_report_that_is_set_aside_is_no_change_of_the_source(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def git(*arguments: str) -> None:
        author = ("-c", "user.name=a", "-c", "user.email=a@example.org")
        subprocess.run(["git", *author, "-C", tmp_path, *arguments], check=True)

    kept = tmp_path / "reports" / "full" / RECORD
    kept.parent.mkdir(parents=True)
    for file in (kept, tmp_path / "solve.py"):
        file.write_text("1")
    git("init", "--quiet")
    git("add", "--all")
    git("commit", "--quiet", "--message", "First")
    monkeypatch.setattr(provenance, "SOURCE", tmp_path)
    set_aside_report(kept.parent)
    assert not kept.exists()
    assert not provenance.provenance("", {}).changed
    (tmp_path / "solve.py").write_text("2")
    assert provenance.provenance("", {}).changed


# ---- studies that a report shows ---------------------------------------------------------------


def made(record: StudyRecord, provenance: Provenance, *, failed: bool = False) -> StudyRecord:
    (statement,) = record.conclusion.statements
    said = statement.model_copy(update={"outcome": Status.FAIL}) if failed else statement
    conclusion = record.conclusion.model_copy(update={"statements": (said,)})
    return record.model_copy(update={"conclusion": conclusion, "provenance": provenance})


def test_failed_study_of_the_same_sources_fails_the_report() -> None:
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


def test_requirement_that_no_passing_case_shows_fails_the_report() -> None:
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
def test_a_full_report_needs_95_percent(uncovered: int, status: Status) -> None:
    one = verdict("radius", 1.0, 1.0)
    stated = [{"name": f"{n}", "stated_error": 1.0, "covered": n >= uncovered} for n in range(20)]
    verdicts = tuple(one.model_copy(update=each) for each in stated)
    report = report_of((a_case("one").model_copy(update={"verdicts": verdicts}),))
    assert report.model_copy(update={"level": "full"}).status is status
    assert report.status is Status.PASS


def test_study_that_lost_a_case_fails_the_report() -> None:
    lost = (LostCase(name="cell-7", reason="its worker was killed"),)
    record = study("stability").model_copy(update={"lost": lost})
    (line,) = failure_lines(report_of(three_cases().cases, (record,)))
    assert "cell-7 was lost: its worker was killed" in line


def test_study_of_other_sources_is_marked_and_judges_nothing() -> None:
    report = report_of(three_cases().cases, (made(study("stability"), OTHER, failed=True),))
    assert report.status is Status.PASS
    assert failure_lines(report) == []
    for text in (render_page(report), render_summary(report)):
        assert "older than the code: measured at abc1234" in text
