"""The files of a report, each written whole or not at all; `report.json` comes last."""

from __future__ import annotations

import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from verification.report.junit import render_junit
from verification.report.page import render_page
from verification.report.record import Report, dump_report
from verification.report.summary_text import render_summary
from verification.run_output.atomic_file import atomic_file
from verification.run_output.directory_lock import acquire, release
from verification.run_output.run_directory import OutputRefused
from verification.run_output.stop_signals import stop_signals_held

PAGE = "index.html"
RECORD = "report.json"
JUNIT = "junit.xml"
SUMMARY = "summary.md"


def refuse_if_unwritable(directory: Path) -> None:
    """Create the directory and try it, before hours of work; raises OutputRefused."""
    try:
        directory.mkdir(parents=True, exist_ok=True)
        probe = directory / f".probe-{secrets.token_hex(4)}"
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise OutputRefused(f"cannot write into {directory}: {error.strerror}") from error


def write_report(report: Report, directory: Path) -> None:
    """Render everything, then replace the files of an earlier report.

    A record of other numbers goes first and the new one comes last: a directory with a
    `report.json` holds files that belong together.
    """
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
