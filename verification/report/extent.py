"""How much of a study a page shows; a report of a higher level has all of it on pages beside."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Extent:
    """The most charts of a study, the most rows of a table, and whether studies have pages."""

    charts: int = 4
    rows: int = 1_000_000
    appendices: bool = True


BY_LEVEL = {"quick": Extent(rows=40, appendices=False)}  # its page is to have less than 1 MB


def extent(level: str) -> Extent:
    """What a report of this level shows of every study, whose own page always has all of it."""
    return BY_LEVEL.get(level, Extent())
