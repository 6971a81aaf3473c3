"""Tests of the files of a report: an earlier one waits aside, packed records, and a full disk."""

import errno
import fcntl
import lzma
import os
import subprocess
import threading
from pathlib import Path

import pytest
from command import slipstick
from report_examples import (
    a_case,
    report_of,
    study,
    three_cases,
)

from slipstick.cli.errors import ExitCode, exit_code
from verification.regression.baseline import accept
from verification.report.file_names import JUNIT, PACKED, PAGE, RECORD, SHEETS, SUMMARY
from verification.report.files import (
    EARLIER,
    draw_again,
    record_in,
    set_aside_report,
    write_report,
)
from verification.report.summary_text import (
    stored_records,
)
from verification.running import provenance
from verification.running.report_record import dump_report, load_report
from verification.running.study import dump_study

FILES = {PAGE, SHEETS, RECORD, JUNIT, SUMMARY}


@pytest.fixture
def places(tmp_path):
    """A report of three cases and its baselines."""
    report, baselines = tmp_path / "report", tmp_path / "baselines"
    report.mkdir()
    write_report(three_cases(), report)
    accept(three_cases(), "as computed", baselines, with_changes=True)
    return report, baselines


def files_in(directory: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in directory.iterdir() if path.is_file()}


def test_earlier_report_waits_aside_until_the_new_one_is_whole(places):
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
def test_end_in_the_middle_of_setting_aside_costs_no_numbers(places, monkeypatch, moved):
    report, _ = places
    record = (report / RECORD).read_bytes()
    calls = iter(range(moved))
    move = os.replace

    def replace(source, target):
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


def test_what_is_not_ours_stays_where_a_report_would_wait(places):
    report, _ = places
    (report / EARLIER).mkdir()
    (report / EARLIER / "of_mine.txt").touch()
    set_aside_report(report)
    write_report(three_cases(), report)
    assert files_in(report / EARLIER) == {"of_mine.txt": b""}


def test_kept_report_that_is_set_aside_is_no_change_of_the_source(tmp_path, monkeypatch):
    def git(*arguments):
        author = ("-c", "user.name=a", "-c", "user.email=a@example.org")
        subprocess.run(["git", *author, "-C", tmp_path, *arguments], check=True)

    kept = tmp_path / "reports" / "full" / RECORD
    kept.parent.mkdir(parents=True)
    for file in (kept, tmp_path / "solve.py"):
        file.write_text("1")
    git("init", "--quiet")
    git("add", "--all")
    git("commit", "--quiet", "--message", "First")
    monkeypatch.setattr(provenance, "ROOT", tmp_path)
    set_aside_report(kept.parent)
    assert not kept.exists()
    assert not provenance.provenance("", {}).changed
    (tmp_path / "solve.py").write_text("2")
    assert provenance.provenance("", {}).changed


def test_reports_into_one_directory_are_written_one_after_the_other(tmp_path):
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


def test_full_disk_leaves_no_record_and_names_the_file(tmp_path, monkeypatch):
    write_report(three_cases(), tmp_path)

    def full(self, text, **options):
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


# ---- packed records


def test_a_packed_record_is_read_drawn_from_and_left_as_it_is(tmp_path):
    report = three_cases()
    packed = tmp_path / PACKED
    packed.write_bytes(lzma.compress(dump_report(report).encode()))
    before = packed.read_bytes()
    assert record_in(tmp_path) == packed
    assert load_report(packed) == report
    draw_again(report, tmp_path)
    assert (tmp_path / PAGE).is_file()
    assert packed.read_bytes() == before
    assert not (tmp_path / RECORD).exists()
    write_report(report, tmp_path)  # a new record replaces it
    assert record_in(tmp_path) == tmp_path / RECORD
    assert not packed.exists()


def test_a_packed_record_that_is_damaged_or_too_large_is_refused_in_words(tmp_path, monkeypatch):
    packed = tmp_path / PACKED
    whole = lzma.compress(b" " * 5000)
    for content in (b"no xz", whole[:-20]):
        packed.write_bytes(content)
        with pytest.raises(ValueError, match="cannot be unpacked"):
            load_report(packed)
    packed.write_bytes(whole)
    monkeypatch.setattr("verification.running.report_record.LARGEST_RECORD", 4999)
    with pytest.raises(ValueError, match="larger than any report"):
        load_report(packed)


# ---- records of studies


def test_the_best_record_of_a_study_is_shown(tmp_path):
    """One of these sources, of the highest level, the latest; cells of a user are no level."""

    def store(place, record, date, **changes):
        made = record.provenance.model_copy(update={"date": date, **changes})
        (tmp_path / place).mkdir(parents=True)
        text = dump_study(record.model_copy(update={"provenance": made}))
        (tmp_path / place / "study.json").write_text(text, encoding="utf-8")

    store("a/full", study("stability", "old", "full"), "2001")
    store("b/full", study("stability", "new", "full"), "2002")
    store("a/quick", study("stability", "quick", "quick"), "2003")
    store("a/other", study("no-such-place", "x"), "2003")
    store("b/elsewhere", study("stability", "of others", "full"), "2004", sources="those")
    coarse = study("stability", "coarse", "full").model_copy(update={"own_cells": True})
    store("b/coarse", coarse, "2004")
    for places in (("a", "b"), ("b", "a")):
        (chosen,) = stored_records(tmp_path / place for place in places)
        assert chosen.conclusion.answer == "new"
    assert stored_records([tmp_path / "nowhere"]) == ()


@pytest.mark.parametrize(
    ("present", "chosen"),
    [((), RECORD), ((PACKED,), PACKED), ((RECORD,), RECORD), ((PACKED, RECORD), RECORD)],
)
def test_a_packed_record_is_read_if_there_is_no_other(tmp_path, present, chosen):
    for name in present:
        (tmp_path / name).touch()
    assert record_in(tmp_path) == tmp_path / chosen
