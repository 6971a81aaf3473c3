"""The files of a report, each written whole or not at all; `report.json` comes last."""

from __future__ import annotations

import os
import secrets
from pathlib import Path

from verification.report.junit import render_junit
from verification.report.page import render_page
from verification.report.record import Report, dump_report
from verification.report.summary_text import render_summary
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
    with stop_signals_held():
        if not _holds(directory / RECORD, texts[RECORD]):
            (directory / RECORD).unlink(missing_ok=True)
        for name, text in texts.items():
            _replace(directory / name, text)


def _holds(path: Path, text: str) -> bool:
    return path.is_file() and path.read_text(encoding="utf-8") == text


def _replace(path: Path, text: str) -> None:
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(4)}")
    try:
        with open(temporary, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
