"""Monotonic torsion of a contact: the stick disc r < c rotates with the indenter, the rest slips.

The shear q_θ is represented by the function h of `friction_limit`, or N(t) = h/(G a) with the
torsional modulus G: q(a x) = -G d/dx ∫ₓ¹ N/√(t²-x²) dt, with t from 0 at the axis to 1 at the edge.
In the slip annulus t > c/a the shear is the friction limit µp, so N is the transform of µp. In the
stick disc, with the twist φ (Lubkin 1951; with layers analogous to the pressure, see `disc`),

    N = (4/π) φ t - D(t),    D = (2/π) ∫₀^∞ (Y - 1) sin κt N~ dκ,    N~ = ∫₀¹ N sin κt dt,

with Y = k G F and F the displacement per unit shear perpendicular to the wave vector. D is the
contribution of the layers and zero without layers. It is odd and entire, and is expanded in
Legendre polynomials P_2n+1(t a/c) by Galerkin's method. The shear is finite at c if N is
continuous; this condition gives the twist φ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, log2, pi
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from scipy.special import j1

from contact_scene import Scene
from contact_scene.array_types import Array
from radial.normal.disc import (
    Disc,
    polynomial_count,
)
from radial.response.bodies import (
    Bodies,
    layer_responses,
)
from radial.response.quadrature import all_order_coefficients, unit_gauss
from radial.torsion.friction_limit import FrictionLimit
from semi_analytical.frf.stack import Stack, stack_of

POINTS = 24
NO_STICK = 1e-6  # least stick radius over the contact radius that is solved
AXIS = 1e-7  # smallest radius over the contact radius in integrals, without effect on any digit


@dataclass(frozen=True)
class Torsion:
    """Contact of two bodies under constant pressure that are twisted against each other, from zero.

    The methods compute states of monotonic torsion: a stick disc and a slip annulus, without load
    reversal. All these states are functions of the stick radius.

    contact   frictionless contact, which gives the pressure
    layered   the bodies with layers (none, one or two)
    modulus   torsional modulus G: reciprocal of the sum of 1/G of the outermost materials
              [force/length²]
    friction  coefficient of friction µ
    fineness  factor on the numbers of polynomials and quadrature points, 1 by default
    """

    contact: Disc
    layered: Sequence[Stack]
    modulus: float
    friction: float
    fineness: int = 1

    @classmethod
    def of(cls, scene: Scene, contact: Disc, friction: float, fineness: int = 1) -> Torsion:
        """Create the contact under torsion between the two bodies of a scene, at a given pressure.

        scene     contact problem, which gives the materials
        contact   frictionless contact, which gives the pressure
        friction  coefficient of friction µ
        fineness  factor on the numbers of polynomials and quadrature points, 1 by default
        """
        stacks = [stack_of(body) for body in (scene.body, scene.indenter)]
        outer = [stack.outer.shear_modulus for stack in stacks if not stack.is_rigid]
        modulus = 1 / sum(1 / shear for shear in outer)
        layered = [stack for stack in stacks if stack.layers]
        return cls(contact, layered, modulus, friction, fineness)

    def gauss_count(self, width: float) -> int:
        """Return the number of Gauss points for integrals over an interval of the radius.

        The coordinate t is 0 at the axis and 1 at the contact edge. The points resolve the shear
        and, with layers, the waves sin κt of the largest wavenumber κ.

        width  length of the interval of t, 0 to 1
        """
        places, _ = self.waves
        waves = ceil(places[-1] * width / 2) if len(places) else 0
        return self.fineness * (POINTS + len(self.contact.layers) + waves)

    @cached_property
    def friction_limit(self) -> FrictionLimit:
        """Transform N(t)/t of the circumferential shear q = µp at the friction limit."""
        return FrictionLimit.of(self.contact, self.friction, self.modulus)

    @cached_property
    def incipient_slip(self) -> PartialSlip:
        """State of monotonic torsion at incipient slip: the whole contact still sticks.

        States with a smaller twist are proportional to this state. Its stick radius is the contact
        radius, the upper end of the search for the stick radius of a prescribed twist or torque.
        """
        return self.partial_slip(1.0)

    @cached_property
    def least_stick(self) -> PartialSlip:
        """State of monotonic torsion with the smallest stick radius that is solved.

        The state is close to gross slip. Its stick radius is the lower end of the search for the
        stick radius of a prescribed twist or torque.
        """
        return self.partial_slip(NO_STICK)

    @cached_property
    def gross_slip_torque(self) -> float:
        """Torque at which the whole contact slips, the limit of friction [force length].

        All points then carry the shear µp.
        """
        return self.partial_slip(0.0).torque

    @cached_property
    def waves(self) -> tuple[Array, Array]:
        """Wavenumbers at which layers contribute to torsion, and their weights (κ,).

        The first array contains the wavenumbers κ, multiplied by the contact radius. The second
        array contains quadrature weights times Y - 1, the contribution of the layers to the
        torsional compliance relative to that of half-spaces. Both arrays are empty without layers.
        """
        if not self.layered:
            return np.zeros(0), np.zeros(0)
        a = self.contact.radius
        of_layers = Bodies(self.layered, self.modulus)
        waves = of_layers.waves(a, fineness=self.fineness)
        places, weights = waves.rule
        added = layer_responses(tuple((stack, 1.0) for stack in self.layered), waves, a)[3]
        return places, weights * self.modulus * added

    def partial_slip(self, stick: float) -> PartialSlip:
        """Solve the state of monotonic torsion that has a given stick radius.

        In the slip annulus the shear is the friction limit. In the stick disc the surfaces rotate
        rigidly by the twist. The twist follows from the continuity of the shear at the stick
        radius.

        stick  stick radius over the contact radius, 0 to 1
        """
        panels = self._annulus_panels(max(stick, AXIS))
        if stick == 0:
            return PartialSlip(self, 0.0, np.inf, np.zeros(1), np.zeros(1), panels)
        places, wave_weights = self.waves
        count = 1
        if len(places):
            thickness = min(stack.layers[0].thickness for stack in self.layered)
            count = (
                polynomial_count(thickness / (self.contact.radius * stick), False) * self.fineness
            )
        t, weights = unit_gauss(self.gauss_count(stick) + 2 * count)
        odd = legendre.legvander(t, 2 * count - 1)[:, 1::2]
        bases = stick * (odd.T * weights) @ np.sin(np.multiply.outer(stick * t, places))
        by_annulus = sum((panel.sine_transform(places) for panel in panels), np.zeros_like(places))
        matrix = 2 / pi * (bases * wave_weights) @ bases.T
        right = np.stack(
            [4 / pi * stick * matrix[:, 0], 2 / pi * bases @ (wave_weights * by_annulus)]
        )
        mass = stick / (4 * np.arange(count) + 3)
        by_twist, alone = np.linalg.solve(matrix + np.diag(mass), right.T).T
        edge = stick * float(self.friction_limit.evaluate_transform(np.array([stick]))[0])
        twist = (edge + np.sum(alone)) / (4 / pi * stick - np.sum(by_twist))
        layers = twist * by_twist + alone
        return PartialSlip(self, stick, float(twist), layers, by_twist, panels)

    def _annulus_panels(self, stick: float) -> list[Panel]:
        """Return intervals that cover the slip annulus, with the transform N of the shear.

        The shear in the slip annulus is the friction limit µp. N(t) is the function whose Abel
        transform is the shear. Torque and energy are sums over these intervals. An interval is not
        wider than its distance from the axis.

        stick  stick radius over the contact radius, 0 to 1
        """
        if stick >= 1:
            return []
        edges = np.geomspace(stick, 1.0, ceil(log2(1 / stick)) + 1)
        made = []
        for low, width in zip(edges, np.diff(edges), strict=False):
            v, weights = unit_gauss(self.gauss_count(width))
            t = low + width * v
            made.append(Panel(t, width * weights, t * self.friction_limit.evaluate_transform(t)))
        return made


class Panel(NamedTuple):
    """Gauss points of an interval of the radius, with the transform N of the circumferential shear.

    Torque and energy of torsion are integrals of N over all intervals of stick disc and slip
    annulus.

    t        coordinates of the points, from 0 at the axis to 1 at the contact edge (n,)
    weights  quadrature weights (n,)
    values   N at the points (n,) [1]
    """

    t: Array
    weights: Array
    values: Array

    def sine_transform(self, places: Array) -> Array:
        """Compute the sine transform ∫ N sin κt dt over the interval, at given wavenumbers (κ,).

        Layers contribute to the twist by this transform.

        places  wavenumbers κ, multiplied by the contact radius (κ,)
        """
        return np.asarray((self.weights * self.values) @ np.sin(np.multiply.outer(self.t, places)))


@dataclass(frozen=True)
class PartialSlip:
    """State of monotonic torsion of a contact, with a stick disc and a slip annulus.

    In the stick disc N = (4/π) φ t - D, with the twist φ and the contribution D of the layers.

    of      contact under torsion
    stick   stick radius over the contact radius, c/a
    twist   twist φ of the indenter [radian]
    layers  Legendre coefficients of D in the stick disc, of odd orders
    by_twist  derivative of these coefficients by the twist at constant stick radius
    panels  intervals of the slip annulus, with N of the shear at the friction limit
    """

    of: Torsion
    stick: float
    twist: float
    layers: Array
    by_twist: Array
    panels: Sequence[Panel]

    def stick_transform(self, t: Array) -> Array:
        """Evaluate the transform N of the circumferential shear in the stick disc of torsion [1].

            N(t) = (4/π) φ t - D(t)

        φ, D  twist of the indenter, and contribution of the layers
        t     coordinates, from 0 at the axis to the stick radius over the contact radius (any
              shape)
        """
        change = legendre.legval(t / self.stick, all_order_coefficients(self.layers, 1))
        return np.asarray(4 / pi * self.twist * t - change)

    @property
    def _disc_panels(self) -> list[Panel]:
        """Intervals of the stick disc with the transform N of the shear:
        one, or none without stick."""
        if self.stick == 0:
            return []
        v, weights = unit_gauss(self.of.gauss_count(self.stick) + 2 * len(self.layers))
        t = self.stick * v
        return [Panel(t, self.stick * weights, self.stick_transform(t))]

    @cached_property
    def torque(self) -> float:
        """Torque of the circumferential shear, 4π G a³ ∫₀¹ N t dt [force length]."""
        total = sum(float(w * t @ N) for t, w, N in (*self._disc_panels, *self.panels))
        return 4 * pi * self.of.modulus * self.of.contact.radius**3 * total

    @cached_property
    def transform(self) -> Array:
        """Sine transform ∫₀¹ N sin κt dt of the transform N of the shear (κ,).

        The displacement by the layers is an integral of this transform over the wavenumber κ,
        multiplied by the contact radius.
        """
        places, _ = self.of.waves
        parts = [panel.sine_transform(places) for panel in (*self._disc_panels, *self.panels)]
        return np.asarray(np.sum(parts, axis=0))

    @cached_property
    def elastic_energy(self) -> float:
        """Elastic energy of both bodies by the circumferential shear q [force length].

            ½ ∫ q u dA = π G a³ [(π/2) ∫ N² dt + ∫ (Y - 1) N~² dκ]

        Y - 1  contribution of the layers to the torsional compliance, relative to half-spaces
        """
        squares = sum(float(w @ N**2) for _, w, N in (*self._disc_panels, *self.panels))
        _, wave_weights = self.of.waves
        by_layers = float(np.sum(wave_weights * self.transform**2)) if len(wave_weights) else 0.0
        scale = pi * self.of.modulus * self.of.contact.radius**3
        return scale * (pi / 2 * squares + by_layers)

    @cached_property
    def stiffness(self) -> float:
        """Derivative dM/dφ of the torque by the twist [force length].

        It is that at constant stick radius, because the shear is continuous at the stick radius.
        """
        unit = replace(self, twist=1.0, layers=self.by_twist, panels=[])
        return unit.torque if self.stick else 0.0

    @property
    def work(self) -> float:
        """Work ∫ M dφ of the torque M from twist 0 to this state [force length].

        φ is the twist of the indenter, which increases monotonically. The work is the elastic
        energy plus the dissipated energy.
        """
        return self.twist * self.torque - self.elastic_energy

    @property
    def dissipated(self) -> float:
        """Energy dissipated by friction since the start of the twist [force length].

        The energy is 2π a² ∫ µp |s| x dx: points of the slip annulus carry the shear µp from the
        start of their slip s. It is computed as the work of the torque minus the elastic energy.
        """
        return self.twist * self.torque - 2 * self.elastic_energy

    def shear(self, x: Array, limit: Array) -> Array:
        """Compute the circumferential shear q_θ at radii within the contact (n,) [force/length²].

        In the slip annulus the shear is the friction limit. In the stick disc the shear is the Abel
        transform of N over stick disc and slip annulus, see `PartialSlip`.

        x      radii over the contact radius, below 1 (n,)
        limit  friction limit µp at these radii (n,) [force/length²]
        """
        found = limit.copy()
        sticks = x < min(self.stick, 1.0)
        if not np.any(sticks):
            return found
        at = x[sticks]
        rho = np.maximum(at, AXIS)[:, None]
        v, weights = unit_gauss(2 * self.of.gauss_count(0.0))
        first, last = np.arccosh(np.maximum(self.stick / rho, 1.0)), np.arccosh(1 / rho)
        slipping = (last - first) * (
            self.of.friction_limit.transform_rate(
                np.minimum(rho * np.cosh(first + (last - first) * v), 1.0)
            )
            @ weights
        )[:, None]
        total = -slipping[:, 0]
        if len(self.layers) > 1:
            y, shares = unit_gauss(2 * POINTS + 2 * len(self.layers))
            t = np.minimum(rho * np.cosh(first * y), self.stick)
            total -= first[:, 0] * (self._layers_rate(t) @ shares)
        if self.of.contact.edge:
            rim = (
                self.of.friction_limit.evaluate_transform(np.ones(1))
                if self.stick < 1
                else self.stick_transform(np.ones(1))
            )
            total += float(rim[0]) / np.sqrt((1 - at) * (1 + at))
        found[sticks] = self.of.modulus * at * total
        return found

    def _layers_rate(self, t: Array) -> Array:
        """Evaluate d(-D/t)/dt in the stick disc, the integrand of the shear by layers [1]."""
        x, every = t / self.stick, all_order_coefficients(self.layers, 1)
        changed, rate = legendre.legval(x, every), legendre.legval(x, legendre.legder(every))
        return np.asarray((changed / x - rate) / (x * self.stick**2))

    def slip(self, x: Array) -> Array:
        """Compute the circumferential slip u_θ - φ r of torsion at given radii (n,) [length].

        u_θ is the surface displacement of the lower body relative to the indenter by the shear, φ
        the twist, r the radius. The slip is 0 in the stick disc and outside the contact.

        x  radii over the contact radius (n,)
        """
        found = np.zeros_like(x)
        slips = (x > self.stick) & (x <= 1)
        if not np.any(slips):
            return found
        rho = x[slips][:, None]
        v, weights = unit_gauss(2 * self.of.gauss_count(0.0))
        border = np.arcsin(self.stick / rho)
        angle = border + (pi / 2 - border) * v
        t = np.maximum(rho * np.sin(angle), AXIS)
        moved = (pi / 2 - border[:, 0]) * (
            t * self.of.friction_limit.evaluate_transform(t) * np.sin(angle) @ weights
        )
        if self.stick:
            angle = border * v
            sticking = self.stick_transform(rho * np.sin(angle)) * np.sin(angle)
            moved += border[:, 0] * (sticking @ weights)
        places, wave_weights = self.of.waves
        if len(places):
            moved += j1(np.multiply.outer(rho[:, 0], places)) @ (wave_weights * self.transform)
        found[slips] = self.of.contact.radius * (moved - self.twist * rho[:, 0])
        return found
