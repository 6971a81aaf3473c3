"""The laws of springs of a penalty at Gauss points, looked for in what comes back.

After an augmentation the pressure is p = ⟨λ + εv⟩, with v the overlap and λ the pressure of the
pass before, which is not told. What must hold whatever λ ≥ 0 has been: nothing overlaps by more
than p/ε, and with λ = p − εv no shear has changed between the passes by more than the friction
limits of p and λ together.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from fem_reference import Increment, Result
from verification.observed.section_energy import EnergeticState
from verification.observed.spring_states import SpringState, SpringSurface
from verification.observed.surfaces import LEAST_SLIP

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Of the approach: slip is the small difference of motions that pressing makes as large as that, so
# that rounding leaves it a hundred-millionth of this.
SLIP_ROUNDING = 1e-8


def least_slip(friction: float, approach: float) -> float:
    """What slip is judged relative to where there is less of it [length]."""
    return max(LEAST_SLIP * friction, SLIP_ROUNDING) * abs(approach)


def observed_springs(result: Result) -> tuple[list[float], list[EnergeticState]]:
    """Violations in all increments of a result at Gauss points, and what its energy is about."""
    surface = SpringSurface.of(result)
    states = [SpringState.of(told, surface) for told in result.increments]
    violations: list[float] = []
    befores: list[SpringState | None] = [None, *states]
    for before, now in zip(befores, states, strict=False):
        violations += _of_pressure(now, surface)
        if now.q is not None:
            violations += _of_shear(before, now, surface)
    return violations, [state.energetic(surface) for state in states]


def energy_won(before: Increment | None, now: Increment) -> Iterator[float]:
    """What friction gives back in an increment, as a part of all it took."""
    most = now.dissipated_energy
    last = 0.0 if before is None else before.dissipated_energy
    if most is not None and last is not None:
        yield (last - most) / max(most, float(np.finfo(float).tiny))


def other_than_motion(slip: Field, passed: Field, touched: Mask) -> Field:
    """By how much slip is not the motion past each other in an increment, nor a part of it where
    surfaces have met on the way [length].

    slip, passed  (components, points)
    touched       before the increment
    """
    squared = np.sum(passed**2, axis=0)
    along = np.sum(slip * passed, axis=0)
    part = np.clip(np.divide(along, squared, out=np.ones_like(squared), where=squared > 0), 0, 1)
    return np.asarray(np.hypot.reduce(np.abs(slip - np.where(touched, 1.0, part) * passed), axis=0))


def _of_pressure(now: SpringState, surface: SpringSurface) -> Iterator[float]:
    told, p, v = now.told, now.p, now.overlap
    carried = float(np.sum(surface.weights * p))
    yield float(np.max(-p) / np.max(p))
    yield abs(carried / told.normal_force - 1)
    yield float(np.max(v - p / surface.stiffness) / abs(told.approach))
    apart = np.where(p > 0, 0.0, -v)
    yield float(np.max(np.abs(apart - told.gap)) / abs(told.approach))
    largest = float(np.max(np.abs(v), where=p > 0, initial=0.0))
    assert told.overlap is not None
    yield abs(largest - told.overlap) / abs(told.approach)


def _of_shear(
    before: SpringState | None, now: SpringState, surface: SpringSurface
) -> Iterator[float]:
    told, p, q = now.told, now.p, now.q
    assert q is not None
    limit = surface.friction.limit(p)
    if not np.any(limit):
        yield float(np.max(np.abs(q)) / np.max(p))
        return
    yield float(np.max(np.abs(q) - limit) / np.max(limit))
    carried = float(np.sum(surface.weights * surface.moves * q))
    most = float(np.sum(surface.weights * surface.moves * limit))
    least = float(np.sum(surface.weights * limit))
    yield abs(carried - surface.force(told)) / (most or least)
    if told.halvings == 0 and now.passed is not None:
        yield from _of_slip(before, now, surface)
        yield from energy_won(None if before is None else before.told, told)


def _of_slip(
    before: SpringState | None, now: SpringState, surface: SpringSurface
) -> Iterator[float]:
    """Slip opposes shear at its limit, and is the motion but for what the springs yield."""
    assert now.q is not None
    assert now.slip is not None
    assert now.passed is not None
    slip, passed, p = now.slip, now.passed, now.p
    touched = np.zeros_like(p, dtype=bool)
    if before is not None and before.passed is not None:
        assert before.slip is not None
        slip, passed, touched = slip - before.slip, passed - before.passed, before.p > 0
    limit, approach = surface.friction.limit(p), abs(now.told.approach)
    work = surface.weights * limit * np.abs(slip)
    least = least_slip(surface.friction.largest, approach) * float(np.sum(surface.weights * limit))
    against = surface.weights * now.q * slip
    yield float(np.sum(work + against) / max(float(np.sum(work)), least))
    of_pass_before = np.maximum(p - surface.stiffness * now.overlap, 0.0)
    most = (limit + surface.friction.limit(of_pass_before)) / surface.stiffness
    yielded = other_than_motion(-slip[None], passed[None], touched) - most
    yield float(np.max(np.where(p > 0, yielded, 0.0)) / approach)
