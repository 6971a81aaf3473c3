"""A case as it is declared: problems on ladders, and what is judged of them, row by row."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from verification.exhibits.chart import Chart
from verification.exhibits.table import Table
from verification.judging.case import (
    Case,
    Check,
    Comparison,
    Derived,
    Finding,
    Quantity,
    Required,
)
from verification.judging.observable import Observable
from verification.judging.order_of_convergence import (
    NotYetAsymptotic,
    OrderOfChange,
    OrderOfConvergence,
)
from verification.judging.refinement_levels import (
    RefinementLevel,
    RefinementLevels,
)
from verification.judging.run import AnyRun

Allowed = float | Mapping[int, float] | Callable[[RefinementLevel], float]
Results = Mapping[str, Any]
Drawing = Callable[[Results], Chart]


@dataclass(frozen=True)
class Within:
    """A tolerance that was asked for, or is set by hand.

    allowed  relative to the scale of errors; or by the count of cells, which names the rungs that
             are judged; or what it is on a rung. Unless rungs are named the finest is judged
    name     of the verdict, where it is not the observable's
    each     every rung is judged
    """

    what: Observable
    allowed: Allowed
    because: str
    name: str = ""
    each: bool = False


@dataclass(frozen=True)
class Refined:
    """A tolerance derived from refinement: twice the numerical uncertainty, no wider than a cap."""

    what: Observable
    order: float
    cap: Allowed
    because: str


@dataclass(frozen=True)
class Falls:
    """An order of convergence."""

    what: Observable
    expected: float
    because: str
    not_yet: NotYetAsymptotic | None = None
    meaning: str = ""


@dataclass(frozen=True)
class Reported:
    """A number that is not judged."""

    what: Observable
    remark: str


Row = Within | Refined | Falls | Reported


@dataclass(frozen=True)
class Judged:
    """What is judged on the runs of a ladder.

    equations  of the reference, in LaTeX
    """

    runs: tuple[AnyRun, ...]
    quantities: tuple[Quantity, ...] = ()
    orders: tuple[OrderOfConvergence, ...] = ()
    findings: tuple[Finding, ...] = ()
    equations: tuple[str, ...] = ()


def judged(ladder: RefinementLevels, rows: Sequence[Row]) -> Judged:
    """Judge each row on its levels; levels that are not solved have no verdicts."""
    quantities = tuple(quantity for row in rows for quantity in _quantities(row, ladder))
    runs = ladder.runs
    if ladder.uncorrected:
        named = {quantity.run for quantity in quantities}
        if not rows or not all(isinstance(row, Falls) for row in rows):
            named.add(ladder.judged.run.label)
        corrected = tuple(rung.run for rung in ladder.rungs if rung.run.label in named)
        ordered = any(isinstance(row, Falls | Refined) for row in rows)
        runs = (*corrected, *(runs if ordered else ()))
    return Judged(
        runs,
        quantities,
        tuple(_order(row, ladder) for row in rows if isinstance(row, Falls)),
        tuple(_finding(row, ladder) for row in rows if isinstance(row, Reported)),
        ladder.problem.equations,
    )


def case(
    name: str,
    title: str,
    problem: str,
    *parts: Judged,
    runs: tuple[AnyRun, ...] = (),
    quantities: tuple[Quantity, ...] = (),
    findings: tuple[Finding, ...] = (),
    orders: tuple[OrderOfChange, ...] = (),
    comparisons: tuple[Comparison, ...] = (),
    checks: tuple[Check, ...] = (),
    charts: Sequence[Drawing] = (),
    tables: Callable[[Results], tuple[Table, ...]] | None = None,
    limits: tuple[str, ...] = (),
    equations: tuple[str, ...] = (),
    no_order: str = "",
) -> Case:
    """A case of these parts, and of what fits no row. Ladders may share runs."""
    return Case(
        name=name,
        title=title,
        problem=problem,
        runs=tuple(dict.fromkeys((*(run for part in parts for run in part.runs), *runs))),
        quantities=(*(q for part in parts for q in part.quantities), *quantities),
        orders=(*(order for part in parts for order in part.orders), *orders),
        findings=(*(f for part in parts for f in part.findings), *findings),
        comparisons=comparisons,
        checks=checks,
        charts=(lambda results: tuple(draw(results) for draw in charts)) if charts else None,
        tables=tables,
        limits=limits,
        equations=tuple(dict.fromkeys((*(e for p in parts for e in p.equations), *equations))),
        no_order=no_order,
    )


def _quantities(row: Row, ladder: RefinementLevels) -> tuple[Quantity, ...]:
    if isinstance(row, Refined):
        cap = _allowed(row.cap, ladder.judged)
        derived = Derived(ladder.levels, row.order, cap, row.because)
        found = (_quantity(row.what, ladder, ladder.refined, derived),)
        if ladder.refined.run.label == ladder.judged.run.label or row.what.scalar is None:
            return found
        # The corrected method has no order that a tolerance could be derived from.
        return (*found, _quantity(row.what, ladder, ladder.judged, Required(cap, row.because)))
    if not isinstance(row, Within):
        return ()
    if isinstance(row.allowed, Mapping):
        rungs = [rung for rung in ladder.rungs if rung.count in row.allowed]
    else:
        rungs = list(ladder.rungs) if row.each else [ladder.judged]
    return tuple(
        _quantity(
            row.what, ladder, rung, Required(_allowed(row.allowed, rung), row.because), row.name
        )
        for rung in rungs
    )


def _allowed(allowed: Allowed, rung: RefinementLevel) -> float:
    if callable(allowed):
        return allowed(rung)
    return allowed[rung.count] if isinstance(allowed, Mapping) else allowed


def _quantity(
    what: Observable,
    ladder: RefinementLevels,
    rung: RefinementLevel,
    tolerance: Required | Derived,
    name: str = "",
) -> Quantity:
    problem = ladder.problem
    return Quantity(
        name=name or what.verdict,
        meaning=what.said(rung.words),
        unit=what.unit,
        run=rung.run.label,
        measure=what.read(problem),
        reference=what.reference(problem),
        tolerance=tolerance,
        scale=what.scale(problem),
        scale_name=what.scale_name,
        scalar=None if what.scalar is None else (*what.scalar, what.step),
    )


def _order(row: Falls, ladder: RefinementLevels) -> OrderOfConvergence:
    what = row.what
    assert what.of is not None
    return OrderOfConvergence(
        name=f"order_of_{what.name}",
        of=what.of,
        meaning=row.meaning or what.said(ladder.judged.words),
        levels=ladder.levels,
        error=what.error(ladder.problem),
        expected=row.expected,
        because=row.because,
        not_yet=row.not_yet,
    )


def _finding(row: Reported, ladder: RefinementLevels) -> Finding:
    what, rung = row.what, ladder.judged
    return Finding(
        what.verdict, what.said(rung.words), what.unit, rung.run.label,
        what.read(ladder.problem), row.remark,
    )  # fmt: skip
