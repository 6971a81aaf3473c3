"""Output of changed numbers as a table, and the exit code of a comparison with saved numbers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import typer

from slipstick.cli.errors import ExitCode
from slipstick.cli.terminal import print_table
from verification.regression.change_row import ChangeRow

COLUMNS = ("quantity", "run", "change", "was", "is", "moved by", "since", "remark")
EMPTY = ("", "–")


def print_changes(rows: Sequence[ChangeRow]) -> None:
    """Print a table of changed numbers, without the columns that are empty in all rows."""
    cells = [
        (f"{r.case}/{r.name}", r.run, r.kind, r.was, r.now, r.moved, r.since, r.remark)
        for r in rows
    ]
    kept = [k for k in range(len(COLUMNS)) if any(row[k] not in EMPTY for row in cells)]
    print_table([COLUMNS[k] for k in kept], [[row[k] for k in kept] for row in cells])


def compare_with_file(rows: Sequence[ChangeRow], file: Path, save: str) -> ExitCode:
    """Print the changes of numbers since they were saved in a file, and return the exit code.

    The code is 7 if any number is worse or missing, else 0. Better and new numbers are printed with
    the option that saves them.

    rows  changes, the worst first
    file  file of the saved numbers
    save  words that save numbers, such as "--save FILE"
    """
    if rows:
        print_changes(rows)
    kinds = Counter(row.kind for row in rows)
    counts = ", ".join(f"{number} {kind}" for kind, number in kinds.items())
    worse = any(kind.regresses for kind in kinds)
    if worse:
        verdict = f"worse than {file}: {counts}"
    elif rows:
        verdict = f"nothing is worse than {file}: {counts}; {save} saves the present numbers"
    else:
        verdict = f"nothing has changed since {file}"
    typer.echo(verdict)
    return ExitCode.WORSE if worse else ExitCode.PASS
