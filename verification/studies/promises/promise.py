"""A promise, and how it is tried."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from verification.judging.case import Level


@dataclass(frozen=True)
class Attempt:
    """One try.

    kept     whether the promise was kept
    told     what happened, for one that was not
    measure  what the promise bounds, where it bounds a number
    """

    kept: bool
    told: str = ""
    measure: float | None = None


@dataclass(frozen=True)
class Promise:
    """A row of the table.

    claim     what is promised, with its figure
    attempt   what is tried, in words
    tries     how often at the quick level, and at the higher ones
    attempts  makes so many tries; each is another one, and the same at every run
    measured  what is measured of each and its unit; empty for nothing
    """

    name: str
    claim: str
    attempt: str
    tries: tuple[int, int]
    attempts: Callable[[int], Iterable[Attempt]]
    measured: str = ""

    def count(self, level: Level) -> int:
        """How many tries there are at a level."""
        return self.tries[level is not Level.QUICK]
