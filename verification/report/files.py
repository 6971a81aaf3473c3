"""The files of a report and of a study, each written whole or not at all; the record comes last."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from contact_results.directory.atomic_file import OutputRefused, atomic_file
from contact_results.directory.run_lock import acquire, release
from contact_results.directory.stop_signals import stop_signals_held
from verification.running.records import EARLIER
from verification.running.report_record import PACKED_SUFFIX, Report, dump_report
from verification.running.study import RECORD as STUDY_RECORD
from verification.running.study import StudyRecord, dump_study

PAGE, SHEETS = "index.html", "sheets.html"  # the front, and one sheet per case
RECORD = "report.json"
PACKED = f"{RECORD}{PACKED_SUFFIX}"  # what is kept of a report: `xz report.json` makes it
JUNIT = "junit.xml"
SUMMARY = "summary.md"
FILES = (RECORD, PAGE, SHEETS, JUNIT, SUMMARY)  # of any report
POSSIBLE = (*FILES, PACKED)
STUDY_FILES = (STUDY_RECORD, PAGE)
CASES = "cases"  # of the directory: the records of finished cases


def refuse_if_unwritable(directory: Path) -> None:
    """Create the directory and try it, before hours of work; raises OutputRefused."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
        probe = directory / f".probe-{secrets.token_hex(4)}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise OutputRefused(f"cannot write into {directory}: {error.strerror}") from error


def record_in(directory: Path) -> Path:
    """Return the path of a report's record: the packed file if the plain one is absent."""
    packed = directory / PACKED
    return packed if packed.is_file() and not (directory / RECORD).is_file() else directory / RECORD


def set_aside_report(directory: Path) -> None:
    """Move an earlier report into `earlier`, before the hours of work that make the new one.

    Whatever ends that work, no file is left that could be taken for its result, and the earlier
    numbers are not lost. The record goes first: what else is then found is no whole report, and the
    next call removes it.
    """
    with _alone_in(directory):
        record = record_in(directory).name
        set_aside(directory, (record, *(name for name in POSSIBLE if name != record)))


def set_aside(directory: Path, names: Sequence[str] = STUDY_FILES) -> None:
    """Move files that belong together into `earlier`, first the record that says they are whole.

    Without the record the others are removed, and the files in `earlier` stay.
    """
    record, *_ = names
    with stop_signals_held():
        if not (directory / record).is_file():
            _remove(directory, names)
            return
        try:
            (directory / EARLIER).mkdir(exist_ok=True)
            _remove(directory / EARLIER, names)
            for name in filter(lambda one: (directory / one).is_file(), names):
                os.replace(directory / name, directory / EARLIER / name)
        except OSError as error:
            raise OutputRefused(
                f"cannot set what is in {directory} aside into {directory / EARLIER}: "
                f"{error.strerror}"
            ) from error


def draw_again(report: Report, directory: Path) -> None:
    """Render everything from the record that is there, and leave a packed one as it is."""
    packed = record_in(directory).name == PACKED
    _write(_rendered(report) | ({} if packed else {RECORD: dump_report(report)}), directory,
           kept=(PACKED,) if packed else ())  # fmt: skip


def write_report(report: Report, directory: Path) -> None:
    """Render everything, then replace the files of an earlier report, also of one set aside.

    A record of other numbers goes first and the new one comes last: a directory with a
    `report.json` has files that belong together.
    """
    _write(_rendered(report) | {RECORD: dump_report(report)}, directory)


def write_study(record: StudyRecord, rows: Mapping[str, str], directory: Path) -> None:
    """Write the page, the tables and the record of a study, and remove those set aside.

    rows  text by name of the file
    """
    from verification.report.page import render_study

    texts = {**rows, PAGE: render_study(record), STUDY_RECORD: dump_study(record)}
    with stop_signals_held():
        _put(texts, directory)
        _remove_set_aside(directory, STUDY_FILES)


def _rendered(report: Report) -> dict[str, str]:
    """The files that are drawn, by name."""
    # Drawing takes long to import: a command that only prepares a directory does without.
    from verification.report.page import render_page, render_sheets
    from verification.report.summary_text import render_junit, render_summary

    return {
        PAGE: render_page(report), SHEETS: render_sheets(report), JUNIT: render_junit(report),
        SUMMARY: render_summary(report),
    }  # fmt: skip


def _write(texts: Mapping[str, str], directory: Path, kept: Sequence[str] = ()) -> None:
    """Replace the files of an earlier report but those that are kept. The last text states that
    they are whole."""
    with _alone_in(directory), stop_signals_held():
        record = directory / RECORD
        if record.is_file() and record.read_text(encoding="utf-8") != texts.get(RECORD):
            record.unlink()
        _remove(directory, [name for name in POSSIBLE if name not in texts and name not in kept])
        _put(texts, directory)
        _remove_set_aside(directory, POSSIBLE)


def _put(texts: Mapping[str, str], directory: Path) -> None:
    for name, text in texts.items():
        with atomic_file(directory / name) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")


def _remove_set_aside(directory: Path, names: Sequence[str]) -> None:
    with suppress(OSError):  # there is none, or it has files of others
        _remove(directory / EARLIER, names)
        (directory / EARLIER).rmdir()


def _remove(directory: Path, names: Sequence[str]) -> None:
    """Remove the record first: a directory that has one has files that belong together."""
    for name in names:
        (directory / name).unlink(missing_ok=True)


@contextmanager
def _alone_in(directory: Path) -> Iterator[None]:
    """Wait for another process that writes a report there: files of two would be mixed."""
    lock = acquire(directory, wait=True)
    try:
        yield
    finally:
        release(lock)
