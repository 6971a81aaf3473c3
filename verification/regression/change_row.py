"""Changes of numbers since they were recorded, as rows of a table: the worst first."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from verification.judging.outcome import ChangeKind, CounterChange

ABSENT = "–"

# The worst first.
RANK = {
    kind: rank
    for rank, kind in enumerate(
        (
            ChangeKind.OUTSIDE,
            ChangeKind.WORSE,
            ChangeKind.DEARER,
            ChangeKind.GONE,
            ChangeKind.DRIFT,
            ChangeKind.BETTER,
            ChangeKind.NEW,
        )
    )
}


@dataclass(frozen=True)
class ChangeRow:
    """Difference between a number and its recorded value, as texts of a table.

    case      name of the verification case, challenge or command
    name      name of the quantity
    run       name of the run, load step or point
    kind      kind of the change, such as worse, better or new
    was, now  recorded and present value
    moved     size of the change in words
    since     name of the origin (commit or file) of the recorded value
    remark    explanation of the change
    size      size of the change, in tolerances or as fraction of a count, for sorting
    """

    case: str
    name: str
    run: str
    kind: ChangeKind
    was: str = ABSENT
    now: str = ABSENT
    moved: str = ABSENT
    since: str = ABSENT
    remark: str = ""
    size: float = 0.0

    @property
    def line(self) -> str:
        """Text of the change of a result since the recorded baseline, as one line of a log."""
        moved = "" if self.moved == ABSENT else f" ({self.moved})"
        remark = f"; {self.remark}" if self.remark else ""
        return (
            f"{self.kind} {self.case}/{self.name} [{self.run}]: {self.now}, was {self.was} "
            f"at {self.since}{moved}{remark}"
        )


def count_row(case: str, run: str, change: CounterChange, since: str) -> ChangeRow:
    """Return the row of a changed count of work, whose size is the relative change.

    case, run  names of the case and of the counted runs
    since      name of the origin of the recorded count
    """
    return ChangeRow(
        case,
        change.name,
        run,
        change.kind,
        str(change.was),
        str(change.now),
        since=since,
        remark=change.remark,
        size=abs(change.now / max(change.was, 1) - 1),
    )


def rows_that_matter(rows: Iterable[ChangeRow]) -> list[ChangeRow]:
    """Return the rows of changed numbers, sorted by severity of their kind, then by size."""
    changed = [row for row in rows if row.kind.matters]
    return sorted(changed, key=lambda row: (RANK[row.kind], -row.size))
