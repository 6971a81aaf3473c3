"""The files of a report, each written whole or not at all; `report.json` comes last."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.directory_lock import acquire, release
from contact_results.directory.refusal import OutputRefused
from contact_results.directory.stop_signals import stop_signals_held
from verification.report.extent import extent
from verification.report.sections import TITLES
from verification.running.report_record import PACKED_SUFFIX, Report, dump_report

PAGE, SHEETS = "index.html", "sheets.html"  # the front, and one sheet per case
RECORD = "report.json"
PACKED = f"{RECORD}{PACKED_SUFFIX}"  # what is kept of a report: `xz report.json` makes it
JUNIT = "junit.xml"
SUMMARY = "summary.md"
APPENDICES = {name: f"study-{name}.html" for name in TITLES}
FILES = (RECORD, PAGE, SHEETS, JUNIT, SUMMARY)  # of any report
POSSIBLE = (*FILES, PACKED, *APPENDICES.values())
EARLIER = "earlier"  # of the report's directory: the report before, until the new one is whole


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
    """Where the record of a report is, or would be: packed only where there is no other."""
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


def set_aside(directory: Path, names: Sequence[str]) -> None:
    """Move files that belong together into `earlier`, first the one that says they are whole.

    Without that one the others are removed, and what waits in `earlier` stays.
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


def remove_set_aside(directory: Path, names: Sequence[str]) -> None:
    """What `set_aside` has moved, once there is better."""
    with suppress(OSError):  # there is none, or it holds what is not ours
        _remove(directory / EARLIER, names)
        (directory / EARLIER).rmdir()


def draw_again(report: Report, directory: Path) -> None:
    """Render everything from the record that is there, and leave a packed one as it is."""
    packed = record_in(directory).name == PACKED
    _write(_rendered(report) | ({} if packed else {RECORD: dump_report(report)}), directory,
           kept=(PACKED,) if packed else ())  # fmt: skip


def write_report(report: Report, directory: Path) -> None:
    """Render everything, then replace the files of an earlier report, also of one set aside.

    A record of other numbers goes first and the new one comes last: a directory with a
    `report.json` holds files that belong together.
    """
    _write(_rendered(report) | {RECORD: dump_report(report)}, directory)


def _rendered(report: Report) -> dict[str, str]:
    """The files that are drawn, by name."""
    # Drawing takes long to import: whoever has just a directory to prepare does without.
    from verification.report.junit import render_junit
    from verification.report.page import render_page, render_sheets
    from verification.report.study_page import render_study
    from verification.report.summary_text import render_summary

    return {
        PAGE: render_page(report),
        SHEETS: render_sheets(report),
        JUNIT: render_junit(report),
        SUMMARY: render_summary(report),
        **{
            APPENDICES[study.name]: render_study(study)
            for study in report.studies
            if study.name in APPENDICES and extent(report.level).appendices
        },
    }


def _write(texts: Mapping[str, str], directory: Path, kept: Sequence[str] = ()) -> None:
    """Replace the files of an earlier report but those that are kept; what comes last in the texts
    says that they are whole."""
    with _alone_in(directory), stop_signals_held():
        if RECORD in texts and not _holds(directory / RECORD, texts[RECORD]):
            (directory / RECORD).unlink(missing_ok=True)
        _remove(directory, [name for name in POSSIBLE if name not in texts and name not in kept])
        for name, text in texts.items():
            with atomic_file(directory / name) as temporary:
                temporary.write_text(text, encoding="utf-8", newline="\n")
        remove_set_aside(directory, POSSIBLE)


def _remove(directory: Path, names: Sequence[str]) -> None:
    """The record goes first: a directory that has one holds files that belong together."""
    for name in names:
        (directory / name).unlink(missing_ok=True)


@contextmanager
def _alone_in(directory: Path) -> Iterator[None]:
    """Wait for whoever writes a report there: files of two would be mixed."""
    lock = acquire(directory, wait=True)
    try:
        yield
    finally:
        release(lock)


def _holds(path: Path, text: str) -> bool:
    return path.is_file() and path.read_text(encoding="utf-8") == text
