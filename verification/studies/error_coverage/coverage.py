"""How often stated errors hold, and how often they are of the size of what is wrong."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from scipy.special import betaincinv

from verification.running.row import Row, value_of
from verification.studies.error_coverage.case import STATED, UNCERTAIN, WRONG

CONFIDENCE = 0.95
COVERED = 0.95
TIMES = 10.0  # stated errors should be less than so many times what is wrong
TIGHT = 0.6


@dataclass(frozen=True)
class Share:
    """So many of all, with Clopper and Pearson's interval (1934)."""

    count: int
    of: int

    @property
    def part(self) -> float:
        """Observed."""
        return self.count / self.of

    @property
    def interval(self) -> tuple[float, float]:
        """That leaves out 2.5 % on either side."""
        k, n, tail = self.count, self.of, (1 - CONFIDENCE) / 2
        low = float(betaincinv(k, n - k + 1, tail)) if k else 0.0
        high = float(betaincinv(k + 1, n - k, 1 - tail)) if k < n else 1.0
        return low, high

    @property
    def text(self) -> str:
        """0.962 [0.931, 0.981]."""
        low, high = self.interval
        return f"{self.part:.3f} [{low:.3f}, {high:.3f}]"


@dataclass(frozen=True)
class Coverage:
    """Of numbers of one kind with a stated error."""

    kind: str
    covered: Share
    tight: Share

    @classmethod
    def of(cls, kind: str, rows: Sequence[Row]) -> Coverage:
        """By rows that have one."""
        return cls(
            kind,
            Share(sum(map(covers, rows)), len(rows)),
            Share(sum(map(is_tight, rows)), len(rows)),
        )

    @property
    def good(self) -> bool:
        """Whether both demands are met."""
        return self.covered.part >= COVERED and self.tight.part >= TIGHT


def covers(row: Row) -> bool:
    """Whether what is wrong lies within the stated error, as far as the truth is certain."""
    return value_of(row, WRONG) <= value_of(row, STATED) + value_of(row, UNCERTAIN)


def is_tight(row: Row) -> bool:
    """Whether the stated error is of the size of what is wrong."""
    return value_of(row, STATED) < TIMES * value_of(row, WRONG)


def with_status(rows: Iterable[Row], *statuses: str) -> list[Row]:
    """Those whose error has one of these statuses."""
    return [row for row in rows if row.words["status"] in statuses]
