"""Columns of a table: numbers stand to the right, words to the left."""

from __future__ import annotations

from verification.exhibits.table import Table

WORDS_FROM = 30  # characters of a cell that make its column one of words
DIGITS = frozenset("0123456789")
NUMBER, WORDS = "number", "words"  # classes of the style sheet


def alignment(table: Table, column: int) -> str:
    """The class of a column's cells."""
    cells = [row[column] for row in table.rows if len(row) > column]
    with_digits = all(DIGITS & set(cell) or len(cell) < 2 for cell in cells)  # – is no word
    short = max(map(len, cells), default=0) < WORDS_FROM
    return NUMBER if with_digits and short else WORDS
