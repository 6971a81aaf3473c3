"""Frictionless contact on a disc, by Legendre polynomials.

With the pressure's transform p~(k) = (E*/π) ∫₀ᵃ G(s) cos ks ds, contact on r < a is (Lebedev and
Ufliand 1958; for layers, Perriot and Barthel 2004), with s = a t and κ = k a,

    G(t) = δ - S(t) + C(t),    C(t) = -(2/π) ∫₀^∞ (X - 1) cos κt G~ dκ,   G~ = ∫₀¹ G(t) cos κt dt,

δ the approach and S of the profile. C, which layers change, is even and entire whatever the
profile: its coefficients c_n of P_2n(t) fall geometrically, and by Galerkin's method

    c_n/(4n+1) = -(2/π) ∫₀^∞ (X - 1) B_n G~ dκ,    G~ = δ B_0 - S~ + Σ c_m B_m

with B_n the transform of P_2n. What a profile has of corners is in S, in closed form.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import ceil, log, pi
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import cho_factor, cho_solve

from contact_scene.array_types import Array
from contact_scene.solver_errors import NotConverged, UnsupportedScene
from radial.normal.profile import (
    Profile,
    profile,
)
from radial.response.array_cache import (
    MAX_KEPT,
    kept_within,
)
from radial.response.bodies import Bodies
from radial.response.quadrature import (
    every_order,
    shifted,
    unit_gauss,
)
from radial.response.wavenumbers import Waves

if TYPE_CHECKING:
    from contact_scene.geometry import ShapedBody


# Of what is added up in the equation: by less nobody can miss it.
ROUND_OFF = 1e-12
SMOOTH = 1e-9  # of the approach: less at an edge is round-off
ELSEWHERE = "solve it with the semi-analytical solver"
FEWEST_ORDERS, MAX_ORDERS = 8, 256
AT_ONCE = 8192  # wavenumbers
PLACES = 40  # at which the equation is judged, none of them a node of the method


@dataclass(frozen=True)
class Disc:
    """A contact.

    bodies    what is pressed together
    profile   the gap over it
    radius    a [length]
    approach  δ since first touch [length]
    layers    c_n [length]
    missed    largest misfit of the equation over the approach [1]; the gap that it leaves within
              the contact is nowhere larger
    """

    bodies: Bodies
    profile: Profile
    radius: float
    approach: float
    layers: Array
    missed: float

    @property
    def load(self) -> float:
        """W = 2 E* a ∫₀¹ G dt [force]."""
        mean = self.approach - self.profile.abel[0] + self.layers[0]
        return float(2 * self.bodies.modulus * self.radius * mean)

    @property
    def elastic_energy(self) -> float:
        """½ ∫ p u_z dA = E* a ∫₀¹ G (δ - S) dt, stored in both bodies [force length]."""
        t, weights = unit_gauss(len(self.profile.abel) + len(self.layers))
        moved = self.approach - self.profile.at(t)
        return float(self.bodies.modulus * self.radius * (weights @ (self.transform(t) * moved)))

    @property
    def edge(self) -> float:
        """G(1), which makes the pressure infinite at a rim; exactly 0 where it ends smoothly
        [length]."""
        value = float(self.transform(np.ones(1))[0])
        return value if abs(value) > SMOOTH * self.approach else 0.0

    def transform(self, t: Array) -> Array:
        """G at s = a t [length]."""
        changed = legendre.legval(t, every_order(self.layers))
        return np.asarray(self.approach - self.profile.at(t) + changed)

    def rate(self, t: Array) -> Array:
        """dG/dt [length]."""
        changed = legendre.legval(t, legendre.legder(every_order(self.layers)))
        return np.asarray(changed - shifted(self.profile.rate, t))

    def wave_transform(self, waves: Waves) -> Array:
        """G~ at every κ (n,) [length]: the pressure's Hankel transform is (E* a/π) G~."""
        bases = waves.even_transforms(len(self.layers))
        by_profile = waves.shifted_transform(self.profile.abel)
        return np.asarray(self.approach * bases[0] - by_profile + self.layers @ bases)


class _Galerkin:
    """The equation for one contact radius.

    waves   κ
    count   how many orders
    excess  X - 1 at every κ, times the weight of each
    """

    def __init__(self, waves: Waves, count: int, excess: Array) -> None:
        self.waves, self.count, self.excess = waves, count, excess
        self.bases = waves.even_transforms(count)
        self.scale = np.sqrt(4.0 * np.arange(count) + 1)

    @cached_property
    def factor(self) -> Any:
        """Of the matrix, symmetric and positive definite because X is positive."""
        kernel = np.zeros((self.count, self.count))
        for first in range(0, len(self.excess), AT_ONCE):
            some = slice(first, first + AT_ONCE)
            kernel += (self.bases[:, some] * self.excess[some]) @ self.bases[:, some].T
        matrix = np.eye(self.count) + 2 / pi * self.scale[:, None] * kernel * self.scale
        return cho_factor(matrix, lower=True, overwrite_a=True, check_finite=False)

    def changed(self, transform: Array) -> Array:
        """c_n for G = f + C, from the transform of f."""
        right = -2 / pi * self.scale * (self.bases @ (self.excess * transform))
        return np.asarray(self.scale * cho_solve(self.factor, right, check_finite=False))

    def missed(self, layers: Array, transform: Array) -> float:
        """Largest misfit of c_n for that f [length]."""
        polynomials, cosines = _judged(self.waves, self.count)
        exact = -2 / pi * (cosines @ (self.excess * (transform + layers @ self.bases)))
        return float(np.max(np.abs(polynomials @ layers - exact)))


@kept_within(MAX_KEPT)
def _judged(waves: Waves, count: int) -> tuple[Array, Array]:
    """P_2n and cos κt at the places where the equation is judged."""
    t = (np.arange(PLACES) + 0.5) / PLACES
    polynomials = np.asarray(legendre.legvander(t, 2 * count - 2)[:, ::2], dtype=float)
    return polynomials, np.cos(np.multiply.outer(t, waves.rule[0]))


def disc(
    bodies: Bodies,
    indenter: ShapedBody,
    radius: float,
    approach: float | None = None,
    fineness: int = 1,
    most: int | None = None,
) -> Disc:
    """The contact of this radius [length]: at the approach [length] where it has a rim, else at
    the one for which its pressure ends smoothly.

    fineness  how many times as many points and orders as it takes
    most      orders at most, for what has to be right to a few percent alone
    raises    NotConverged where the equation cannot be solved to round-off, and what `profile` does
    """
    shape = profile(indenter, radius, fineness)
    if not bodies.layered:
        depth = shape.at_edge if approach is None else approach
        return Disc(bodies, shape, radius, depth, np.zeros(1), 0.0)
    count = orders(bodies.thickness / radius, shape.apex) * fineness
    count = min(count, most or count)
    waves = bodies.waves(radius, fineness=fineness)
    excess = waves.rule[1] * bodies.excess(waves, radius)
    by_profile = -waves.shifted_transform(shape.abel)
    best: Disc | None = None
    while True:
        method = _Galerkin(waves, count, excess)
        of_approach, of_profile = method.changed(method.bases[0]), method.changed(by_profile)
        if approach is None:  # G(1) = 0, where every P_2n is 1
            depth = float((shape.at_edge - np.sum(of_profile)) / (1 + np.sum(of_approach)))
        else:
            depth = approach
        layers = depth * of_approach + of_profile
        missed = method.missed(layers, depth * method.bases[0] + by_profile)
        made = Disc(bodies, shape, radius, depth, layers, missed / (abs(depth) or 1.0))
        if most or missed <= ROUND_OFF * (abs(depth) + float(np.sum(np.abs(layers)))):
            return made
        if best is not None and made.missed > 0.5 * best.missed:
            return best
        best, count = made, 2 * count
        if count > 2 * MAX_ORDERS * fineness:
            raise NotConverged("the contact on a disc", count // 2, made.missed, ROUND_OFF)


def orders(thickness: float, apex: bool) -> int:
    """How many the images of the edge, and of an apex, in the underside of a layer call for: C has
    its singularities at t = ±1 ± 2ih/a and at ± 2ih/a. A multiple of eight.

    thickness  of the layer over the contact radius
    raises     UnsupportedScene for too many
    """
    image = (0 if apex else 1) + 2j * thickness
    ellipse = abs(image + (image - 1) ** 0.5 * (image + 1) ** 0.5)
    count = FEWEST_ORDERS * ceil(-log(ROUND_OFF) / (2 * log(ellipse)) / FEWEST_ORDERS)
    if count > MAX_ORDERS:
        raise UnsupportedScene(
            f"the contact is {1 / thickness:.3g} times as large as the outermost layer is thick, "
            f"beyond what {MAX_ORDERS} polynomials resolve; {ELSEWHERE}"
        )
    return count
