"""Monotonic torsion of a contact: the stick disc r < c rotates with the indenter, the rest slips.

The shear q_θ is represented by the function h of `friction_limit`, or N(t) = h/(G a) with the
torsional modulus G. In the slip annulus t > c/a the shear is the friction limit µp, so N is the
transform of µp. In the stick disc, with the twist φ (Lubkin 1951; with layers analogous to the
pressure, see `disc`),

    N = (4/π) φ t - D(t),    D = (2/π) ∫₀^∞ (Y - 1) sin κt N~ dκ,    N~ = ∫₀¹ N sin κt dt,

with Y = k G F and F the displacement per unit shear perpendicular to the wave vector. D is the
contribution of the layers and zero without layers. It is odd and entire, and is expanded in
Legendre polynomials P_2n+1(t a/c) by Galerkin's method. The shear is finite at c if N is
continuous; this condition gives the twist φ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import ceil, log2, pi

import numpy as np
from numpy.polynomial import legendre
from scipy.special import j1

from contact_scene import Scene
from contact_scene.array_types import Array
from radial.normal.disc import (
    Disc,
    orders,
)
from radial.response.bodies import (
    Bodies,
    added_by,
)
from radial.response.quadrature import unit_gauss
from radial.torsion.friction_limit import FrictionLimit
from semi_analytical.frf.stack import Stack, stack_of

POINTS = 24
NO_STICK = 1e-6  # least stick radius over the contact radius that is solved
AXIS = 1e-7  # smallest radius over the contact radius in integrals, without effect on any digit


@dataclass(frozen=True)
class Torsion:
    """Contact under torsion, with a constant pressure.

    contact   frictionless contact, which gives the pressure
    layered   bodies with layers
    modulus   torsional modulus G: reciprocal of the sum of 1/G of the outermost materials
              [force/length²]
    friction  coefficient of friction µ
    fineness  multiple of the numbers of polynomials and quadrature points
    """

    contact: Disc
    layered: Sequence[Stack]
    modulus: float
    friction: float
    fineness: int = 1

    @classmethod
    def of(cls, scene: Scene, contact: Disc, friction: float, fineness: int = 1) -> Torsion:
        """Create the contact under torsion between the two bodies of a scene.

        contact   frictionless contact, which gives the pressure
        friction  coefficient of friction µ
        fineness  multiple of the numbers of polynomials and quadrature points
        """
        stacks = [stack_of(body) for body in (scene.body, scene.indenter)]
        outer = [stack.outer.shear_modulus for stack in stacks if not stack.is_rigid]
        modulus = 1 / sum(1 / shear for shear in outer)
        layered = [stack for stack in stacks if stack.layers]
        return cls(contact, layered, modulus, friction, fineness)

    def points(self, width: float) -> int:
        """Return the number of Gauss points that resolve the shear and its waves over an interval.

        The interval is a part of 0 < t < 1, with t a coordinate between the axis (0) and the edge
        (1).

        width  length of the interval
        """
        places, _ = self.waves
        waves = ceil(places[-1] * width / 2) if len(places) else 0
        return self.fineness * (POINTS + len(self.contact.layers) + waves)

    def limit(self, t: Array) -> Array:
        """Return N(t)/t of shear at the friction limit [1].

        N is the dimensionless function that represents circumferential shear (see the module). t is
        a coordinate between the axis (0) and the edge (1).
        """
        return np.asarray(self._scale * self._limit.slope(t))

    def limit_rate(self, t: Array) -> Array:
        """Return the derivative of N(t)/t of shear at the friction limit [1].

        N is the dimensionless function that represents circumferential shear (see the module). t is
        a coordinate between the axis (0) and the edge (1).
        """
        return np.asarray(self._scale * self._limit.slope_rate(t))

    @cached_property
    def _limit(self) -> FrictionLimit:
        """Return the transform of shear at the friction limit for a coefficient of friction 1."""
        return FrictionLimit.of(self.contact)

    @property
    def _scale(self) -> float:
        """Return the factor from the transform of `_limit` to the dimensionless function N.

        The factor is µ/(G a), with the torsional modulus G and the contact radius a [length/force].
        """
        return self.friction / (self.modulus * self.contact.radius)

    @cached_property
    def whole(self) -> PartialSlip:
        """Return the state of torsion at incipient slip: all of the contact area still sticks."""
        return self.partial_slip(1.0)

    @cached_property
    def none(self) -> PartialSlip:
        """Return the state with the smallest stick radius that is solved, close to gross slip."""
        return self.partial_slip(NO_STICK)

    @cached_property
    def largest(self) -> float:
        """Return the largest torque that friction can carry, at gross slip [force length]."""
        return self.partial_slip(0.0).torque

    @cached_property
    def waves(self) -> tuple[Array, Array]:
        """Return the wavenumbers κ, and their quadrature weights times Y - 1 (κ,).

        Y - 1 is the relative contribution of the layers to the torsional compliance. Both arrays
        are empty without layers.
        """
        if not self.layered:
            return np.zeros(0), np.zeros(0)
        a = self.contact.radius
        of_layers = Bodies(self.layered, self.modulus)
        waves = of_layers.waves(a, fineness=self.fineness)
        places, weights = waves.rule
        added = np.sum([added_by(stack, waves, a).csh for stack in self.layered], axis=0)
        return places, np.asarray(weights * self.modulus * places / a * added)

    def partial_slip(self, stick: float) -> PartialSlip:
        """Solve the state of monotonic torsion with a given stick radius.

        stick  stick radius over the contact radius, 0 to 1
        """
        panels = self._panels(max(stick, AXIS))
        if stick == 0:
            return PartialSlip(self, 0.0, np.inf, np.zeros(1), panels)
        places, wave_weights = self.waves
        count = 1
        if len(places):
            thickness = min(stack.layers[0].thickness for stack in self.layered)
            count = orders(thickness / (self.contact.radius * stick), False) * self.fineness
        t, weights = unit_gauss(self.points(stick) + 2 * count)
        odd = legendre.legvander(t, 2 * count - 1)[:, 1::2]
        bases = stick * (odd.T * weights) @ np.sin(np.multiply.outer(stick * t, places))
        by_annulus = sum((panel.transform(places) for panel in panels), np.zeros_like(places))
        matrix = 2 / pi * (bases * wave_weights) @ bases.T
        right = np.stack(
            [4 / pi * stick * matrix[:, 0], 2 / pi * bases @ (wave_weights * by_annulus)]
        )
        mass = stick / (4 * np.arange(count) + 3)
        by_twist, alone = np.linalg.solve(matrix + np.diag(mass), right.T).T
        edge = stick * float(self.limit(np.array([stick]))[0])
        twist = (edge + np.sum(alone)) / (4 / pi * stick - np.sum(by_twist))
        layers = twist * by_twist + alone
        return PartialSlip(self, stick, float(twist), layers, panels)

    def _panels(self, stick: float) -> list[Panel]:
        """Return intervals that cover the slip annulus, with the function N of its shear.

        The shear is the friction limit, and N represents it (see the module). An interval is not
        wider than its distance from the axis.

        stick  stick radius over the contact radius
        """
        if stick >= 1:
            return []
        edges = np.geomspace(stick, 1.0, ceil(log2(1 / stick)) + 1)
        made = []
        for low, high in pairwise(edges):
            v, _ = unit_gauss(self.points(high - low))
            t = low + (high - low) * v
            made.append(Panel(float(low), float(high), t * self.limit(t)))
        return made


@dataclass(frozen=True)
class Panel:
    """Interval of 0 < t < 1, with the function N that represents the shear at its Gauss points.

    N is defined in the module. t is a coordinate between the axis (0) and the edge (1).

    low, high  ends of the interval of t
    values     N at the Gauss points (n,)
    """

    low: float
    high: float
    values: Array

    def integral(self, power: int, factor: int = 1) -> float:
        """Return the integral ∫ N^factor t^power dt over the interval.

        N represents the circumferential shear.

        power   exponent of t
        factor  exponent of N
        """
        v, weights = unit_gauss(len(self.values))
        width = self.high - self.low
        t = self.low + width * v
        return float(width * np.sum(weights * self.values**factor * t**power))

    def transform(self, places: Array) -> Array:
        """Return the sine transform ∫ N sin κt dt over the interval, at all wavenumbers (κ,).

        N represents the circumferential shear.

        places  dimensionless wavenumbers κ
        """
        v, weights = unit_gauss(len(self.values))
        width = self.high - self.low
        waves = np.sin(np.multiply.outer(self.low + width * v, places))
        return np.asarray(width * (weights * self.values) @ waves)


@dataclass(frozen=True)
class PartialSlip:
    """State of monotonic torsion with a stick disc and a slip annulus.

    of      contact under torsion
    stick   stick radius over the contact radius, c/a
    twist   twist φ of the indenter [radian]
    layers  Legendre coefficients of the contribution of the layers to N in the stick disc
    panels  function N of the shear in the slip annulus (see the module)
    """

    of: Torsion
    stick: float
    twist: float
    layers: Array
    panels: Sequence[Panel]

    def inside(self, t: Array) -> Array:
        """Return the function N that represents the circumferential shear, in the stick disc.

        N is defined in the module.

        t  coordinates between the axis (0) and the stick radius (`stick`)
        """
        every = np.zeros(2 * len(self.layers))
        every[1::2] = self.layers
        return np.asarray(4 / pi * self.twist * t - legendre.legval(t / self.stick, every))

    @property
    def _disc(self) -> list[Panel]:
        """Return the function N of the shear in the stick disc, as a list with one panel.

        The list is empty without a stick disc.
        """
        if self.stick == 0:
            return []
        v, _ = unit_gauss(self.of.points(self.stick) + 2 * len(self.layers))
        return [Panel(0.0, self.stick, self.inside(self.stick * v))]

    @cached_property
    def torque(self) -> float:
        """Return the torque of the circumferential shear [force length].

        It is 4π G a³ ∫ N t dt, with the function N of the module and the torsional modulus G.
        """
        total = sum(panel.integral(1) for panel in (*self._disc, *self.panels))
        return 4 * pi * self.of.modulus * self.of.contact.radius**3 * total

    @cached_property
    def transform(self) -> Array:
        """Return the sine transform of the function N that represents the shear (κ,).

        The wavenumbers κ are those of `Torsion.waves`.
        """
        places, _ = self.of.waves
        parts = [panel.transform(places) for panel in (*self._disc, *self.panels)]
        return np.asarray(np.sum(parts, axis=0))

    @cached_property
    def elastic_energy(self) -> float:
        """Return the elastic energy of both bodies by the circumferential shear q [force length].

            ½ ∫ q u dA = π G a³ [(π/2) ∫ N² dt + ∫ (Y - 1) N~² dκ]

        N~ is the sine transform of the function N that represents the shear. Y - 1 is the relative
        contribution of the layers to the torsional compliance.
        """
        squares = sum(panel.integral(0, 2) for panel in (*self._disc, *self.panels))
        _, wave_weights = self.of.waves
        by_layers = float(np.sum(wave_weights * self.transform**2)) if len(wave_weights) else 0.0
        scale = pi * self.of.modulus * self.of.contact.radius**3
        return scale * (pi / 2 * squares + by_layers)

    @property
    def work(self) -> float:
        """Return the work ∫ M dφ of the torque since the start of the twist [force length]."""
        return self.twist * self.torque - self.elastic_energy

    @property
    def dissipated(self) -> float:
        """Return the energy dissipated since the start of the twist [force length].

        It is 2π ∫ µp |s| r dr: points of the slip annulus carry the shear µp from the start of
        their slip s.
        """
        return self.twist * self.torque - 2 * self.elastic_energy

    def shear(self, x: Array, limit: Array) -> Array:
        """Return the circumferential shear q_θ at r = a x within the contact (n,) [force/length²].

        x      radii over the contact radius (n,)
        limit  friction limit µp at these radii (n,) [force/length²]
        """
        found = limit.copy()
        sticks = x < min(self.stick, 1.0)
        if not np.any(sticks):
            return found
        at = x[sticks]
        rho = np.maximum(at, AXIS)[:, None]
        v, weights = unit_gauss(2 * self.of.points(0.0))
        first, last = np.arccosh(np.maximum(self.stick / rho, 1.0)), np.arccosh(1 / rho)
        slipping = (last - first) * (
            self.of.limit_rate(np.minimum(rho * np.cosh(first + (last - first) * v), 1.0)) @ weights
        )[:, None]
        total = -slipping[:, 0]
        if len(self.layers) > 1:
            y, shares = unit_gauss(2 * POINTS + 2 * len(self.layers))
            t = np.minimum(rho * np.cosh(first * y), self.stick)
            total -= first[:, 0] * (self._layers_rate(t) @ shares)
        if self.of.contact.edge:
            rim = self.of.limit(np.ones(1)) if self.stick < 1 else self.inside(np.ones(1))
            total += float(rim[0]) / np.sqrt((1 - at) * (1 + at))
        found[sticks] = self.of.modulus * at * total
        return found

    def _layers_rate(self, t: Array) -> Array:
        """Return d(-D/t)/dt at points t in the stick disc, for the integral of the shear.

        D is the contribution of the layers to the function N that represents the shear.
        """
        every = np.zeros(2 * len(self.layers))
        every[1::2] = self.layers
        x = t / self.stick
        changed, rate = legendre.legval(x, every), legendre.legval(x, legendre.legder(every))
        return np.asarray((changed / x - rate) / (x * self.stick**2))

    def slip(self, x: Array) -> Array:
        """Return the circumferential slip u_θ - φ r at r = a x (n,) [length].

        The slip is 0 in the stick disc and outside the contact.

        x  radii over the contact radius (n,)
        """
        found = np.zeros_like(x)
        slips = (x > self.stick) & (x <= 1)
        if not np.any(slips):
            return found
        rho = x[slips][:, None]
        v, weights = unit_gauss(2 * self.of.points(0.0))
        border = np.arcsin(self.stick / rho)
        angle = border + (pi / 2 - border) * v
        t = np.maximum(rho * np.sin(angle), AXIS)
        moved = (pi / 2 - border[:, 0]) * (t * self.of.limit(t) * np.sin(angle) @ weights)
        if self.stick:
            angle = border * v
            sticking = self.inside(rho * np.sin(angle)) * np.sin(angle)
            moved += border[:, 0] * (sticking @ weights)
        places, wave_weights = self.of.waves
        if len(places):
            moved += j1(np.multiply.outer(rho[:, 0], places)) @ (wave_weights * self.transform)
        found[slips] = self.of.contact.radius * (moved - self.twist * rho[:, 0])
        return found
