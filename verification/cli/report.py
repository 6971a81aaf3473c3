"""`slipstick report`: render a report again from its record."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from verification.cli.errors import ExitCode


def report(
    directory: Annotated[
        Path,
        typer.Argument(metavar="DIR", help="A directory that 'slipstick verify' wrote."),
    ] = Path("reports/quick"),
) -> None:
    """Render the report again from its report.json; nothing is computed.

    For a report of an earlier version, or one of which only report.json was kept. Exit code 2 if
    there is none, or none that this version can read.
    """
    from verification.report.files import PAGE, RECORD, refuse_if_unwritable, write_report
    from verification.report.record import load_report

    record = directory / RECORD
    if not record.is_file():
        typer.echo(f"error: {record} does not exist; 'slipstick verify' makes it", err=True)
        raise typer.Exit(ExitCode.INVALID)
    try:
        loaded = load_report(record)
    except ValueError as error:
        reason = str(error).splitlines()[0]
        typer.echo(f"error: {record} is not a report of this version: {reason}", err=True)
        raise typer.Exit(ExitCode.INVALID) from None
    refuse_if_unwritable(directory)
    write_report(loaded, directory)
    typer.echo(f"report: {directory / PAGE}")
