"""Output of pairs and tables as plain text on a terminal or in a pipe.

In a pipe, the text has no colours and no line breaks.
"""

from collections.abc import Iterable, Sequence

import typer

from slipstick.cli.errors import ExitCode

BETWEEN = "  "  # space between two columns
WIDE = 200  # width of a table that is not printed to a terminal


def print_pairs(pairs: Iterable[tuple[str, str]]) -> None:
    """Print pairs of a name and a text in two columns, one pair per line."""
    pairs = list(pairs)
    width = max(len(word) for word, _ in pairs)
    for word, meaning in pairs:
        typer.echo(f"  {typer.style(word.ljust(width), bold=True)}  {harmless(meaning)}")


def tell(text: str) -> None:
    """Print a message to stderr in one line, with control characters escaped."""
    typer.echo(harmless(text), err=True)


def harmless(text: str) -> str:
    """Escape control characters in a text, so that a scene file cannot control the terminal."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def print_table(
    columns: Iterable[str], rows: Iterable[Sequence[str]], *, numbers: bool = False
) -> None:
    """Print a table with column headings to stdout.

    numbers  true to right-align all columns but the first, and to divide a table that is wider than
             the terminal into blocks of columns
    """
    # Imported here, because `slipstick check` prints no table and should start fast.
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    class Output(Console):
        def on_broken_pipe(self) -> None:
            try:
                super().on_broken_pipe()
            except SystemExit:  # code 1 would be an accuracy verdict
                raise SystemExit(ExitCode.NOBODY_READS) from None

    console = Output(highlight=False)
    if not console.is_terminal:
        console.width = WIDE
    headings, rows = list(columns), [list(row) for row in rows]
    every = range(len(headings))
    for block in _blocks(headings, rows, console.width) if numbers else [every]:
        table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
        for position in block:
            table.add_column(
                headings[position], justify="right" if numbers and position else "left"
            )
        for row in rows:
            table.add_row(*(Text(row[position]) for position in block))
        console.print(table)


def _blocks(headings: Sequence[str], rows: Sequence[Sequence[str]], width: int) -> list[list[int]]:
    """Divide the columns of a printed table into blocks that fit the width of the terminal.

    Returns the column indices of each block. Each block begins with the first column of the table.

    headings  headings of the columns
    rows      texts of the rows
    width     width of the terminal in characters
    """
    lines = [
        [*heading.split("\n"), *(row[k] for row in rows)] for k, heading in enumerate(headings)
    ]
    widths = [max(map(len, of_column)) + len(BETWEEN) for of_column in lines]
    blocks = [[0]]
    for position in range(1, len(headings)):
        taken = sum(widths[k] for k in blocks[-1])
        if len(blocks[-1]) > 1 and taken + widths[position] > width:
            blocks.append([0])
        blocks[-1].append(position)
    return blocks
