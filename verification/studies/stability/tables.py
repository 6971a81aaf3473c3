"""The tables of the stability map."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

from verification.exhibits.numbers import plain
from verification.exhibits.table import Table
from verification.studies.stability.cell import Solver, StabilityCell
from verification.studies.stability.charts import class_of
from verification.studies.stability.record import CellRecord, Verdict
from verification.studies.stability.verdicts import NAMES, WORK

Found = Mapping[StabilityCell, CellRecord]
Item = tuple[StabilityCell, CellRecord]

MOST_ROWS = 60  # of good cells; the others have all of theirs
NOT_SOLVED = (Verdict.NOT_CONVERGED, Verdict.SILENT)


def tables(found: Found) -> tuple[Table, ...]:
    """The solvers, what did not converge, and the cells of either kind of solver."""
    groups = [[i for i in found.items() if i[0].solver.by_elements is kind] for kind in WORK]
    bad = [item for item in found.items() if item[1].verdict in NOT_SOLVED]
    return (
        _of_solvers(found),
        *([_of_bad(bad)] if bad else []),
        *(_of_cells(group) for group in reversed(groups) if group),
    )


def _of_solvers(found: Found) -> Table:
    rows = []
    for solver in Solver:
        records = [record for cell, record in found.items() if cell.solver is solver]
        counts = Counter(record.verdict for record in records)
        solved = [r for r in records if r.verdict is Verdict.CONVERGED]
        rows.append((
            NAMES[solver], str(len(records)), *(str(counts[verdict]) for verdict in Verdict),
            _number(max((r.residual or 0.0 for r in solved), default=None)),
            _number(max((r.observed or 0.0 for r in solved), default=None)),
            str(sum(r.increments for r in solved)), str(sum(r.work for r in solved)),
        ))  # fmt: skip
    return Table(
        title="The solvers",
        columns=("solver", "cells", *Verdict, "largest residual", "from the fields",
                 "increments", "work"),
        rows=tuple(rows),
        note="Work: convolutions of the semi-analytical solver, linear systems of the finite "
        "elements.",
    )  # fmt: skip


def _of_bad(bad: list[Item]) -> Table:
    return Table(
        title=f"Not solved: all of these {len(bad)} cells",
        columns=("cell", "verdict", "worst residual", "reason"),
        rows=tuple((c.name, r.verdict, _number(r.worst), r.reason or "–") for c, r in bad),
    )


def _of_cells(group: list[Item]) -> Table:
    """The worst classes first, of one those that halved increments, then the dearest."""
    by_elements = group[0][0].solver.by_elements
    solver = "finite elements" if by_elements else "the semi-analytical solver"
    ranked = sorted(group, key=_hardness)
    shown = [item for n, item in enumerate(ranked) if n < MOST_ROWS]
    all_of_them = f"The cells of {solver}"
    some = f"The {len(shown)} hardest of {len(group)} cells of {solver}"
    return Table(
        title=all_of_them if len(shown) == len(group) else some,
        columns=("cell", "verdict", "worst residual", "from the fields", "increments", "halved",
                 "way", "rounds", WORK[by_elements]),
        rows=tuple(_row(cell, record) for cell, record in shown),
        note="A cell is named by the coordinates that differ from the ordinary ones; all of them "
        "are in `rows.csv`, which `slipstick study stability` writes. Rounds: the most that "
        "pressure and shear took to agree in an increment.",
    )  # fmt: skip


def _hardness(item: Item) -> tuple[int, int, int]:
    record = item[1]
    return -class_of(record), -record.halvings, -record.work


def _outcome(record: CellRecord) -> str:
    """The verdict and its reason, without the name of the exception that begins a refusal."""
    reason = record.reason
    if record.verdict is Verdict.REFUSED:
        reason = reason.partition(": ")[2] or reason
    return f"{record.verdict}: {reason}" if reason else str(record.verdict)


def _row(cell: StabilityCell, record: CellRecord) -> tuple[str, ...]:
    return (
        cell.name,
        _outcome(record),
        _number(record.residual),
        _number(record.observed),
        str(record.increments),
        str(record.halvings),
        record.way or "–",
        str(record.rounds),
        str(record.work),
    )


def _number(value: float | None) -> str:
    return "–" if value is None else plain(value, 2)
