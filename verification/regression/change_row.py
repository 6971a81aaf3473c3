"""Changes of numbers since they were recorded, as rows of a table: the worst first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from verification.judging.outcome import ChangeKind, CounterChange

ABSENT = "–"
COLUMNS = ("quantity", "run", "change", "was", "is", "moved by", "since", "remark")
EMPTY = ("", ABSENT)

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


@dataclass(frozen=True)
class Comparison:
    """Comparison of numbers with those that were saved in a file.

    rows  changes, the worst first
    file  file of the saved numbers
    save  words that save numbers, such as "--save FILE"
    """

    rows: tuple[ChangeRow, ...]
    file: Path
    save: str

    @property
    def worse(self) -> bool:
        """True if any number is worse or missing."""
        return any(row.kind.regresses for row in self.rows)

    @property
    def verdict(self) -> str:
        """Result in one line: counts of the changes, and the option that saves new numbers."""
        kinds = Counter(row.kind for row in self.rows)
        counts = ", ".join(f"{number} {kind}" for kind, number in kinds.items())
        if self.worse:
            return f"worse than {self.file}: {counts}"
        if not self.rows:
            return f"nothing has changed since {self.file}"
        saving = f"{self.save} saves the present numbers"
        return f"nothing is worse than {self.file}: {counts}; {saving}"


def change_table(rows: Iterable[ChangeRow]) -> tuple[tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """Return headings and cells of a table of changes, without columns that are empty in all
    rows."""
    cells = [
        (f"{r.case}/{r.name}", r.run, r.kind, r.was, r.now, r.moved, r.since, r.remark)
        for r in rows
    ]
    kept = [k for k in range(len(COLUMNS)) if any(row[k] not in EMPTY for row in cells)]
    return tuple(COLUMNS[k] for k in kept), tuple(tuple(row[k] for k in kept) for row in cells)


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
