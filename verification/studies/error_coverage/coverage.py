"""Coverage of stated errors, and the fraction of them that are as small as the true errors."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from scipy.special import betaincinv

from contact_scene.quantities.stated_error import ErrorStatus
from verification.running.row import Row, value_of
from verification.studies.error_coverage.case import STATED, UNCERTAIN, WRONG

CONFIDENCE = 0.95
COVERED, COVERED_IN_ALL = 0.95, 0.97
TIMES = 10.0  # stated errors should be less than so many times the true error
TIGHT = 0.6
CERTAIN = 0.1  # of a stated error: the reference has to be less uncertain
MISSED = 3.0  # uncertainties beyond the stated error that leave no doubt
BELIEVED = str(ErrorStatus.ESTIMATED), str(ErrorStatus.EXACT)
DOUBTED = str(ErrorStatus.NOT_CONVERGED)


@dataclass(frozen=True)
class Share:
    """A count, with the interval of Clopper and Pearson (1934)."""

    count: int
    of: int

    @property
    def part(self) -> float:
        """Observed fraction."""
        return self.count / self.of if self.of else 1.0

    @property
    def interval(self) -> tuple[float, float]:
        """Interval that leaves out 2.5 % on either side."""
        k, n, tail = self.count, self.of, (1 - CONFIDENCE) / 2
        low = float(betaincinv(k, n - k + 1, tail)) if k else 0.0
        high = float(betaincinv(k + 1, n - k, 1 - tail)) if k < n else 1.0
        return low, high

    @property
    def text(self) -> str:
        """Fraction and interval, such as 0.962 [0.931, 0.981]."""
        low, high = self.interval
        return f"{self.part:.3f} [{low:.3f}, {high:.3f}]"


@dataclass(frozen=True)
class Coverage:
    """Counts of a group of numbers.

    covered, tight  of the numbers that are estimated or exact, and decided
    apart           covered ones of those not converged
    undecided       numbers whose reference is not certain enough
    not_stated      numbers without an error
    """

    group: str
    covered: Share
    tight: Share
    apart: Share
    undecided: int
    not_stated: int

    @classmethod
    def of(cls, group: str, rows: Sequence[Row]) -> Coverage:
        """Count the rows of a group."""
        having = [row for row in rows if row.measures[STATED] is not None]
        certain = [row for row in having if is_decided(row)]
        believed = [row for row in certain if row.words["status"] in BELIEVED]
        doubted = [row for row in certain if row.words["status"] == DOUBTED]
        return cls(
            group,
            Share(sum(map(covers, believed)), len(believed)),
            Share(sum(map(is_tight, believed)), len(believed)),
            Share(sum(map(covers, doubted)), len(doubted)),
            len(having) - len(certain),
            len(rows) - len(having),
        )


def covers(row: Row) -> bool:
    """Determine if the true error is within the stated one, up to that of the reference."""
    return value_of(row, WRONG) <= value_of(row, STATED) + value_of(row, UNCERTAIN)


def is_tight(row: Row) -> bool:
    """Determine if the stated error is less than ten times the true one."""
    return value_of(row, STATED) < TIMES * value_of(row, WRONG)


def is_decided(row: Row) -> bool:
    """Determine if the reference is certain enough for a verdict.

    Its uncertainty is an order below the stated error, or the number is missed in any case.
    """
    stated, uncertain = value_of(row, STATED), value_of(row, UNCERTAIN)
    return uncertain <= CERTAIN * stated or value_of(row, WRONG) > stated + MISSED * uncertain


def grouped(rows: Iterable[tuple[str, Row]]) -> dict[str, Coverage]:
    """Count the rows by the names of their groups."""
    groups: dict[str, list[Row]] = {}
    for name, row in rows:
        groups.setdefault(name, []).append(row)
    return {name: Coverage.of(name, members) for name, members in groups.items()}
