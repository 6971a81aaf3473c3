"""What the records say about the penalty."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from math import pi

from verification.exhibits.numbers import plain
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.judging.run import SOLVER_TOLERANCE
from verification.running.study import Statement
from verification.studies.penalty.case import FRICTIONAL, PenaltyCase, PenaltyRecord
from verification.studies.penalty.families import (
    DEFAULT,
    all_cases,
    of_friction,
    of_increments,
    of_springs,
)

Found = Mapping[PenaltyCase, PenaltyRecord]
Value = Callable[[PenaltyRecord], float | None]

LAW = 0.1  # by which k times the error may miss 1/π: the next order in 1/k, and the mesh
ABOVE_MESH = 20.0  # times the error of the mesh, from where the law is judged
FEWEST = 2  # runs that have to be there
WITHIN = {"approach": 2e-3, "peak": 2e-3}
WITH_FRICTION = {"approach": 1e-3, "pressure": 5e-3, "shear": 3e-2}


def statements(level: Level, found: Found) -> tuple[Statement, ...]:
    """All of them, in the order of the page."""
    return (
        _converged(level, found),
        _law_of_springs(level, found),
        _law_of_the_peak(level, found),
        _default(level, found),
        _default_with_friction(level, found),
        _augmented(level, found),
        _by_newton(level, found),
        _of_increments(level, found),
    )


def _converged(level: Level, found: Found) -> Statement:
    records = [found[case] for case in all_cases(level) if case in found]
    worst = max((record.largest_residual for record in records), default=0.0)
    increments = sum(record.increments for record in records)
    halved = sum(record.halvings for record in records)
    return Statement(
        claim="every increment converges, for c from 1 to 1000",
        outcome=_judged(worst <= SOLVER_TOLERANCE, found, all_cases(level)),
        measured=f"largest residual {plain(worst, 2)} in {increments} increments of "
        f"{len(records)} runs, {halved} of them halved",
        because=f"allowed {SOLVER_TOLERANCE:g}",
    )


def _law_of_springs(level: Level, found: Found) -> Statement:
    cases = _springs(level, found)
    missed = max((abs(_times_k(c, found[c].approach) * pi - 1) for c in cases), default=0.0)
    return Statement(
        claim="springs alone make the approach too large by 1/πk",
        outcome=_judged(len(cases) >= FEWEST and missed <= LAW, found, of_springs(level)),
        measured=f"within {100 * missed:.1f} % for c = {_texts(c.factor for c in cases)}",
        because="the energy of the springs, to first order in 1/k; k = ε a/E*",
    )


def _law_of_the_peak(level: Level, found: Found) -> Statement:
    values = [_times_k(c, found[c].peak) for c in _springs(level, found)]
    return Statement(
        claim="and the peak pressure too small by a constant over k",
        outcome=None,
        measured=f"k times its relative error: {_texts(values)}",
    )


def _default(level: Level, found: Found) -> Statement:
    cases = [c for c in of_springs(level) if c.factor == DEFAULT and c.augmentations < 2]
    return _within(
        f"Hertz at c = {DEFAULT:g}, without augmentation and with one", cases, found, WITHIN
    )


def _default_with_friction(level: Level, found: Found) -> Statement:
    cases = [
        case
        for contact in FRICTIONAL
        for case in of_friction(level, contact, 1)
        if case.factor == DEFAULT
    ]
    return _within(
        f"pressing with friction at c = {DEFAULT:g} with one augmentation", cases, found,
        WITH_FRICTION,
    )  # fmt: skip


def _within(
    what: str, cases: Sequence[PenaltyCase], found: Found, allowed: Mapping[str, float]
) -> Statement:
    worst = {
        name: max((abs(getattr(found[c], name) or 0.0) for c in cases if c in found), default=0.0)
        for name in allowed
    }
    return Statement(
        claim=f"{what}: {', '.join(f'{name} ≤ {plain(most)}' for name, most in allowed.items())}",
        outcome=_judged(all(worst[name] <= allowed[name] for name in allowed), found, cases),
        measured=", ".join(f"{name} {plain(error, 2)}" for name, error in worst.items()),
        because="asked of the finite elements with a penalty",
    )


def _augmented(level: Level, found: Found) -> Statement:
    def of(value: Value) -> str:
        cases = [c for c in of_springs(level) if c.factor == DEFAULT and c in found]
        return _texts(value(found[case]) for case in cases)

    return Statement(
        claim="one augmentation is enough",
        outcome=None,
        measured=f"with 0, 1, 2, 3 of them at c = {DEFAULT:g}: error of the approach "
        f"{of(lambda r: r.approach)}; of the peak {of(lambda r: r.peak)}; of the pressure in the "
        f"L2 norm {of(lambda r: r.ripple)}",
        because="more of them shift no number that matters, and ripple at the edge",
    )  # fmt: skip


def _by_newton(level: Level, found: Found) -> Statement:
    parts = []
    for factor in (10.0, 100.0, 1000.0):
        records = [
            found[case]
            for contact in FRICTIONAL
            for case in of_friction(level, contact, 1)
            if case.factor == factor and case in found
        ]
        increments = sum(r.increments for r in records)
        if increments:
            newton = increments - sum(r.by_springs for r in records)
            parts.append(f"c = {factor:g}: {newton} of {increments}")
    return Statement(
        claim="Newton's method solves most increments with friction",
        outcome=None,
        measured="; ".join(parts) or "–",
        because="the others, the first of every history among them, take springs in series",
    )


def _of_increments(level: Level, found: Found) -> Statement:
    cases = [case for case in of_increments(level) if case in found]
    return Statement(
        claim="the shear is what increments decide",
        outcome=None,
        measured="; ".join(
            f"{c.increments}: q {plain(found[c].shear, 2)}, approach {plain(found[c].approach, 2)}"
            for c in cases
        ) or "–",
        because="errors by the number of increments, µ = 0.3",
    )  # fmt: skip


def _springs(level: Level, found: Found) -> list[PenaltyCase]:
    """Runs without augmentation whose error is far above the mesh's, and of first order."""
    mesh = abs(found[best].approach) if (best := _best(level)) in found else 0.0
    return [
        case
        for case in of_springs(level)
        if case.augmentations == 0
        and case in found
        and case.factor > 1
        and abs(found[case].approach) > ABOVE_MESH * mesh
    ]


def _best(level: Level) -> PenaltyCase:
    """Nothing but the error of the mesh."""
    return next(c for c in of_springs(level) if c.factor == 100 and c.augmentations == 1)


def _times_k(case: PenaltyCase, error: float | None) -> float:
    return case.springs_per_radius * (error or 0.0)


def _texts(values: Iterable[float | None]) -> str:
    return ", ".join(plain(value, 2) for value in values)


def _judged(good: bool, found: Found, cases: Sequence[PenaltyCase]) -> Status:
    if any(case not in found for case in cases):
        return Status.INCONCLUSIVE
    return Status.PASS if good else Status.FAIL
