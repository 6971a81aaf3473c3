"""What an accuracy costs, as rows: one for every quantity, method and target.

parameters  contact, quantity, title of both, method, target (error), chart (name of the diagram)
measures    cost, of the cheapest setting or extrapolated, null without either; error there;
            least_error that was seen
words       reached (one of `Reached`); setting; code, where other codes share a method
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from enum import StrEnum
from itertools import groupby

from verification.exhibits.numbers import EXTRAPOLATED, NOT_REACHED, plain
from verification.running.row import Row, value_of

COST, ERROR, LEAST = "cost", "error", "least_error"


class Reached(StrEnum):
    """Whether a method reaches an accuracy."""

    TRIED = "by a setting that was tried"
    BEYOND = "by the order in which the last errors of a curve fell"
    NOT = "not"


def is_reached(row: Row) -> bool:
    """Whether a setting that was tried is accurate enough."""
    return row.words["reached"] == Reached.TRIED


def cost_text(row: Row) -> str:
    """What the accuracy costs."""
    cost = row.measures[COST]
    if cost is None:
        return NOT_REACHED
    guess = "" if is_reached(row) else f"{EXTRAPOLATED} "
    who = f" ({row.words['code']})" if "code" in row.words else ""
    return f"{guess}{plain(cost, 2)} {row.units[COST]}{who}"


def setting_and_cost(row: Row) -> str:
    """The same with the setting that it takes."""
    return cost_text(row) + (f": {row.words['setting']}" if "setting" in row.words else "")


def at_target(rows: Iterable[Row], target: float) -> tuple[Row, ...]:
    """Those of one accuracy."""
    return tuple(row for row in rows if row.parameters["target"] == target)


def by_quantity(rows: Iterable[Row]) -> Iterator[tuple[str, Sequence[Row]]]:
    """Title of every quantity, and its rows."""
    for title, of in groupby(rows, lambda row: row.parameters["title"]):
        yield str(title), tuple(of)


def cheapest_row(rows: Iterable[Row], reached: Reached = Reached.TRIED) -> Row | None:
    """The one that costs least, of those that reach the accuracy so; None without any."""
    found = (row for row in rows if row.words["reached"] == reached)
    return min(found, key=lambda row: value_of(row, COST), default=None)
