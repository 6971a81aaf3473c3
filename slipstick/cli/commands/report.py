"""`slipstick maintain report`: render a report from its record."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from slipstick.cli.errors import ExitCode

if TYPE_CHECKING:
    from verification.running.report_record import Report


def report(
    directory: Annotated[
        Path,
        typer.Argument(metavar="DIR", help="A directory that 'slipstick verify' wrote."),
    ] = Path("reports/quick"),
) -> None:
    """Render the report from its report.json; nothing is computed.

    The record may be compressed, by 'xz report.json'. Exit code 2 if there is no record, or if this
    version cannot read it.
    """
    from verification.report.files import PAGE, draw_again, refuse_if_unwritable

    loaded = read_report(directory)
    refuse_if_unwritable(directory)
    draw_again(loaded, directory)
    typer.echo(f"report: {directory / PAGE}")


def read_report(place: Path) -> Report:
    """Read a report; exit with code 2 and a message if that is not possible."""
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
        typer.echo(f"error: {record} is not a readable report: {reason}", err=True)
        raise typer.Exit(ExitCode.INVALID) from None
