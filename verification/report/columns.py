"""Columns of a table: numbers stand to the right with their unit above, words to the left."""

from __future__ import annotations

import re

from verification.exhibits.table import Table

WORDS_FROM = 30  # characters of a cell that make its column one of words
DIGITS = frozenset("0123456789")
EXPONENT = re.compile(r"(?<=\d)e[+−-]?\d+")
DIMENSIONLESS = "–"
NUMBER, WORDS = "number", "words"  # classes of the style sheet


def alignment(table: Table, column: int) -> str:
    """The class of a column's cells."""
    cells = [row[column] for row in table.rows if len(row) > column]
    with_digits = all(DIGITS & set(cell) or len(cell) < 2 for cell in cells)  # – is no word
    short = max(map(len, cells), default=0) < WORDS_FROM
    return NUMBER if with_digits and short else WORDS


def heading(table: Table, column: int) -> str:
    """The head of a column, with the unit of its numbers where their cells do not name it."""
    head = table.columns[column]
    if table.units is None or column == 0 or alignment(table, column) == WORDS:
        return head
    unit = table.units.get(head)
    if unit is None:
        bare = all(_is_bare(row[column]) for row in table.rows if len(row) > column)
        unit = DIMENSIONLESS if bare else ""
    return f"{head} [{unit}]" if unit else head


def _is_bare(cell: str) -> bool:
    """Whether there is neither a word nor a unit beside a number."""
    return not any(sign.isalpha() or sign == "%" for sign in EXPONENT.sub("", cell))
