"""Command `slipstick maintain report`: render a report from its record."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact_results.directory.atomic_file import Refused
from verification.report.file_names import PAGE
from verification.report.files import draw_again, record_in, refuse_if_unwritable
from verification.running.report_record import EARLIER, Report, load_report


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
    loaded = read_report(directory)
    refuse_if_unwritable(directory)
    draw_again(loaded, directory)
    typer.echo(f"report: {directory / PAGE}")


def read_report(place: Path) -> Report:
    """Read the report of a verification; raises Refused if the report is missing or unreadable.

    place  folder of the report, or path of report.json
    """
    record = record_in(place) if place.is_dir() else place
    if not record.is_file():
        earlier = record.parent / EARLIER
        before = f"; the report before it is in {earlier}" if record_in(earlier).is_file() else ""
        raise Refused(f"{record} does not exist; 'slipstick verify' makes it{before}")
    try:
        return load_report(record)
    except ValueError as error:
        reason = str(error).splitlines()[0]
        raise Refused(f"{record} is not a readable report: {reason}") from None
