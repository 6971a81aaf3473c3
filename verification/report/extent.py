"""How much of a study a page shows: that of the quick level is to stay small."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Extent:
    """The most charts of a study, and the most rows of a table."""

    charts: int
    rows: int


ALL = Extent(charts=10_000, rows=1_000_000)
BY_LEVEL = {"quick": Extent(charts=4, rows=40)}  # its page is to have less than 2 MB


def extent(level: str) -> Extent:
    """What a report of this level shows of every study, whose own page always has all of it."""
    return BY_LEVEL.get(level, ALL)
