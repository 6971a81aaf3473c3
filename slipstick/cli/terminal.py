"""Output of pairs and tables as plain text on a terminal or in a pipe.

In a pipe, the text has no colours and no line breaks.
"""

import sys
import textwrap
from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from shutil import get_terminal_size

import typer

BETWEEN = "  "  # space between two columns
LEAST_WIDTH = 20  # of the last column, also on a narrow terminal
WIDE = 200  # width of a table that is not printed to a terminal


def print_pairs(pairs: Iterable[tuple[str, str]]) -> None:
    """Print pairs of a name and a text in two columns, one pair per line."""
    pairs = list(pairs)
    width = max(len(word) for word, _ in pairs)
    for word, meaning in pairs:
        typer.echo(
            f"  {typer.style(word.ljust(width), bold=True)}  {escape_control_characters(meaning)}"
        )


def print_message(text: str) -> None:
    """Print a message to stderr in one line, with control characters escaped."""
    typer.echo(escape_control_characters(text), err=True)


def escape_control_characters(text: str) -> str:
    """Escape control characters in a text, so that a scene file cannot control the terminal."""
    return "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text)


def print_table(
    columns: Iterable[str], rows: Iterable[Sequence[str]], *, numbers: bool = False
) -> None:
    """Print a table with column headings to stdout.

    The texts of the last column are broken into lines that fit the width of the terminal.

    numbers  true to right-align all columns but the first, and to divide a table that is wider than
             the terminal into blocks of columns
    """
    headings, rows = list(columns), [list(row) for row in rows]
    width = get_terminal_size().columns if sys.stdout.isatty() else WIDE
    every = list(range(len(headings)))
    for block in _column_blocks(headings, rows, width) if numbers else [every]:
        cells = [[row[position].split("\n") for position in block] for row in (headings, *rows)]
        typer.echo("\n".join(_table_lines(cells, width, numbers)))


def _table_lines(cells: list[list[list[str]]], width: int, numbers: bool) -> Iterator[str]:
    """Yield the lines of a printed table, with a rule below the headings.

    cells    lines of each cell in each row; the headings are the first row
    width    width of the terminal in characters
    numbers  true to right-align all columns but the first
    """
    height = max(map(len, cells[0]))
    cells[0] = [[""] * (height - len(heading)) + heading for heading in cells[0]]
    widths = [max(len(line) for row in cells for line in row[k]) for k in range(len(cells[0]))]
    others = sum(widths[:-1]) + len(BETWEEN) * len(widths)
    widths[-1] = min(widths[-1], max(width - others, LEAST_WIDTH))
    yield ""
    for number, row in enumerate(cells):
        *first, last = row
        wrapped = [part for line in last for part in textwrap.wrap(line, widths[-1]) or [""]]
        for line in zip_longest(*first, wrapped, fillvalue=""):
            texts = (
                escape_control_characters(text).rjust(size)
                if numbers and k
                else escape_control_characters(text).ljust(size)
                for k, (text, size) in enumerate(zip(line, widths, strict=True))
            )
            yield (" " + BETWEEN.join(texts)).rstrip()
        if number == 0:
            yield " " + "─" * (sum(widths) + len(BETWEEN) * (len(widths) - 1))
    yield ""


def _column_blocks(
    headings: Sequence[str], rows: Sequence[Sequence[str]], width: int
) -> list[list[int]]:
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
