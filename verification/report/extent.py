"""How much the pages of a report show; at a higher level studies have pages of their own."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Extent:
    """Most charts of a study and rows of a table; pages of studies beside the report; a table of
    the solves."""

    charts: int = 4
    rows: int = 1_000_000
    appendices: bool = True
    solves: bool = True


# Its pages are to have less than 1 MB each.
QUICK = Extent(charts=2, rows=40, appendices=False, solves=False)


def extent(level: str) -> Extent:
    """What a report of this level shows."""
    return QUICK if level == "quick" else Extent()
