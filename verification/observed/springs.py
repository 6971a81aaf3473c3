"""Laws of contact and friction for the springs of a penalty at Gauss points.

After an augmentation the pressure is p = ⟨λ + εv⟩, with v the overlap and λ the pressure of the
preceding pass, which the result does not contain. For every λ ≥ 0 the overlap is at most p/ε. With
λ = p − εv the change of the shear between the passes is at most the sum of the friction limits of p
and λ.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from contact_scene import CoulombFriction, IsotropicMaterial
from fem_reference import Increment, Path, Result
from fem_reference.compliance.gauss_points import gauss_points
from verification.observed.prescribed import Imbalance
from verification.observed.rings import along_load, model_of, section_radii
from verification.observed.surfaces import LEAST_SLIP

Field = NDArray[np.float64]


@dataclass(frozen=True)
class EnergeticState:
    """Increment for the energy balance; q, passed and slip are (components, points).

    weights     area of the points [length^2]
    stored      in the bodies, and in springs that obey no other law [force length]
    undeformed  gap before any load [length]
    limit       of friction [force/length^2]
    gap         between the surfaces by the motion of the indenter [length]
    passed      motion of the particles of the body relative to the indenter since the start
                [length]; None if undefined
    slip        as stated [length]; less than the motion where particles first met in an increment
    yields      true if springs carry the remaining overlap and motion
    """

    increment: Increment
    weights: Field
    stored: float
    undeformed: Field
    pressure: Field
    gap: Field
    shear: Field
    limit: Field
    passed: Field | None
    slip: Field
    yields: bool = False


def energy_missing(states: Sequence[EnergeticState]) -> Iterator[Imbalance]:
    """Yield the energy differences of all increments, over the largest energy so far.

    The differences are those of the energy balance and of the fields from the stated energies.
    """
    before, worked, lost = None, 0.0, 0.0
    largest = 0.0
    for number, state in enumerate(states, start=1):
        work, stated = state.increment.trapezoidal_work, state.increment.dissipated_energy
        dissipated = stated or 0.0
        if work is None or state.passed is None or (np.any(state.shear) and stated is None):
            return  # the motion is undefined, and with it all that follows
        largest = max(largest, *(abs(e) for e in (state.stored, work, dissipated)))
        alone = state.increment.elastic_energy
        if alone is not None and state.increment.overlap is None:
            difference = alone - state.stored
            yield Imbalance(number, largest, difference, stored=state.stored, stated=alone)
        if state.increment.halvings == 0:  # else there are states in between
            spent = work - worked, dissipated - lost
            for difference, terms in _missing(before, state, *spent):
                yield Imbalance(number, largest, difference, **terms)
        before, worked, lost = state, work, dissipated


def _missing(
    before: EnergeticState | None, after: EnergeticState, work: float, dissipated: float
) -> Iterator[tuple[float, dict[str, float]]]:
    start = before or _at_rest(after)
    assert start.passed is not None
    assert after.passed is not None
    w, p, q = after.weights, (start.pressure, after.pressure), (start.shear, after.shear)
    passed = after.passed - start.passed
    slipped, limits = after.slip - start.slip, start.limit + after.limit
    # Along the shear, which slip opposes, and as large as the mean of the limits; what parts may
    # have stuck until then, and loses half its shear at the start along its way.
    size = np.abs(np.hypot.reduce(q[1], axis=0))
    along = np.divide(q[1], size, out=np.zeros_like(q[1]), where=size > 0)
    lost = -0.5 * limits * np.sum(along * slipped, axis=0)
    parts = (p[0] > 0) & (p[1] == 0)
    lost[parts] = 0.5 * (np.hypot.reduce(q[0], axis=0) * np.hypot.reduce(slipped, axis=0))[parts]
    own = float(np.sum(w * lost))
    closing = 0.5 * w * (p[1] * start.gap - p[0] * after.gap)
    if after.yields:
        closing = closing + 0.5 * w * (p[0] * start.gap - p[1] * after.gap)
    else:
        # What gap is left in a lasting contact is missing.
        closing = closing[(p[0] > 0) != (p[1] > 0)]
    turning = -own - 0.5 * float(np.sum(w * (q[0] + q[1]) * passed))
    stored, unresolved = after.stored - start.stored, float(np.sum(closing)) + turning
    terms = {"work": work, "stored": stored, "dissipated": own, "unresolved": unresolved}
    yield work - stored - own - unresolved, terms
    yield dissipated - own, {"dissipated": own, "stated": dissipated}


def _at_rest(state: EnergeticState) -> EnergeticState:
    """Return the state before first touch, at the points of a state."""
    nothing, still = np.zeros_like(state.pressure), np.zeros_like(state.shear)
    return EnergeticState(
        state.increment, state.weights, 0.0, state.undeformed, nothing, state.undeformed, still,
        nothing, still, still,
    )  # fmt: skip


def spring_stiffness(result: Result, element: float) -> float:
    """Compute ε = c E*/h with E* of the outermost materials [force/length^3].

    element  length of a contact edge [length]
    """
    softness = 0.0
    for body in (result.scene.body, result.scene.indenter):
        outermost = body.layers[0].material if body.layers else body.material
        if isinstance(outermost, IsotropicMaterial):
            softness += (1 - outermost.poisson_ratio**2) / outermost.young_modulus
    return result.discretisation.penalty / (softness * element)


@dataclass(frozen=True)
class SpringSurface:
    """Gauss points, displacements by the forces at these points, and springs.

    by_force  (n, n) per component of displacement and force, "z", "t": normal, tangential
    moves     motion of the points along the shear per unit shift or twist of the indenter: 1, r
              [length], or 0
    twists    true for a twist
    along     unit vector of the load
    """

    weights: Field
    gap: Field
    by_force: dict[str, Field]
    moves: Field
    twists: bool
    along: tuple[float, float]
    stiffness: float
    friction: CoulombFriction

    @classmethod
    def of(cls, result: Result) -> SpringSurface:
        """Create the surface for the increments of a result."""
        radii, nodes = result.increments[-1].radii, section_radii(result)
        middle = float(radii[0] + radii[2]) / 2  # of the first element
        model = model_of(result, middle / float(nodes[1]))
        points = gauss_points(model.radii, model.rim)
        path = result.plan.path
        pressing = model.compliance(0).matrix
        blocks = {"zz": pressing[1, :, 1]}
        if path is Path.PRESSING_WITH_FRICTION:
            blocks |= {"zt": pressing[1, :, 0], "tz": pressing[0, :, 1], "tt": pressing[0, :, 0]}
        elif path is Path.SHEARING:
            blocks["tt"] = along_load(model)
        elif path is Path.TWISTING:
            blocks["tt"] = model.torsion().matrix[0, :, 0]
        moves = {Path.SHEARING: np.ones_like(points.radii), Path.TWISTING: points.radii}
        by_force = {
            name: points.compliance(block) / points.weights[:, None]
            for name, block in blocks.items()
        }
        return cls(
            weights=2 * np.pi * points.weights,
            gap=model.gap(points.radii),
            by_force=by_force,
            moves=moves.get(path, np.zeros_like(points.radii)),
            twists=path is Path.TWISTING,
            along=result.plan.direction,
            stiffness=spring_stiffness(result, float(model.radii[2])),
            friction=model.friction,
        )

    def displaced(self, component: str, p: Field, q: Field | None) -> Field:
        """Compute the displacement by pressure and shear [length]."""
        nothing = np.zeros((len(p), len(p)))
        by_shear = 0.0 if q is None else self.by_force.get(component + "t", nothing) @ q
        return np.asarray(self.by_force.get(component + "z", nothing) @ p + by_shear)

    def motion(self, increment: Increment) -> float | None:
        """Return the shift of the indenter along the load [length], or its twist; None if
        undefined."""
        if self.twists:
            return increment.twist
        shift = increment.tangential_shift
        return None if shift is None else float(np.dot(shift, self.along))

    def force(self, increment: Increment) -> float:
        """Return the force along the load [force], or the torque [force length]."""
        if self.twists:
            return increment.torque or 0.0
        return float(np.dot(increment.tangential_force or (0.0, 0.0), self.along))


@dataclass(frozen=True)
class SpringState:
    """Increment at the Gauss points.

    overlap  v [length]
    passed   motion of the indenter's points relative to the body along the shear [length]; None
             without shear, or if the motion of the indenter is undefined
    """

    increment: Increment
    p: Field
    q: Field | None
    slip: Field | None
    overlap: Field
    passed: Field | None

    @classmethod
    def of(cls, increment: Increment, surface: SpringSurface) -> SpringState:
        p = increment.pressure
        sheared = (
            (increment.shear_radial, increment.slip_radial),
            (increment.shear_along_load, increment.slip_along_load),
            (increment.shear_circumferential, increment.slip_circumferential),
        )
        q, slip = next((pair for pair in sheared if pair[0] is not None), (None, None))
        overlap = increment.approach - surface.gap - surface.displaced("z", p, q)
        motion = surface.motion(increment)
        passed = None
        if q is not None and motion is not None:
            passed = surface.moves * motion - surface.displaced("t", p, q)
            if increment.bulk_strain is not None:
                passed = passed - increment.bulk_strain[0] * increment.radii
        return cls(increment, p, q, slip, overlap, passed)

    def energetic(self, surface: SpringSurface) -> EnergeticState:
        """Create the state for the energy balance."""
        p, q = self.p, np.zeros_like(self.p) if self.q is None else self.q
        u_z, u_t = (surface.displaced(component, p, self.q) for component in "zt")
        stored = 0.5 * float(np.sum(surface.weights * (p * u_z + q * u_t)))
        passed, slip = self.passed, self.slip
        if self.q is None:
            passed = np.zeros_like(p)
        slip = np.zeros_like(p) if slip is None else slip
        return EnergeticState(
            self.increment, surface.weights, stored, surface.gap, p, -self.overlap, q[None],
            surface.friction.limit(p), None if passed is None else -passed[None],
            slip[None], yields=True,
        )  # fmt: skip


Mask = NDArray[np.bool_]

# Of the approach: slip is the small difference of motions that pressing makes as large as that, so
# that rounding leaves it a hundred-millionth of this.
SLIP_ROUNDING = 1e-8


def least_slip(friction: float, approach: float) -> float:
    """Return the smallest scale for violations of slip [length]."""
    return max(LEAST_SLIP * friction, SLIP_ROUNDING) * abs(approach)


def observed_springs(result: Result) -> tuple[list[float], list[EnergeticState]]:
    """Return the violations in all increments at Gauss points, and the states for the energy
    balance."""
    surface = SpringSurface.of(result)
    states = [SpringState.of(increment, surface) for increment in result.increments]
    violations: list[float] = []
    befores: list[SpringState | None] = [None, *states]
    for before, now in zip(befores, states, strict=False):
        violations += _of_pressure(now, surface)
        if now.q is not None:
            violations += _of_shear(before, now, surface)
    return violations, [state.energetic(surface) for state in states]


def energy_won(before: Increment | None, now: Increment) -> Iterator[float]:
    """Yield the decrease of the dissipated energy in an increment, over the total."""
    most = now.dissipated_energy
    last = 0.0 if before is None else before.dissipated_energy
    if most is not None and last is not None:
        yield (last - most) / max(most, float(np.finfo(float).tiny))


def other_than_motion(slip: Field, passed: Field, touched: Mask) -> Field:
    """Compute the difference of the slip from the relative motion in an increment [length].

    Points that came into contact in the increment may have a fraction of the motion as slip.

    slip, passed  (components, points)
    touched       before the increment
    """
    squared = np.sum(passed**2, axis=0)
    along = np.sum(slip * passed, axis=0)
    part = np.clip(np.divide(along, squared, out=np.ones_like(squared), where=squared > 0), 0, 1)
    return np.asarray(np.hypot.reduce(np.abs(slip - np.where(touched, 1.0, part) * passed), axis=0))


def _of_pressure(now: SpringState, surface: SpringSurface) -> Iterator[float]:
    increment, p, v = now.increment, now.p, now.overlap
    carried = float(np.sum(surface.weights * p))
    yield float(np.max(-p) / np.max(p))
    yield abs(carried / increment.normal_force - 1)
    yield float(np.max(v - p / surface.stiffness) / abs(increment.approach))
    apart = np.where(p > 0, 0.0, -v)
    yield float(np.max(np.abs(apart - increment.gap)) / abs(increment.approach))
    largest = float(np.max(np.abs(v), where=p > 0, initial=0.0))
    assert increment.overlap is not None
    yield abs(largest - increment.overlap) / abs(increment.approach)


def _of_shear(
    before: SpringState | None, now: SpringState, surface: SpringSurface
) -> Iterator[float]:
    increment, p, q = now.increment, now.p, now.q
    assert q is not None
    limit = surface.friction.limit(p)
    if not np.any(limit):
        yield float(np.max(np.abs(q)) / np.max(p))
        return
    yield float(np.max(np.abs(q) - limit) / np.max(limit))
    carried = float(np.sum(surface.weights * surface.moves * q))
    most = float(np.sum(surface.weights * surface.moves * limit))
    least = float(np.sum(surface.weights * limit))
    yield abs(carried - surface.force(increment)) / (most or least)
    if increment.halvings == 0 and now.passed is not None:
        yield from _of_slip(before, now, surface)
        yield from energy_won(None if before is None else before.increment, increment)


def _of_slip(
    before: SpringState | None, now: SpringState, surface: SpringSurface
) -> Iterator[float]:
    """Check that slip opposes the shear at its limit and equals the motion, less the spring
    deformation."""
    assert now.q is not None
    assert now.slip is not None
    assert now.passed is not None
    slip, passed, p = now.slip, now.passed, now.p
    touched = np.zeros_like(p, dtype=bool)
    if before is not None and before.passed is not None:
        assert before.slip is not None
        slip, passed, touched = slip - before.slip, passed - before.passed, before.p > 0
    limit, approach = surface.friction.limit(p), abs(now.increment.approach)
    work = surface.weights * limit * np.abs(slip)
    least = least_slip(surface.friction.largest, approach) * float(np.sum(surface.weights * limit))
    against = surface.weights * now.q * slip
    yield float(np.sum(work + against) / max(float(np.sum(work)), least))
    of_pass_before = np.maximum(p - surface.stiffness * now.overlap, 0.0)
    most = (limit + surface.friction.limit(of_pass_before)) / surface.stiffness
    yielded = other_than_motion(-slip[None], passed[None], touched) - most
    yield float(np.max(np.where(p > 0, yielded, 0.0)) / approach)
