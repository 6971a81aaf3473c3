"""Hertz contact at constant normal load under a tangential force that grows from zero (Cattaneo and
Mindlin), and the corresponding superposition for other shapes.

The pair of bodies must be uncoupled (identical bodies, both incompressible, or Dundurs' second
constant zero).

For any ν the shear gives a constant displacement in the stick zone. In the slip annulus the shear
is parallel to the force, but for ν > 0 the slip is not, so that the direction law of Coulomb holds
only for ν = 0. With the full vector law, identical bodies and ν = 0.3, the transverse shear reaches
4.5 % of the peak µp, the shear of slipping points turns by up to 7.5°, and the last stick vanishes
between 0.987 and 0.9996 µW instead of at µW. Compare with small tolerances for ν = 0, and with 1 to
5 % for ν = 0.3. `slip` is therefore defined for ν = 0 only.

Histories of the tangential force follow Masing's rule with return-point memory. A branch after a
reversal is the curve of the first loading with force and displacement doubled. When the force
returns to an earlier reversal, the loop closes and both reversals are removed. For Hertz point
contact this rule is exact (Mindlin and Deresiewicz 1953; Jäger 1998).

Ruiz's fretting parameters between ±T*, ν = 0, are F1 = τ δ and F2 = σ_T τ δ (Ruiz, Boddington and
Chen 1984, Exp. Mech. 24, 208-217). τ is the largest shear at a position in a cycle, δ half the
range of slip, and σ_T the largest surface stress along the force at the ends of the cycle.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import copysign, expm1, log1p, pi
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from verification.closed_forms.hertz import PointContact, half_chord
from verification.closed_forms.huber_stress import (
    stress_by_hertz_pressure,
    stress_by_partial_slip,
)

Array = NDArray[np.float64]

# Relative excess of T over µW that counts as T = µW, because both contain rounding errors.
ROUNDING = 1e-14


@dataclass(frozen=True)
class PartialSlip:
    """Hold the state of a Hertz contact under a tangential force that has grown monotonically from
    zero.

    A central disc sticks, the annulus around it slips. The formulas are those of Cattaneo (1938)
    and Mindlin (1949).

    load                  normal load W > 0 [force]
    contact_radius        Hertz contact radius a > 0 [length]
    friction_coefficient  coefficient of friction µ > 0
    tangential_modulus    G* with 1/G* = sum of (2-ν)/4G [force/length²]
    tangential_force      T, |T| <= µW [force]; every result is an odd or an even function of T

    Raises ValueError when |T| > µW.
    """

    load: float
    contact_radius: float
    friction_coefficient: float
    tangential_modulus: float
    tangential_force: float

    def __post_init__(self) -> None:
        _refuse_gross_slip(self.tangential_force, self.friction_limit)

    @property
    def friction_limit(self) -> float:
        """Largest tangential force µW that friction can carry (W: normal load) [force]."""
        return self.friction_coefficient * self.load

    @property
    def sliding_shift(self) -> float:
        """Tangential shift 3µW/4aG* of the indenter at the onset of gross slip [length].

        W is the normal load, a the contact radius and G* the tangential modulus.
        """
        return 3 * self.friction_limit / (4 * self.contact_radius * self.tangential_modulus)

    @property
    def stick_radius(self) -> float:
        """Radius c = a (1 - |T|/µW)^(1/3) of the stick zone [length].

        a is the contact radius, T the tangential force and W the normal load.
        """
        return self.contact_radius * float(np.cbrt(1 - self._force_ratio))

    @property
    def shift(self) -> float:
        """Tangential shift of the indenter under the tangential force T, with the sign of T
        [length].

        The shift is sliding_shift [1 - (1-|T|/µW)^(2/3)].
        """
        ratio = self._force_ratio
        fraction = 1.0 if ratio == 1 else -expm1(log1p(-ratio) * 2 / 3)
        return copysign(self.sliding_shift * fraction, self.tangential_force)

    @property
    def tangential_stiffness(self) -> float:
        """Derivative 2G*c of the tangential force by the shift, c the stick radius (Mindlin 1949)
        [force/length].
        """
        return 2 * self.tangential_modulus * self.stick_radius

    @property
    def dissipated_energy(self) -> float:
        """Energy dissipated by friction since the tangential force was zero [force*length].

        A full cycle dissipates four times this energy. The formula is (6/5) sliding_shift µW f with
        f = (1-y)³(1+3y+y²)/6, where y = c/a is the stick radius over the contact radius. f is the
        bracket of Mindlin and Deresiewicz (1953) for the cycle, factored to avoid cancellation for
        small forces.
        """
        ratio = self._force_ratio
        slipped = 1.0 if ratio == 1 else -expm1(log1p(-ratio) / 3)
        y = 1 - slipped
        return self.sliding_shift * self.friction_limit * slipped**3 * (1 + 3 * y + y**2) / 5

    def shear(self, r: ArrayLike) -> Array:
        """Compute the shear on the lower body at distance r from the axis [force/length²].

        The shear is parallel to the tangential force, and zero outside the contact.
        """
        a, c = self.contact_radius, self.stick_radius
        slope = 3 * self.friction_limit / (2 * pi * a**3)
        full, taken_off = half_chord(a, r), half_chord(c, r)
        return np.asarray(copysign(slope, self.tangential_force) * (full - taken_off))

    def slip(self, r: ArrayLike) -> Array:
        """Compute the slip of the lower surface relative to the indenter at distance r from the
        axis [length].

        r must not exceed the contact radius. The formula holds for ν = 0. The slip is the gap of
        the Hertz contact that has the stick zone as contact area, scaled from normal to tangential
        displacement by µE*/G*. The slip opposes the shear (cf. Jäger 1998).
        """
        a, c = self.contact_radius, self.stick_radius
        rho = np.clip(np.abs(np.asarray(r, dtype=float)), c, a)
        root = np.sqrt((rho - c) * (rho + c))
        reduced = (c * root + (rho**2 - 2 * c**2) * np.arctan2(root, c)) / (pi * a**2)
        return np.asarray(-copysign(self.sliding_shift, self.tangential_force) * reduced)

    @property
    def _force_ratio(self) -> float:
        return min(abs(self.tangential_force) / self.friction_limit, 1.0)


@dataclass(frozen=True)
class GrownContact:
    """Hold a contact whose normal and tangential load have grown together without slip.

    The ratio k of their changes is constant in each load step, with |k| <= µ. Every addition to the
    pressure is that of a flat punch on the present contact, and k times it moves this contact by a
    uniform shift (Mindlin and Deresiewicz 1953; Jäger 1998).

    contacts       normal contacts at the ends of the load steps; the first grows from nothing
    rates          k of each load step
    modulus_ratio  contact modulus over tangential modulus, E*/G*
    """

    contacts: tuple[PointContact, ...]
    rates: tuple[float, ...]
    modulus_ratio: float
    dissipated_energy: float = 0.0

    @property
    def tangential_force(self) -> float:
        """Tangential force Σ k ΔW [force]."""
        return self._sum_steps([contact.load for contact in self.contacts])

    @property
    def shift(self) -> float:
        """Tangential shift of the indenter: E*/G* Σ k Δδ with the approach δ [length]."""
        return self.modulus_ratio * self._sum_steps([each.approach for each in self.contacts])

    @property
    def stick_radius(self) -> float:
        """Radius of the stick zone, which is the whole contact [length]."""
        return self.contacts[-1].contact_radius

    def shear(self, r: ArrayLike) -> Array:
        """Compute the shear Σ k Δp on the lower body at distances r from the axis [force/length²].

        p is the pressure at the ends of the load steps.
        """
        return np.asarray(self._sum_steps([contact.pressure(r) for contact in self.contacts]))

    def _sum_steps(self, values: Sequence[Any]) -> Any:
        starts = (0.0, *values[:-1])
        return sum(
            k * (end - start) for k, start, end in zip(self.rates, starts, values, strict=True)
        )


def _refuse_gross_slip(force: float, limit: float) -> None:
    if not abs(force) <= limit * (1 + ROUNDING):
        raise ValueError(
            f"tangential force {force!r} exceeds the friction limit {limit!r}: gross slip, no "
            "static solution"
        )


@dataclass(frozen=True)
class TangentialHistory:
    """Hold the state of a Hertz contact after a history of tangential forces at constant normal
    load.

    virgin             contact without tangential force
    turning_points     forces at the reversals of open loops, with decreasing differences [force]
    tangential_force   current tangential force T [force]
    dissipated_energy  energy dissipated by friction since the start [force*length]
    """

    virgin: PartialSlip
    turning_points: tuple[float, ...] = ()
    tangential_force: float = 0.0
    dissipated_energy: float = 0.0

    def __post_init__(self) -> None:
        if self.virgin.tangential_force != 0:
            raise ValueError("a history starts from a contact without tangential force")

    def loaded_to(self, force: float) -> "TangentialHistory":
        """Compute the state after the tangential force has changed monotonically to another value
        [force].

        force  new tangential force; ValueError if |force| exceeds the friction limit µW
        """
        replace(self.virgin, tangential_force=force)
        if force == self.tangential_force:
            return self
        points, lost = self.turning_points, self.dissipated_energy
        here, rising = self.tangential_force, force > self.tangential_force
        origin = points[-1] if points else 0.0
        if here != origin and (here > origin) != rising:
            points = (*points, here)
        while points:
            closing = points[-2] if len(points) > 1 else -points[0]
            if (force < closing) if rising else (force > closing):
                break
            lost += self._lost_energy(points, closing) - self._lost_energy(points, here)
            points, here = points[:-2], closing
        lost += self._lost_energy(points, force) - self._lost_energy(points, here)
        return TangentialHistory(self.virgin, points, force, lost)

    @property
    def shift(self) -> float:
        """Tangential shift of the indenter relative to the body after the load history [length]."""
        return sum(scale * state.shift for scale, state in self.branches())

    def shear(self, r: ArrayLike) -> Array:
        """Compute the shear on the lower body at distance r from the axis after the load history
        [force/length²].
        """
        return np.asarray(sum(scale * state.shear(r) for scale, state in self.branches()))

    def slip(self, r: ArrayLike) -> Array:
        """Compute the slip of the lower surface relative to the indenter at distance r from the
        axis [length].

        r must not exceed the contact radius. The formula holds for ν = 0.
        """
        return np.asarray(sum(scale * state.slip(r) for scale, state in self.branches()))

    @property
    def stick_radius(self) -> float:
        """Radius of the zone that has not slipped since the last reversal of the force [length]."""
        return self.branches()[-1][1].stick_radius

    def branches(self) -> list[tuple[float, PartialSlip]]:
        """Return the first-loading states whose weighted sum is the current state, with their
        weights.

        Each reversal of the force that has not been closed adds a state (Masing's rule). The first
        state has weight 1; each later state has weight 2.
        """
        forces = (*self.turning_points, self.tangential_force)
        branches = [(1.0, replace(self.virgin, tangential_force=forces[0]))]
        for start, end in pairwise(forces):
            branches.append((2.0, replace(self.virgin, tangential_force=(end - start) / 2)))
        return branches

    def _lost_energy(self, points: tuple[float, ...], force: float) -> float:
        """Compute the energy dissipated between the last reversal of the force and a force
        [force*length].

        points  forces at the reversals; empty for the first loading [force]
        force   force up to which the energy is counted [force]
        """
        if not points:
            return replace(self.virgin, tangential_force=force).dissipated_energy
        half = (force - points[-1]) / 2
        return 2 * replace(self.virgin, tangential_force=half).dissipated_energy


Values = Array

# Number of radii at which the largest value is searched, dense near the edge, where σ_T > 0.
PLACES = 20_001


@dataclass(frozen=True)
class CycledContact:
    """Hold steady cycles of a Hertz contact between the tangential forces T* and -T*.

    The normal load is constant, and both materials have ν = 0. Used for the fretting parameters of
    Ruiz.

    end            state at the end of the first loading, at T* > 0
    peak_pressure  peak pressure p0 of the Hertz contact [force/length²]
    """

    end: PartialSlip
    peak_pressure: float

    def slip_amplitude(self, r: ArrayLike) -> Values:
        """Compute the slip amplitude δ of a steady cycle at distance r from the axis [length].

        δ is half the range of slip. By Masing's rule the slip of a reversal, which is the whole
        range, is twice that of the first loading. r must not exceed the contact radius.
        """
        return np.abs(self.end.slip(r))

    def largest_shear(self, r: ArrayLike) -> Values:
        """Compute the largest shear τ of a steady cycle at distance r from the axis
        [force/length²].

        τ is the shear at the largest tangential force, which is µp in the slip annulus.
        """
        return np.abs(self.end.shear(r))

    def surface_tension(self, x: ArrayLike) -> Values:
        """Compute the largest tensile stress σ_T of a steady cycle at the surface point (x, 0)
        [force/length²].

        σ_T is the larger value of σ_xx at the two ends of the cycle. The tangential force acts
        along x.
        """
        a, q0 = self.end.contact_radius, self.end.friction_coefficient * self.peak_pressure
        sheared = stress_by_partial_slip(x, a, self.end.stick_radius, q0, 0.0)
        return stress_by_hertz_pressure(x, a, self.peak_pressure, 0.0) + np.abs(sheared)

    @property
    def largest_f1(self) -> float:
        """Largest value of the first fretting parameter of Ruiz on the surface [force/length].

        The parameter is τ δ: largest shear times slip amplitude.
        """
        return float(np.max(self._f1(self._stick_radii())))

    @property
    def largest_f2(self) -> float:
        """Largest value of the second fretting parameter of Ruiz on the surface [force²/length³].

        The parameter is σ_T τ δ: tensile stress times largest shear times slip amplitude. At a
        given r the tensile stress is largest on the line through the centre along the force.
        """
        r = self._stick_radii()
        return float(np.max(np.maximum(self.surface_tension(r), 0.0) * self._f1(r)))

    def _f1(self, r: Values) -> Values:
        return self.largest_shear(r) * self.slip_amplitude(r)

    def _stick_radii(self) -> Values:
        """Return radii between the stick zone and the contact edge, dense near the contact edge
        [length].

        The maxima of the fretting parameters are searched at these radii.
        """
        a, c = self.end.contact_radius, self.end.stick_radius
        return np.asarray(a - (a - c) * np.linspace(1.0, 0.0, PLACES) ** 2)
