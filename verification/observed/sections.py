"""Laws of contact and friction for the results of finite elements.

The stated gap contains no overlap. Gap and relative motion are therefore computed again from the
tractions. The springs of a penalty add their deformation.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_reference import Increment, Path, Result
from verification.observed.prescribed import largest_of, missed
from verification.observed.rings import Rings
from verification.observed.springs import (
    EnergeticState,
    energy_missing,
    energy_won,
    least_slip,
    observed_springs,
    other_than_motion,
    spring_stiffness,
)

Field = NDArray[np.float64]


def section_laws(result: Result) -> tuple[float, float]:
    """Return the largest violation of a law and the largest energy imbalance of any increment.

    Both are infinite if a number is not finite.

    Raises ValueError for augmented springs on harmonics, whose deformation the result does not
    contain.
    """
    penalty = result.increments[-1].overlap is not None
    if penalty and result.plan.path is not Path.HARMONICS:
        violations, states = observed_springs(result)
    else:
        violations, states = _on_rings(result, penalty)
    violations += missed(result.scene, result.steps)
    return largest_of(violations), largest_of(energy_missing(states))


def _on_rings(result: Result, penalty: bool) -> tuple[list[float], list[EnergeticState]]:
    if any(increment.augmentations for increment in result.increments):
        raise ValueError("springs on harmonics were augmented: take augmentations = 0")
    rings = Rings.of(result)
    radii = result.increments[-1].radii
    spring = 1 / spring_stiffness(result, radii[1] - radii[0]) if penalty else 0.0
    surfaces = [_Surface.of(i, rings, result.plan.direction, spring) for i in result.increments]
    violations: list[float] = []
    befores: list[_Surface | None] = [None, *surfaces]
    for before, now in zip(befores, surfaces, strict=False):
        violations += _of_pressure(now)
        if now.sheared:
            violations += _of_shear(before, now)
    return violations, [surface.energetic for surface in surfaces]


@dataclass(frozen=True)
class _Surface:
    """Increment at points on rings.

    gap      including the deformation of springs [length]
    slip     as stated [length]
    passed   motion of the particles of the body relative to the indenter since the start [length];
             None if the motion of the indenter is undefined
    force    along the load [force], or the torque [force length]
    stored   energy in bodies and springs [force length]
    """

    increment: Increment
    rings: Rings
    pressure: Field
    shear: Field
    gap: Field
    slip: Field
    passed: Field | None
    force: float
    stored: float

    @classmethod
    def of(
        cls, increment: Increment, rings: Rings, direction: tuple[float, float], spring: float
    ) -> _Surface:
        p, q = rings.on_grid(increment.pressure), rings.shear(increment)
        along, u_z = rings.displacement(p, q)
        along, u_z = along + spring * q, u_z + spring * p
        if rings.path is Path.TWISTING:
            force, motion = increment.torque or 0.0, increment.twist
        else:
            force = float(np.dot(increment.tangential_force or (0.0, 0.0), direction))
            shift = increment.tangential_shift
            motion = None if shift is None else float(np.dot(shift, direction))
        if motion is None and force == 0.0:
            motion = 0.0
        return cls(
            increment=increment,
            rings=rings,
            pressure=p,
            shear=q,
            gap=rings.undeformed + u_z - increment.approach,
            slip=rings.slip(increment),
            passed=None
            if motion is None
            else along + rings.stretched(increment) - motion * rings.driven,
            force=force,
            stored=0.5 * float(np.sum(rings.weights * (p * u_z + np.sum(q * along, axis=0)))),
        )

    @property
    def sheared(self) -> bool:
        """True if the increment can have shear."""
        return self.increment.dissipated_energy is not None or bool(np.any(self.shear))

    @property
    def energetic(self) -> EnergeticState:
        """State for the energy balance."""
        return EnergeticState(
            self.increment, self.rings.weights, self.stored, self.rings.undeformed, self.pressure,
            self.gap, self.shear, self.rings.model.friction.limit(self.pressure), self.passed,
            self.slip,
        )  # fmt: skip


def _of_pressure(now: _Surface) -> Iterator[float]:
    p, gap, increment, weights = now.pressure, now.gap, now.increment, now.rings.weights
    depth = abs(increment.approach)  # bodies left sheared can lift the indenter above first touch
    yield float(np.max(-p) / np.max(p))
    yield float(np.max(-gap) / depth)
    yield float(np.sum(weights * p * np.abs(gap)) / (np.sum(weights * p) * depth))
    yield abs(now.rings.integral(p) / increment.normal_force - 1)
    apart = np.where(p > 0, 0.0, gap)
    yield float(np.max(np.abs(apart - now.rings.on_grid(increment.gap))) / depth)


def _of_shear(before: _Surface | None, now: _Surface) -> Iterator[float]:
    friction = now.rings.model.friction
    limit = friction.limit(now.pressure)
    if not np.any(limit):
        yield float(np.max(np.hypot(*now.shear)) / np.max(now.pressure))
        return
    yield float(np.max(np.hypot(*now.shear) - limit) / np.max(limit))
    weights, driven = now.rings.weights.copy(), now.rings.driven
    carried = float(np.sum(weights * driven * now.shear))
    most = float(np.sum(weights * limit * np.hypot(*driven)))
    yield abs(carried - now.force) / (most or float(np.sum(weights * limit)))
    # In an increment that was halved slip may have turned on the way.
    if now.increment.halvings > 0 or now.passed is None:
        return
    passed, slip, touched = now.passed, now.slip, np.zeros_like(limit, dtype=bool)
    if before is not None and before.passed is not None:
        passed, slip, touched = passed - before.passed, slip - before.slip, before.pressure > 0
    if now.increment.angles is None and now.rings.path is not Path.SHEARING:
        weights[0] = 0.0  # on the axis there is neither shear nor slip
    other = np.where(weights * limit > 0, other_than_motion(slip, passed, touched), 0.0)
    yield float(np.max(other) / abs(now.increment.approach))
    work = weights * limit * np.hypot(*passed)
    least = least_slip(friction.largest, now.increment.approach) * float(np.sum(weights * limit))
    against = weights * np.sum(now.shear * passed, axis=0)
    scale = max(float(np.sum(work)), least)
    if scale > 0:  # not so where the axis alone touches
        yield float(np.sum(work + against)) / scale
    yield from energy_won(None if before is None else before.increment, now.increment)
