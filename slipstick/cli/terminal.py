"""Text on a terminal: pairs and tables, without colours and never folded when piped."""

from collections.abc import Iterable, Sequence

import typer

from slipstick.cli.errors import ExitCode

BETWEEN = "  "  # columns, and half of it at either edge
WIDE = 200  # columns of a log, where nobody wants a table to be folded at 80


def print_pairs(pairs: Iterable[tuple[str, str]]) -> None:
    """A word and what it stands for, one line each."""
    pairs = list(pairs)
    width = max(len(word) for word, _ in pairs)
    for word, meaning in pairs:
        typer.echo(f"  {typer.style(word.ljust(width), bold=True)}  {harmless(meaning)}")


def tell(text: str) -> None:
    """A line for people, apart from what the command puts out."""
    typer.echo(harmless(text), err=True)


def harmless(text: str) -> str:
    """The text without control characters: a scene must not steer the terminal that shows it."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def print_table(
    columns: Iterable[str], rows: Iterable[Sequence[str]], *, numbers: bool = False
) -> None:
    """A table whose first column is a name; the others are right-aligned if they are numbers, and
    stand in blocks below each other where they are too many for the terminal."""
    # Imported here because 'slipstick check' shows no table and shall answer at once.
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    class Output(Console):
        def on_broken_pipe(self) -> None:
            try:
                super().on_broken_pipe()
            except SystemExit:  # with 1, which is a verdict
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
    """Positions of the columns that go beside each other, the first in every block."""
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
