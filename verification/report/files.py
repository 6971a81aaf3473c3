"""Writing of the files of a verification report and of a study.

Each file is written atomically. The record is written last, so that its presence marks complete
files.
"""

from __future__ import annotations

import fcntl
import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from contact_results.directory.atomic_file import OutputRefused, atomic_file
from contact_results.directory.run_directory import refuse_files_above
from contact_results.directory.stop_signals import stop_signals_held
from verification.report.file_names import (
    JUNIT,
    PACKED,
    PAGE,
    POSSIBLE,
    RECORD,
    SHEETS,
    STUDY_FILES,
    SUMMARY,
)
from verification.running.report_record import EARLIER, Report, dump_report
from verification.running.study import RECORD as STUDY_RECORD
from verification.running.study import StudyRecord, dump_study


def refuse_if_unwritable(directory: Path) -> None:
    """Create the output directory of a report and test that files can be written into the
    directory.

    Called before long computations. Raises OutputRefused.
    """
    refuse_files_above(directory)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        probe = directory / f".probe-{secrets.token_hex(4)}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise OutputRefused(f"cannot write into {directory}: {error.strerror}") from error


def record_in(directory: Path) -> Path:
    """Return the path of the record of a report in a directory.

    The compressed record is used if the uncompressed record is absent.
    """
    packed = directory / PACKED
    return packed if packed.is_file() and not (directory / RECORD).is_file() else directory / RECORD


def set_aside_report(directory: Path) -> None:
    """Move the files of an earlier report into the subfolder `earlier`, before a new report is
    computed.

    If the computation is interrupted, no file can be mistaken for its result, and the earlier
    results are preserved. The record is moved first. The files that remain after an interruption
    have no record, and the next call removes them.
    """
    with _locked_directory(directory):
        record = record_in(directory).name
        set_aside(directory, (record, *(name for name in POSSIBLE if name != record)))


def set_aside(directory: Path, names: Sequence[str] = STUDY_FILES) -> None:
    """Move the files of a report or study into the subfolder `earlier`, beginning with the record.

    Without a record the other files are removed, and the files in `earlier` stay.

    names  file names, with the record first
    """
    record, *_ = names
    with stop_signals_held():
        if not (directory / record).is_file():
            _remove_files(directory, names)
            return
        try:
            (directory / EARLIER).mkdir(exist_ok=True)
            _remove_files(directory / EARLIER, names)
            for name in filter(lambda one: (directory / one).is_file(), names):
                os.replace(directory / name, directory / EARLIER / name)
        except OSError as error:
            raise OutputRefused(
                f"cannot set what is in {directory} aside into {directory / EARLIER}: "
                f"{error.strerror}"
            ) from error


def draw_again(report: Report, directory: Path) -> None:
    """Render the pages of a verification report again from its record.

    A compressed record in the directory stays as it is; an uncompressed record is written again.
    """
    packed = record_in(directory).name == PACKED
    record = {} if packed else {RECORD: dump_report(report)}
    kept = (PACKED,) if packed else ()
    _replace_files(_rendered_files(report) | record, directory, kept)


def write_report(report: Report, directory: Path) -> None:
    """Write all files of a verification report, and remove the other files of an earlier report.

    Files that were moved aside are removed. A different record is removed first and the new record
    is written last. A directory with `report.json` therefore contains files that belong together.
    """
    _replace_files(_rendered_files(report) | {RECORD: dump_report(report)}, directory)


def write_study(record: StudyRecord, rows: Mapping[str, str], directory: Path) -> None:
    """Write the page, the tables and the record of a study, and remove the files that were moved
    aside.

    rows  texts of the CSV tables by file name
    """
    from verification.report.page import render_study

    texts = {**rows, PAGE: render_study(record), STUDY_RECORD: dump_study(record)}
    with stop_signals_held():
        _write_texts(texts, directory)
        _remove_set_aside(directory, STUDY_FILES)


def _rendered_files(report: Report) -> dict[str, str]:
    """Render the pages, the JUnit table and the summary of a report, as texts by file name."""
    # Drawing takes long to import: a command that only prepares a directory does without.
    from verification.report.page import render_page, render_sheets
    from verification.report.summary_text import render_junit, render_summary

    return {
        PAGE: render_page(report),
        SHEETS: render_sheets(report),
        JUNIT: render_junit(report),
        SUMMARY: render_summary(report),
    }


def _replace_files(texts: Mapping[str, str], directory: Path, kept: Sequence[str] = ()) -> None:
    """Write new files of a report into a directory and remove the other files of an earlier report.

    texts  contents by file name; the last is the record, whose presence marks a complete report
    kept   names of files that stay as they are
    """
    with _locked_directory(directory), stop_signals_held():
        record = directory / RECORD
        if record.is_file() and record.read_text(encoding="utf-8") != texts.get(RECORD):
            record.unlink()
        _remove_files(
            directory, [name for name in POSSIBLE if name not in texts and name not in kept]
        )
        _write_texts(texts, directory)
        _remove_set_aside(directory, POSSIBLE)


def _write_texts(texts: Mapping[str, str], directory: Path) -> None:
    for name, text in texts.items():
        with atomic_file(directory / name) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")


def _remove_set_aside(directory: Path, names: Sequence[str]) -> None:
    with suppress(OSError):  # the folder is absent or has other files
        _remove_files(directory / EARLIER, names)
        (directory / EARLIER).rmdir()


def _remove_files(directory: Path, names: Sequence[str]) -> None:
    """Remove files of a report or study from a directory, in the given order, if they exist.

    The record comes first, because its presence marks a complete report.
    """
    for name in names:
        (directory / name).unlink(missing_ok=True)


@contextmanager
def _locked_directory(directory: Path) -> Iterator[None]:
    """Lock the output directory of a report for a block of code.

    The call waits while another process holds the lock to write a report there.
    """
    descriptor = os.open(directory, os.O_RDONLY)
    try:
        with suppress(OSError):  # the file system has no locks
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield
    finally:
        os.close(descriptor)
