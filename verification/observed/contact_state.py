"""Laws of contact and friction and the energy balance, for increments of any solver.

An increment is described by the state at points of the contact surface, with the area of each point
as weight. One function per solver creates the states from a result. The laws are the same for all
solvers. `missed` compares computed loads and motions with the prescribed ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_scene import ControlKind, Scene
from contact_scene.array_types import Field, Mask
from contact_scene.rig import prescribed_motions
from verification.norms import max_norm

if TYPE_CHECKING:
    from contact_scene.stepping.load_path import ScalarControl, VectorControl


def missed(scene: Scene, steps: Sequence[Any]) -> Iterator[float]:
    """Yield the relative deviations from the prescribed loads and displacements at the ends of load
    steps.

    Forces are relative to the normal force, and displacements to the approach. Moments and
    rotations use these scales with the contact radius as arm. Without friction, tangential loads
    and torques are skipped, because no solver computes them.

    scene  scene with the prescribed loads
    steps  last increment of every load step, of any solver
    """
    for ramp, end in zip(scene.load_path(), steps, strict=True):
        force, motion, arm = end.normal_force, abs(end.approach), end.contact_radius
        approach, shift = (getattr(end, name) for name in prescribed_motions(scene.rig))
        yield _control_deviation(ramp.normal, end.normal_force, approach, force, motion)
        if ramp.stretch is not None:
            strain = np.subtract((*end.bulk_strain, end.bulk_shear), ramp.stretch[1])
            yield max_norm(strain) * arm / motion
        moment, tilt = getattr(end, "moment", None), getattr(end, "tilt", None)
        yield _control_deviation(ramp.tilting, moment, tilt, force * arm, motion / arm)
        if scene.friction is None:
            continue
        yield _control_deviation(ramp.tangential, end.tangential_force, shift, force, motion)
        yield _control_deviation(ramp.twisting, end.torque, end.twist, force * arm, motion / arm)


def _control_deviation(
    control: ScalarControl | VectorControl, force: Any, motion: Any, *scales: float
) -> float:
    """Compute the deviation of a computed load or displacement from its prescribed end value [1].

    A value that a solver omits counts as zero.

    control  prescribed force or displacement of the load step
    force    computed force or moment
    motion   computed displacement or rotation
    scales   scale of the force, and scale of the displacement
    """
    by_force = control.kind is ControlKind.FORCE
    found_end, scale = (force, scales[0]) if by_force else (motion, scales[1])
    return max_norm(np.subtract(0.0 if found_end is None else found_end, control.end)) / scale


class Imbalance(float):
    """Difference of energies that should balance in an increment, over the largest energy so far
    [1].

    terms  text with the number of the increment, from 1, and the compared energies
    """

    terms: str

    def __new__(cls, number: int, largest: float, difference: float, **terms: float) -> Imbalance:
        """Create the imbalance of one increment from a difference of energies [force*length].

        number      number of the increment, from 1
        largest     largest energy so far, the scale of the imbalance
        difference  energy difference that should vanish
        terms       compared energies, by name; none for a stated imbalance, a ratio
        """
        found = super().__new__(cls, abs(difference) / largest)
        texts = (f"{name.replace('_', ' ')} {energy:.6g} J" for name, energy in terms.items())
        found.terms = f"increment {number}: {', '.join(texts)}; difference {difference:.3g} J"
        if not terms:
            found.terms = f"increment {number}: stated imbalance {difference:.3g}"
        return found


def largest_of(found: Iterable[float]) -> float:
    """Return the largest of dimensionless violations of laws.

    The result is infinite if a number is not finite, and 0 for no numbers.
    """
    numbers = list(found)
    return max(numbers, default=0.0) if np.all(np.isfinite(numbers)) else float("inf")


LEAST_SLIP = 1e-3  # smallest scale of slip over the sliding distance µδ
# Rounding error of slip over the approach. Slip is the small difference of two motions of the size
# of the approach.
SLIP_ROUNDING = 1e-8
TINY = float(np.finfo(float).tiny)

# Reasons for which a law is not evaluated.
BISECTED = "the increment was bisected"
UNDEFINED = "the motion of the indenter is undefined"
CORRECTED = "slip and energies are those before the edge correction"
GROWN = "the contact with friction has grown: stored energy and unresolved work are as stated"
FEW_RINGS = "the contact has too few rings for integrals"


@dataclass(frozen=True)
class Balance:
    """Compare a force or moment that the computed tractions carry with its expected value.

    carried  force or moment of the tractions
    due      expected value
    most     largest possible value, the scale of the difference
    eased    tolerance of the solver over the tolerance of this balance; below 1 with edge
             correction
    """

    carried: Any
    due: Any
    most: float
    eased: float = 1.0

    @property
    def missing(self) -> float:
        """Difference between carried and expected force over the largest possible force [1].

        The difference is multiplied by `eased`, so that it can be compared with the tolerance of
        the solver.
        """
        off = np.linalg.norm(np.subtract(self.carried, self.due))
        return float(off / self.most) * self.eased


@dataclass(frozen=True)
class ContactState:
    """Hold the state of the contact surface at the end of an increment, in one form for all
    solvers.

    Scalar fields have one value for each point of the surface, vector fields the shape (2, ...).
    The laws of contact and friction are evaluated from these fields.

    increment   increment with the numbers that the solver states
    weights     area of the points [length^2]
    undeformed  gap before any load [length]
    pressure    contact pressure [force/length^2]
    gap         gap of the deformed surfaces, negative where contact springs are compressed [length]
    shear       shear traction [force/length^2]
    limit       friction limit µp [force/length^2]
    slip        slip as stated by the solver [length]
    passed      motion of the lower surface relative to the indenter since the start [length]; None
                if it is undefined
    forces      forces and moments; `motions` are conjugate to them
    motions     displacements and rotations of the indenter, and strains of the lower body
    depth       scale of gaps [length]
    balances    balances of forces and moments
    stated      relative differences between stated numbers and those of the fields
    give        compliance of contact springs of a penalty [length^3/force]
    loose       largest slip of contact springs without motion of the points, or 0 [length]
    eased       tolerance of the solver over the tolerance of p g = 0
    coarse      factor on the scale of energies, for the edge correction
    least_work  smallest scale of the dissipated energy [force*length]
    unseen      reason for which slip is not compared with the shear; empty if it is compared
    open        reason for which energies are not compared with those of the preceding state
    told        True if stored energy and unresolved work cannot be computed from the fields
    between     True if the fields are interpolated between the points of the solver; slip and
                motion of the surfaces are then compared in the mean, weighted with the limit
    """

    increment: Any
    weights: Field
    undeformed: Field
    pressure: Field
    gap: Field
    shear: Field
    limit: Field
    slip: Field
    passed: Field | None
    forces: Field
    motions: Field
    depth: float
    balances: tuple[Balance, ...]
    stated: tuple[float, ...] = ()
    give: float = 0.0
    loose: Field | float = 0.0
    eased: float = 1.0
    coarse: float = 1.0
    least_work: float = 0.0
    unseen: str = ""
    open: str = ""
    told: bool = False
    between: bool = False

    @property
    def not_compared(self) -> str:
        """Reason for which some energies of the increment are not compared; empty if all are
        compared.
        """
        return self.open or (GROWN if self.told else CORRECTED if self.coarse > 1 else "")

    def over(self, field: Field) -> float:
        """Integrate a scalar field over the contact surface, with the areas of the points as
        weights.
        """
        return float(np.sum(self.weights * field))

    @property
    def stored(self) -> float:
        """Elastic energy ½ ∫ (p u_z + q·u) dA of bodies and contact springs, from the fields
        [force*length].
        """
        assert self.passed is not None
        closed = np.zeros_like(self.pressure)
        np.subtract(self.gap, self.undeformed, out=closed, where=self.pressure > 0)
        along = np.sum(self.shear * self.passed, axis=0)
        by_motion = float(np.sum(self.forces * self.motions))
        return 0.5 * (self.over(self.pressure * closed + along) + by_motion)

    @property
    def springs(self) -> bool:
        """True for a penalty method; its stated elastic energy does not contain the contact
        springs.
        """
        return self.increment.overlap is not None

    @property
    def energy(self) -> float:
        """Elastic energy of the state as stated by the solver, else computed from the fields
        [force*length].
        """
        alone = self.increment.elastic_energy
        return self.stored if alone is None or self.springs else float(alone)

    def at_rest(self) -> ContactState:
        """Return the state of the same points before first contact: no tractions, no motions."""
        nothing, still = np.zeros_like(self.pressure), np.zeros_like(self.shear)
        return ContactState(
            None,
            self.weights,
            self.undeformed,
            nothing,
            self.undeformed,
            still,
            nothing,
            still,
            still,
            0 * self.forces,
            0 * self.motions,
            self.depth,
            (),
        )


def violations(states: Sequence[ContactState]) -> Iterator[float]:
    """Yield the relative violations of the laws of contact and friction in all increments [1].

    The laws are: no tension, no penetration, complementarity of pressure and gap, balance of
    forces, the friction limit, stick inside the contact, and slip opposite to the shear.

    states  states of the contact surface, one for each increment
    """
    for before, now in pairwise([None, *states]):
        assert now is not None
        yield from _pressure_violations(now)
        yield from (balance.missing for balance in now.balances)
        yield from now.stated
        size = np.hypot(*now.shear)
        if not np.any(now.limit):
            yield float(np.max(size) / np.max(now.pressure))
        else:
            yield float(np.max(size - now.limit) / np.max(now.limit))
            if not now.unseen and now.passed is not None:
                yield from _slip_violations(before, now)
            if now.increment.in_stick is not None:
                yield float(np.any(now.increment.in_stick & ~now.increment.in_contact))


def _pressure_violations(now: ContactState) -> Iterator[float]:
    p, gap = now.pressure, np.where(np.isposinf(now.gap), 0.0, now.gap) + now.give * now.pressure
    yield float(np.max(-p) / np.max(p))
    yield float(np.max(-gap) / now.depth)
    if not now.give:
        yield now.eased * now.over(p * np.abs(gap)) / (now.over(p) * now.depth)


def _slip_violations(before: ContactState | None, now: ContactState) -> Iterator[float]:
    """Yield the relative violations of the friction law in one increment [1].

    Slip must be the relative motion of the surfaces, must oppose the shear at the friction limit,
    and must dissipate the stated energy.

    before  state of the preceding increment; None for the first
    now     state of the increment
    """
    start = now.at_rest() if before is None or before.passed is None else before
    assert start.passed is not None
    assert now.passed is not None
    slip, passed = now.slip - start.slip, now.passed - start.passed
    approach = abs(now.increment.approach)
    other = _other_than_motion(slip, passed, start.pressure > 0) - now.loose
    other = np.where(now.weights * now.limit > 0, other, 0.0)
    mean = now.over(now.limit * other) / now.over(now.limit) if now.between else np.max(other)
    yield float(mean / approach)
    work, friction = now.limit * np.hypot(*slip), np.max(now.limit) / np.max(now.pressure)
    least = max(LEAST_SLIP * friction, SLIP_ROUNDING) * approach * now.over(now.limit)
    scale = max(now.over(work), now.least_work, least)
    if scale > 0:  # zero if only the axis is in contact
        yield now.over(work + np.sum(now.shear * slip, axis=0)) / scale
    most, last = now.increment.dissipated_energy, getattr(start.increment, "dissipated_energy", 0.0)
    if most is not None and last is not None:
        yield (last - most) / max(most, TINY)
        if scale > 0 and not now.open and now.coarse == 1:
            yield abs(_dissipated_energy_of(start, now) - (most - last)) / scale


def _other_than_motion(slip: Field, passed: Field, touched: Mask) -> Field:
    """Compute the difference between slip and relative motion of the surfaces in an increment
    [length].

    The difference should vanish. For points that came into contact in the increment, slip may be a
    fraction of the motion.

    slip     change of the slip (2, ...) [length]
    passed   relative motion of the surfaces (2, ...) [length]
    touched  mask of the points that were in contact before the increment
    """
    squared, along = np.sum(passed**2, axis=0), np.sum(slip * passed, axis=0)
    part = np.clip(np.divide(along, squared, out=np.ones_like(squared), where=squared > 0), 0, 1)
    return np.asarray(np.hypot(*(slip - np.where(touched, 1.0, part) * passed)))


def imbalances(states: Sequence[ContactState]) -> Iterator[Imbalance]:
    """Yield the energy imbalances of all increments, relative to the largest energy so far [1].

    Two kinds of differences are included: those of the energy balance, and those of energies
    computed from the fields against stated energies.

    states  states of the contact surface, one for each increment
    """
    largest = 0.0
    for number, (before, now) in enumerate(pairwise([None, *states]), start=1):
        assert now is not None
        end = now.increment
        if now.passed is None:
            return  # the motion is undefined from here on
        lost, work = end.dissipated_energy or 0.0, end.trapezoidal_work or 0.0
        largest = max(largest, abs(now.energy), abs(work), abs(lost))
        scale = largest * now.coarse
        if end.elastic_energy is not None and not now.springs:
            terms = {"stored": now.energy if now.told else now.stored, "stated": now.energy}
            yield Imbalance(number, scale, terms["stored"] - terms["stated"], **terms)
            if end.input_work is not None:
                terms = {"work": end.input_work, "stored": now.energy, "dissipated": lost}
                yield Imbalance(number, largest, end.input_work - now.energy - lost, **terms)
        if end.energy_imbalance is not None:
            yield Imbalance(number, 1.0, end.energy_imbalance)
        if not now.open:  # otherwise the result lacks intermediate states
            for difference, terms in _energy_differences(before or now.at_rest(), now):
                yield Imbalance(number, scale, difference, **terms)


def _energy_differences(
    start: ContactState, now: ContactState
) -> Iterator[tuple[float, dict[str, float]]]:
    """Yield the energy differences of one increment that should vanish, with the compared energies
    by name.

    The first difference is work minus stored, dissipated and unresolved energy. The others compare
    energies from the fields with stated energies. The unit is [force*length].

    start  state at the beginning of the increment
    now    state at the end of the increment
    """
    last, end = start.increment, now.increment
    work = 0.5 * float(np.sum((start.forces + now.forces) * (now.motions - start.motions)))
    stored = now.energy - (0.0 if last is None else start.energy)
    own = _dissipated_energy_of(start, now)
    told = {
        name: (getattr(end, name) or 0.0) - (getattr(last, name, None) or 0.0)
        for name in ("trapezoidal_work", "dissipated_energy", "unresolved_work")
    }
    shrunk = np.any(start.shear * (now.pressure == 0))
    told_alone = now.told or (shrunk and not now.give and end.unresolved_work is not None)
    unresolved = told["unresolved_work"] if told_alone else _unresolved_work_of(start, now) - own
    terms = {"work": work, "stored": stored, "dissipated": own, "unresolved": unresolved}
    yield work - stored - own - unresolved, terms
    found = {"trapezoidal_work": work, "dissipated_energy": own, "unresolved_work": unresolved}
    for name, energy in found.items():
        if getattr(end, name) is not None and not (name == "unresolved_work" and now.springs):
            yield energy - told[name], {name: energy, "stated": told[name]}


def _dissipated_energy_of(start: ContactState, now: ContactState) -> float:
    """Compute the energy that friction dissipates in an increment, ∫ friction · |slip| dA
    [force*length].

    The friction is the mean of the friction limits before and after the increment. Points that lose
    contact may have stuck until then. For these the friction is half their shear at the start of
    the increment.

    start  state at the beginning of the increment
    now    state at the end of the increment
    """
    limit = 0.5 * (start.limit + now.limit)
    parted = (start.pressure > 0) & (now.pressure == 0)
    friction = np.where(parted, 0.5 * np.hypot(*start.shear), limit)
    return now.over(friction * np.hypot(*(now.slip - start.slip)))


def _unresolved_work_of(start: ContactState, now: ContactState) -> float:
    """Compute the work that a finite increment leaves unresolved, plus its dissipation
    [force*length].

    Within an increment the contact area changes, which the tractions at both ends do not show. The
    loads are taken as linear in time where gaps close or open, and the shear as well (see
    `semi_analytical.increments.energy`).

    start  state at the beginning of the increment
    now    state at the end of the increment
    """
    assert start.passed is not None
    assert now.passed is not None
    p, other = start.pressure, now.pressure
    ends = other * _finite_gap(start.gap), p * _finite_gap(now.gap)
    if now.give:  # springs: the gap of a lasting contact changes
        ends = ends[0] + p * _finite_gap(start.gap), ends[1] + other * _finite_gap(now.gap)
        changed = np.ones_like(p, dtype=bool)
    else:
        changed = (p > 0) != (other > 0)
    closing = np.where(changed, ends[0] - ends[1], 0.0)
    sheared = np.sum((start.shear + now.shear) * (now.passed - start.passed), axis=0)
    return 0.5 * now.over(closing - sheared)


def _finite_gap(gap: Field) -> Field:
    return np.where(np.isposinf(gap), 0.0, gap)
