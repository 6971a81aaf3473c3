"""Frictionless contact on a disc r < a, expanded in Legendre polynomials.

With the pressure's transform p~(k) = (E*/π) ∫₀ᵃ G(s) cos ks ds, the condition of contact on r < a
is (Lebedev and Ufliand 1958; for layers, Perriot and Barthel 2004), with s = a t and κ = k a,

    G(t) = δ - S(t) + C(t),    C(t) = -(2/π) ∫₀^∞ (X - 1) cos κt G~ dκ,   G~ = ∫₀¹ G(t) cos κt dt.

δ is the approach, S the Abel transform of the undeformed gap (see `Profile`), and X the normal
response over that of half-spaces (see `Bodies.excess`). The contribution C of the layers is zero
without layers. C is even and entire for every profile, so its coefficients c_n of P_2n(t) decrease
geometrically. By Galerkin's method,

    c_n/(4n+1) = -(2/π) ∫₀^∞ (X - 1) B_n G~ dκ,    G~ = δ B_0 - S~ + Σ c_m B_m

with B_n the transform of P_2n. S contains the corners of a profile in closed form.
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
    MAX_CACHED,
    cache_within_bytes,
)
from radial.response.bodies import Bodies
from radial.response.quadrature import (
    all_order_coefficients,
    evaluate_legendre,
    unit_gauss,
)
from radial.response.wavenumbers import Waves, wave_blocks

if TYPE_CHECKING:
    from contact_scene.geometry import ShapedBody


# Error of the contact equation over the sum of its terms. Below it more polynomials gain nothing.
ROUND_OFF = 1e-12
SMOOTH = 1e-9  # G(1) below this multiple of the approach is round-off: the edge is smooth
ELSEWHERE = "solve it with the semi-analytical solver"
FEWEST_ORDERS = 8
MAX_ORDERS = 256
# Number of points at which the error of the contact equation is evaluated.
PLACES = 40


@dataclass(frozen=True)
class Disc:
    """Solution of the frictionless contact of bodies of revolution on a disc of radius a.

    The pressure is the Abel transform of a function G(t) on 0 < t < 1: p(a x) = (E*/π a)
    [G(1)/√(1-x²) - ∫ₓ¹ G'(t)/√(t²-x²) dt]. Within the contact G = δ - S + C, with the approach δ,
    the Abel transform S of the undeformed gap, and the contribution C of the layers.

    bodies    normal response of both bodies, with the contact modulus E*
    profile   undeformed gap over the contact, by its Abel transform S
    radius    contact radius a [length]
    approach  approach δ of the indenter since first contact [length]
    layers    Legendre coefficients c_n of C, of even orders (orders,) [length]
    residual  largest error of the contact equation G = δ - S + C over the approach [1]; it bounds
              the gap that remains within the contact, over the approach
    """

    bodies: Bodies
    profile: Profile
    radius: float
    approach: float
    layers: Array
    residual: float

    @property
    def load(self) -> float:
        """Normal force of the contact, W = 2 E* a ∫₀¹ G dt [force].

        G(t) is the function of which the pressure is the Abel transform, E* the contact modulus, a
        the contact radius. t is 0 at the axis and 1 at the contact edge.
        """
        mean = self.approach - self.profile.abel[0] + self.layers[0]
        return float(2 * self.bodies.modulus * self.radius * mean)

    @property
    def elastic_energy(self) -> float:
        """Elastic energy of both bodies, ½ ∫ p u_z dA [force length].

        The energy is E* a ∫₀¹ G (δ - S) dt, with the contact modulus E* and the contact radius a.
        G(t) is the function of which the pressure is the Abel transform, δ the approach, and S the
        Abel transform of the undeformed gap.
        """
        t, weights = unit_gauss(len(self.profile.abel) + len(self.layers))
        moved = self.approach - self.profile.evaluate_abel(t)
        return float(
            self.bodies.modulus * self.radius * (weights @ (self.evaluate_abel_function(t) * moved))
        )

    @property
    def edge(self) -> float:
        """Strength G(1) of the singularity of the pressure at a rim [length].

        Near the edge of the contact p = (E*/π a) G(1)/√(1-x²), with the contact modulus E*, the
        contact radius a and x = r/a. The strength is 0 at a smooth edge, where the pressure is
        zero.
        """
        value = float(self.evaluate_abel_function(np.ones(1))[0])
        return value if abs(value) > SMOOTH * self.approach else 0.0

    def evaluate_abel_function(self, t: Array) -> Array:
        """Evaluate the function G(t) of which the pressure is the Abel transform [length].

            p(a x) = (E*/π a) [G(1)/√(1-x²) - ∫ₓ¹ G'(t)/√(t²-x²) dt]

        p is the pressure at the radius a x, E* the contact modulus, a the contact radius.

        t  coordinates, from 0 at the axis to 1 at the contact edge (any shape)
        """
        changed = legendre.legval(t, all_order_coefficients(self.layers))
        return np.asarray(self.approach - self.profile.evaluate_abel(t) + changed)

    def abel_function_rate(self, t: Array) -> Array:
        """Evaluate the rate dG/dt of the function G of `evaluate_abel_function` [length].

        t  coordinates, from 0 at the axis to 1 at the contact edge (any shape)
        """
        changed = legendre.legval(t, legendre.legder(all_order_coefficients(self.layers)))
        return np.asarray(changed - evaluate_legendre(self.profile.rate, t))

    def wave_transform(self, waves: Waves) -> Array:
        """Compute the transform G~ = ∫₀¹ G(t) cos κt dt of the pressure at wavenumbers κ (κ,).

        G is the function of which the pressure is the Abel transform. (E* a/π) G~ is the Hankel
        transform of the pressure at the wavenumber κ/a, with the contact modulus E* and the contact
        radius a. Layers contribute to displacement and stress by this transform.

        waves  quadrature over dimensionless wavenumbers κ
        """
        bases = waves.even_transforms(len(self.layers))
        by_profile = waves.legendre_transform(self.profile.abel)
        return np.asarray(self.approach * bases[0] - by_profile + self.layers @ bases)


class _Galerkin:
    """Galerkin equations for the contribution of layers to the pressure of a frictionless contact.

    The contact radius is given. The pressure is the Abel transform of a function G = f + C on
    0 < t < 1. f is the part without layers. C is the contribution of the layers, a series of
    Legendre polynomials of even order with the unknown coefficients c_n.

    waves   quadrature over dimensionless wavenumbers κ
    count   number of coefficients c_n
    excess  contribution X - 1 of the layers to the normal response, relative to half-spaces, times
            the quadrature weights (κ,)
    """

    def __init__(self, waves: Waves, count: int, excess: Array) -> None:
        self.waves, self.count, self.excess = waves, count, excess
        self.bases = waves.even_transforms(count)
        self.scale = np.sqrt(4.0 * np.arange(count) + 1)

    @cached_property
    def cholesky_factor(self) -> Any:
        """Cholesky factor of the Galerkin matrix of the layer coefficients.

        The matrix is positive definite because the normal response of the bodies is positive. The
        unknowns are the Legendre coefficients of the contribution of the layers to the pressure.
        """
        kernel = np.zeros((self.count, self.count))
        for some in wave_blocks(len(self.excess), self.count):
            kernel += (self.bases[:, some] * self.excess[some]) @ self.bases[:, some].T
        matrix = np.eye(self.count) + 2 / pi * self.scale[:, None] * kernel * self.scale
        return cho_factor(matrix, lower=True, overwrite_a=True, check_finite=False)

    def solve_layer_coefficients(self, transform: Array) -> Array:
        """Solve for the Legendre coefficients of the contribution of layers to the pressure.

        The pressure is the Abel transform of G = f + C. The given function f is the part without
        layers: of the approach, or of the undeformed gap. C is the contribution of the layers,
        linear in f. The coefficients have the shape (count,).

        transform  cosine transform of f at the wavenumbers (κ,)
        """
        right = -2 / pi * self.scale * (self.bases @ (self.excess * transform))
        return np.asarray(self.scale * cho_solve(self.cholesky_factor, right, check_finite=False))

    def largest_error(self, layers: Array, transform: Array) -> float:
        """Compute the largest error of the contribution C of layers to the pressure [length].

        The pressure is the Abel transform of G = f + C, where f is the part without layers. The
        error is the difference between C and the integral over wavenumbers that defines it.

        layers     Legendre coefficients c_n of C (count,)
        transform  cosine transform of f at the wavenumbers (κ,)
        """
        polynomials, cosines = _check_point_functions(self.waves, self.count)
        exact = -2 / pi * (cosines @ (self.excess * (transform + layers @ self.bases)))
        return float(np.max(np.abs(polynomials @ layers - exact)))


@cache_within_bytes(MAX_CACHED)
def _check_point_functions(waves: Waves, count: int) -> tuple[Array, Array]:
    """Evaluate P_2n(t) (points, count) and cos κt (points, κ) at the points,
    evenly spaced between axis and edge, where the contact equation is checked."""
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
    """Solve the frictionless contact of bodies of revolution that has a prescribed contact radius.

    Without an approach, the pressure is zero at the contact edge, which determines the approach. At
    a rim of the indenter the approach is prescribed. The number of Legendre polynomials is doubled
    until the error of the contact equation is due to round-off.

    bodies    normal response of both bodies
    indenter  shape of the indenter
    radius    contact radius [length]
    approach  approach at a contact over the whole face up to a rim; None for a smooth edge [length]
    fineness  factor on the numbers of points and polynomials, 1 by default
    most      largest number of polynomials, for estimates with an error of a few percent; None
              without a limit
    raises    NotConverged if the equation cannot be solved to round-off, and errors of `profile`
    """
    shape = profile(indenter, radius, fineness)
    if not bodies.layered:
        depth = shape.abel_at_edge if approach is None else approach
        return Disc(bodies, shape, radius, depth, np.zeros(1), 0.0)
    count = polynomial_count(bodies.thickness / radius, shape.apex) * fineness
    count = min(count, most or count)
    waves = bodies.waves(radius, fineness=fineness)
    excess = waves.rule[1] * bodies.excess(waves, radius)
    by_profile = -waves.legendre_transform(shape.abel)
    best: Disc | None = None
    while True:
        method = _Galerkin(waves, count, excess)
        of_approach, of_profile = (
            method.solve_layer_coefficients(method.bases[0]),
            method.solve_layer_coefficients(by_profile),
        )
        if approach is None:  # G(1) = 0, where every P_2n is 1
            depth = float((shape.abel_at_edge - np.sum(of_profile)) / (1 + np.sum(of_approach)))
        else:
            depth = approach
        layers = depth * of_approach + of_profile
        residual = method.largest_error(layers, depth * method.bases[0] + by_profile)
        made = Disc(bodies, shape, radius, depth, layers, residual / (abs(depth) or 1.0))
        if most or residual <= ROUND_OFF * (abs(depth) + float(np.sum(np.abs(layers)))):
            return made
        if best is not None and made.residual > 0.5 * best.residual:
            return best
        best, count = made, 2 * count
        if count > 2 * MAX_ORDERS * fineness:
            raise NotConverged("the contact on a disc", count // 2, made.residual, ROUND_OFF)


def normal_stiffness(contact: Disc, indenter: ShapedBody, fineness: int = 1) -> float:
    """Compute the derivative dW/dδ of the normal force by the approach [force/length].

    It is that of a flat punch of the contact radius, because the pressure vanishes at a moving
    edge. At a constant radius the force is linear in the approach.

    contact   contact at a smooth edge or over the whole face of the indenter
    indenter  shape of the indenter
    fineness  factor on the numbers of points and polynomials, 1 by default
    """
    deeper = disc(contact.bodies, indenter, contact.radius, 2 * contact.approach, fineness)
    return (deeper.load - contact.load) / contact.approach


def polynomial_count(thickness: float, apex: bool) -> int:
    """Return the number of Legendre polynomials for the contribution of layers to the pressure.

    The contribution C(t) has singularities at t = ±1 ± 2ih/a (images of the edge in the underside
    of the layer) and, with an apex, at ±2ih/a. Their distance from the interval -1 < t < 1
    determines the rate of convergence. The number is a multiple of 8.

    thickness  thickness h of the outermost layer over the contact radius a [1]
    apex       true if the indenter has a tip on the axis
    raises     UnsupportedScene above `MAX_ORDERS` polynomials
    """
    image = (0 if apex else 1) + 2j * thickness
    ellipse = abs(image + (image - 1) ** 0.5 * (image + 1) ** 0.5)
    count = FEWEST_ORDERS * ceil(-log(ROUND_OFF) / (2 * log(ellipse)) / FEWEST_ORDERS)
    if count > MAX_ORDERS:
        raise UnsupportedScene(
            f"the contact radius is {1 / thickness:.3g} times the thickness of the outermost "
            f"layer, more than {MAX_ORDERS} polynomials resolve; {ELSEWHERE}"
        )
    return count
