"""Text on a terminal: pairs and tables, without colours and never folded when piped."""

from collections.abc import Iterable, Sequence

import typer

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
    """A table whose first column is a name; the others are right-aligned if they are numbers."""
    # Imported here because 'slipstick check' shows no table and shall answer at once.
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=SIMPLE_HEAD, pad_edge=False, collapse_padding=True)
    for position, column in enumerate(columns):
        table.add_column(column, justify="right" if numbers and position else "left")
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    console = Console(highlight=False)
    if not console.is_terminal:
        console.width = WIDE
    console.print(table)
