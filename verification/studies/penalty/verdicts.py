"""What the rows say about the penalty."""

from __future__ import annotations

from collections.abc import Iterable
from math import pi

from verification.exhibits.numbers import plain
from verification.judging.case import Level
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.row import CaseRecord, Row, rows_of
from verification.running.rules import converged, judged, total, within
from verification.running.study import Statement
from verification.studies.penalty.case import FRICTIONAL, PenaltyCase
from verification.studies.penalty.families import (
    DEFAULT,
    Found,
    all_cases,
    of_friction,
    of_increments,
    of_springs,
)

LAW = 0.1  # by which k times the error may miss 1/π: the next order in 1/k, and the mesh
ABOVE_MESH = 20.0  # times the error of the mesh, from where the law is judged
FEWEST = 2  # runs that have to be there
WITHIN = {"approach": 2e-3, "peak": 2e-3}
WITH_FRICTION = {"approach": 1e-3, "pressure": 5e-3, "shear": 3e-2}
ASKED = "asked of the finite elements with a penalty"


def statements(level: Level, found: Found) -> tuple[Statement, ...]:
    """All of them, in the order of the page."""
    asked = all_cases(level)
    rows = rows_of(asked, found)
    at_default = [case for case in of_springs(level) if case.factor == DEFAULT]
    few = [case for case in at_default if case.augmentations < 2]
    frictional = _with_friction(level, DEFAULT)
    return (
        converged(
            rows,
            SOLVER_TOLERANCE,
            f"in {total(rows, 'increments')} increments of {len(rows)} runs, "
            f"{total(rows, 'halvings')} of them halved",
            claim="every increment converges, for c from 1 to 1000",
            asked=len(asked),
        ),
        *_laws_of_springs(level, found),
        within(
            f"Hertz at c = {DEFAULT:g}, without augmentation and with one",
            rows_of(few, found), WITHIN, ASKED, asked=len(few),
        ),
        within(
            f"pressing with friction at c = {DEFAULT:g} with one augmentation",
            rows_of(frictional, found), WITH_FRICTION, ASKED, asked=len(frictional),
        ),
        _augmented(rows_of(at_default, found)),
        _by_newton(level, found),
        _of_increments(rows_of(of_increments(level), found)),
    )  # fmt: skip


def _with_friction(level: Level, factor: float) -> list[PenaltyCase]:
    """All contacts with one augmentation."""
    cases = (case for contact in FRICTIONAL for case in of_friction(level, contact, 1))
    return [case for case in cases if case.factor == factor]


def _laws_of_springs(level: Level, found: Found) -> tuple[Statement, Statement]:
    rows = _springs(level, found)
    missed = max((abs(k * pi - 1) for k in _times_k(rows, "approach")), default=0.0)
    complete = len(rows_of(of_springs(level), found)) == len(of_springs(level))
    return (
        Statement(
            claim="springs alone make the approach too large by 1/πk",
            outcome=judged(len(rows) >= FEWEST and missed <= LAW, complete=complete),
            measured=f"within {100 * missed:.1f} % for c = {_texts(rows, 'factor')}",
            because="the energy of the springs, to first order in 1/k; k = ε a/E*",
        ),
        Statement(
            claim="and the peak pressure too small by a constant over k",
            outcome=None,
            measured="k times its relative error: "
            + ", ".join(plain(value, 2) for value in _times_k(rows, "peak")),
        ),
    )


def _augmented(rows: Iterable[Row]) -> Statement:
    rows = tuple(rows)
    return Statement(
        claim="one augmentation is enough",
        outcome=None,
        measured=f"with 0, 1, 2, 3 of them at c = {DEFAULT:g}: error of the approach "
        f"{_texts(rows, 'approach')}; of the peak {_texts(rows, 'peak')}; of the pressure in the "
        f"L2 norm {_texts(rows, 'ripple')}",
        because="more of them shift no number that matters, and ripple at the edge",
    )


def _by_newton(level: Level, found: Found) -> Statement:
    parts = []
    for factor in (10.0, 100.0, 1000.0):
        rows = rows_of(_with_friction(level, factor), found)
        if increments := total(rows, "increments"):
            newton = increments - total(rows, "by_springs")
            parts.append(f"c = {factor:g}: {newton} of {increments}")
    return Statement(
        claim="Newton's method solves most increments with friction",
        outcome=None,
        measured="; ".join(parts) or "–",
        because="the others, the first of every history among them, take springs in series",
    )


def _of_increments(rows: Iterable[Row]) -> Statement:
    parts = (
        f"{row.parameters['increments']}: q {plain(row.measures['shear'], 2)}, "
        f"approach {plain(row.measures['approach'], 2)}"
        for row in rows
    )
    return Statement(
        claim="the shear is what increments decide",
        outcome=None,
        measured="; ".join(parts) or "–",
        because="errors by the number of increments, µ = 0.3",
    )


def _springs(level: Level, found: Found) -> list[CaseRecord]:
    """Runs without augmentation whose error is far above the mesh's, and of first order."""
    best = (c for c in of_springs(level) if c.factor == 100 and c.augmentations == 1)
    mesh = max((abs(r.number("approach") or 0.0) for r in rows_of(best, found)), default=0.0)
    bare = (c for c in of_springs(level) if c.augmentations == 0 and c.factor > 1)
    return [
        row
        for row in rows_of(bare, found)
        if abs(row.number("approach") or 0.0) > ABOVE_MESH * mesh
    ]


def _times_k(rows: Iterable[Row], error: str) -> list[float]:
    return [(r.number("springs_per_radius") or 0.0) * (r.number(error) or 0.0) for r in rows]


def _texts(rows: Iterable[Row], name: str) -> str:
    return ", ".join(plain(row.number(name), 2) for row in rows)
