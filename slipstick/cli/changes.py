"""Output of changed numbers as a table, and the exit code of a comparison with saved numbers."""

from __future__ import annotations

from collections.abc import Sequence

import typer

from slipstick.cli.errors import ExitCode
from slipstick.cli.terminal import print_table
from verification.regression.change_row import ChangeRow, Comparison, change_table


def print_changes(rows: Sequence[ChangeRow]) -> None:
    """Print a table of changed numbers, without the columns that are empty in all rows."""
    print_table(*change_table(rows))


def print_comparison(found: Comparison) -> ExitCode:
    """Print the changes of numbers since they were saved in a file, and return the exit code.

    The code is 7 if any number is worse or missing, else 0. Better and new numbers are printed with
    the option that saves them.
    """
    if found.rows:
        print_changes(found.rows)
    typer.echo(found.verdict)
    return ExitCode.WORSE if found.worse else ExitCode.PASS
