"""Command `slipstick export`: write the surface of a run for ParaView."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from contact_results.directory.atomic_file import Refused
from contact_results.directory.file_names import STRESS, SUMMARY
from contact_results.files.stored_run import load
from contact_results.files.surface_file import COLLECTION, write_paraview
from slipstick.cli.options import OutputOption


def export(
    source: Annotated[
        Path,
        typer.Argument(metavar="RUN_DIR", help="Output of 'slipstick run'.", show_default=False),
    ],
    output: OutputOption,
) -> None:
    """Write the surface at the end of every step of a run as VTU files for ParaView.

    The output of 'slipstick stress' has VTU files already. In Python, 'slipstick.load' reads a run.
    """
    if not (source / SUMMARY).is_file():
        if (source / STRESS).is_file():
            raise typer.BadParameter("a stress is VTU already: open its stress_section.vtu")
        raise typer.BadParameter(f"{source} is not the output of a run: it has no {SUMMARY}")
    try:
        write_paraview(load(source), output)
    except (ValueError, KeyError, FileNotFoundError) as error:
        raise Refused(str(error)) from None
    typer.echo(f"{output / COLLECTION} written")
