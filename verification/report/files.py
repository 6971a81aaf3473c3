"""The files of a report, each written whole or not at all; `report.json` comes last."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.directory_lock import acquire, release
from contact_results.directory.refusal import OutputRefused
from contact_results.directory.stop_signals import stop_signals_held
from verification.running.report_record import Report, dump_report

PAGE = "index.html"
RECORD = "report.json"
JUNIT = "junit.xml"
SUMMARY = "summary.md"
FILES = (RECORD, PAGE, JUNIT, SUMMARY)
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


def set_aside_report(directory: Path) -> None:
    """Move an earlier report into `earlier`, before the hours of work that make the new one.

    Whatever ends that work, no file is left that could be taken for its result, and the earlier
    numbers are not lost. The record goes first: what else is then found is no whole report, and the
    next call removes it.
    """
    with _alone_in(directory):
        set_aside(directory, FILES)


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
            for name in names:
                with suppress(FileNotFoundError):
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


def write_report(report: Report, directory: Path) -> None:
    """Render everything, then replace the files of an earlier report, also of one set aside.

    A record of other numbers goes first and the new one comes last: a directory with a
    `report.json` holds files that belong together.
    """
    # Drawing takes long to import: whoever has just a directory to prepare does without.
    from verification.report.junit import render_junit
    from verification.report.page import render_page
    from verification.report.summary_text import render_summary

    texts = {
        PAGE: render_page(report),
        JUNIT: render_junit(report),
        SUMMARY: render_summary(report),
        RECORD: dump_report(report),
    }
    with _alone_in(directory), stop_signals_held():
        if not _holds(directory / RECORD, texts[RECORD]):
            (directory / RECORD).unlink(missing_ok=True)
        for name, text in texts.items():
            with atomic_file(directory / name) as temporary:
                temporary.write_text(text, encoding="utf-8", newline="\n")
        remove_set_aside(directory, FILES)


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
