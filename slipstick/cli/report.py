"""`slipstick maintain report`: render a report again from its record."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from slipstick.cli.report_file import read_report


def report(
    directory: Annotated[
        Path,
        typer.Argument(metavar="DIR", help="A directory that 'slipstick verify' wrote."),
    ] = Path("reports/quick"),
) -> None:
    """Render the report again from its report.json; nothing is computed.

    For a report of an earlier version, or one of which only report.json was kept, as it is or
    packed by 'xz report.json'. Exit code 2 if there is none, or none that this version can read.
    """
    from verification.report.files import PAGE, draw_again, refuse_if_unwritable

    loaded = read_report(directory)
    refuse_if_unwritable(directory)
    draw_again(loaded, directory)
    typer.echo(f"report: {directory / PAGE}")
