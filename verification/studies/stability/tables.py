"""The tables of the stability map."""

from __future__ import annotations

from collections.abc import Iterable

from verification.exhibits.numbers import plain
from verification.exhibits.table import Table, table_of
from verification.studies.stability.cell import Solver
from verification.studies.stability.charts import class_of
from verification.studies.stability.record import CellRecord, Verdict
from verification.studies.stability.verdicts import NAMES, WORK, Found, Item, ended, of_solver

MAX_ROWS = 60  # of good cells; the others have all of theirs


def tables(found: Found) -> tuple[Table, ...]:
    """The solvers, what did not converge, and the cells of either kind of solver."""
    groups = [[i for i in found.items() if i[0].solver.by_elements is kind] for kind in WORK]
    bad = [*ended(found, Verdict.NOT_CONVERGED, Verdict.SILENT).items()]
    return (
        _of_solvers(found),
        *([_of_bad(bad)] if bad else []),
        *(_of_cells(group) for group in reversed(groups) if group),
    )


def _of_solvers(found: Found) -> Table:
    cells = {solver: of_solver(found, solver) for solver in Solver}
    solved = {solver: [*ended(of, Verdict.CONVERGED).values()] for solver, of in cells.items()}
    return table_of(
        "The solvers",
        {
            "solver": lambda s: NAMES[s],
            "cells": lambda s: str(len(cells[s])),
            **{v: lambda s, v=v: str(len(ended(cells[s], v))) for v in Verdict},  # type: ignore[misc]
            "largest residual": lambda s: _largest(r.residual for r in solved[s]),
            "from the fields": lambda s: _largest(r.observed for r in solved[s]),
            "increments": lambda s: str(sum(r.increments for r in solved[s])),
            "work": lambda s: str(sum(r.work for r in solved[s])),
        },
        Solver,
        "Work: convolutions of the semi-analytical solver, linear systems of the finite elements.",
    )


def _of_bad(bad: list[Item]) -> Table:
    return table_of(
        f"Not solved: all of these {len(bad)} cells",
        {
            "cell": lambda i: i[0].name,
            "verdict": lambda i: i[1].verdict,
            "worst residual": lambda i: _number(i[1].worst),
            "reason": lambda i: i[1].reason or "–",
        },
        bad,
    )


def _of_cells(group: list[Item]) -> Table:
    """The worst classes first, of one those that halved increments, then the dearest."""
    by_elements = group[0][0].solver.by_elements
    solver = "finite elements" if by_elements else "the semi-analytical solver"
    shown = sorted(group, key=_hardness)[:MAX_ROWS]
    some = f"The {len(shown)} hardest of {len(group)} cells of {solver}"
    return table_of(
        f"The cells of {solver}" if len(shown) == len(group) else some,
        {
            "cell": lambda i: i[0].name,
            "verdict": lambda i: _outcome(i[1]),
            "worst residual": lambda i: _number(i[1].residual),
            "from the fields": lambda i: _number(i[1].observed),
            "increments": lambda i: str(i[1].increments),
            "halved": lambda i: str(i[1].halvings),
            "way": lambda i: i[1].way or "–",
            "rounds": lambda i: str(i[1].rounds),
            WORK[by_elements]: lambda i: str(i[1].work),
        },
        shown,
        "A cell is named by the coordinates that differ from the ordinary ones; all of them "
        "are in `rows.csv`, which `slipstick maintain study stability` writes. Rounds: the most "
        "that pressure and shear took to agree in an increment.",
    )


def _hardness(item: Item) -> tuple[int, int, int]:
    record = item[1]
    return -class_of(record), -record.halvings, -record.work


def _outcome(record: CellRecord) -> str:
    """The verdict and its reason, without the name of the exception that begins a refusal."""
    reason = record.reason
    if record.verdict is Verdict.REFUSED:
        reason = reason.partition(": ")[2] or reason
    return f"{record.verdict}: {reason}" if reason else str(record.verdict)


def _largest(values: Iterable[float | None]) -> str:
    return _number(max((value or 0.0 for value in values), default=None))


def _number(value: float | None) -> str:
    return "–" if value is None else plain(value, 2)
