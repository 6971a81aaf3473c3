"""`slipstick maintain deposit`: write the reference tables for publication."""

from datetime import datetime
from pathlib import Path
from typing import Annotated

import typer


def deposit(
    output: Annotated[Path, typer.Option("--output", "-o", help="New directory of the crate.")],
    date: Annotated[
        datetime,
        typer.Option(formats=["%Y-%m-%d"], help="Date of publication, stored in the metadata."),
    ],
) -> None:
    """Write all reference tables as CSV and JSON in an RO-Crate (CC-BY; 3 min)."""
    from slipstick.tables.deposit import datasets, write

    if output.exists():
        raise typer.BadParameter(f"'{output}' exists; give a new directory")
    try:
        write(output, datasets(), date.date())
    except ModuleNotFoundError as error:
        raise typer.BadParameter(f"{error}; install it with pip install '.[deposit]'") from error
    typer.echo(f"{output}: {len(list(output.iterdir()))} files")
