"""A report that a command is given: its folder, or its `report.json`, packed or not."""

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from slipstick.cli.errors import ExitCode

if TYPE_CHECKING:
    from verification.running.report_record import Report


def read_report(place: Path) -> "Report":
    """The report; without one that this version can read, a message and exit code 2."""
    from verification.report.files import EARLIER, record_in
    from verification.running.report_record import load_report

    record = record_in(place) if place.is_dir() else place
    if not record.is_file():
        earlier = record.parent / EARLIER
        before = f"; the report before it is in {earlier}" if record_in(earlier).is_file() else ""
        typer.echo(f"error: {record} does not exist; 'slipstick verify' makes it{before}", err=True)
        raise typer.Exit(ExitCode.INVALID)
    try:
        return load_report(record)
    except ValueError as error:
        reason = str(error).splitlines()[0]
        typer.echo(f"error: {record} is not a report that can be used: {reason}", err=True)
        raise typer.Exit(ExitCode.INVALID) from None
