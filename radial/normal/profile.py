"""Undeformed gap of a body of revolution over a contact, and its Abel transform S."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial import chebyshev, legendre

from contact_scene.array_types import Array
from contact_scene.solver_errors import UnsupportedScene
from radial.response.quadrature import (
    evaluate_legendre,
    unit_gauss,
)

if TYPE_CHECKING:
    from contact_scene.geometry import ShapedBody


# least and largest number of points at which the gap is evaluated
FEWEST = 16
MOST = 2048
# Round-off of a coefficient of the gap over the largest coefficient, divided by the number of
# points.
ROUND_OFF = 1e-15
ANGLES = 16
# A gap with breaks: number of even Legendre polynomials of S, points of the gap between two breaks,
# and quadrature points between two breaks.
PIECEWISE_ORDERS = 128
PIECE = 8
PIECE_ANGLES = 8


@dataclass(frozen=True)
class Profile:
    """Undeformed gap f between the surfaces over a contact of radius a, by its Abel transform S.

        S(t) = t ∫₀^(π/2) f'(t sin φ) dφ

    f' is the derivative with respect to r/a. The coordinate t runs from 0 at the axis to 1 at the
    contact edge. The pressure between half-spaces is the Abel transform of δ - S with the approach
    δ (Sneddon 1965).

    abel  coefficients of S(t) in Legendre polynomials of 2t - 1 [length]
    apex  true if the gap has a nonzero slope at the axis, where the pressure is infinite
    """

    abel: Array
    apex: bool

    def evaluate_abel(self, t: Array) -> Array:
        """Evaluate the Abel transform S of the undeformed gap f between the surfaces [length].

            S(t) = t ∫₀^(π/2) f'(t sin φ) dφ

        f' is the derivative with respect to r/a, with the contact radius a.

        t  coordinates, from 0 at the axis to 1 at the contact edge (any shape)
        """
        return evaluate_legendre(self.abel, t)

    @property
    def abel_at_edge(self) -> float:
        """Abel transform S(1) of the undeformed gap at the contact edge [length].

        S(1) is the approach at which the pressure between half-spaces is zero at the contact edge.
        """
        return float(np.sum(self.abel))

    @cached_property
    def rate(self) -> Array:
        """Legendre coefficients of the rate dS/dt of the gap's Abel transform S.

        S(t) is the Abel transform of the undeformed gap, with t from 0 at the axis to 1 at the
        contact edge. The polynomials have the argument 2t - 1. The unit of the coefficients is
        [length].
        """
        return np.asarray(2 * legendre.legder(self.abel))


def profile(indenter: ShapedBody, radius: float, fineness: int = 1) -> Profile:
    """Compute the Abel transform of the undeformed gap of an indenter over a contact disc.

    The Abel transform determines the pressure. The gap is interpolated at Chebyshev points. Their
    number is doubled until the last coefficients are round-off. A gap with breaks is interpolated
    between its breaks, and the Abel transform is fitted by a fixed number of polynomials.

    indenter  shape of the indenter
    radius    contact radius [length]
    fineness  factor on the number of points, 1 by default
    raises    UnsupportedScene if the gap is not a smooth function of the radius
    """
    breaks = indenter.breaks[(indenter.breaks > 0) & (indenter.breaks < radius)]
    if len(breaks):
        return _piecewise_profile(indenter, radius, [0.0, *breaks / radius, 1.0], fineness)
    count = FEWEST
    while True:
        gap = _fit_gap(indenter, radius, count)
        significant = np.flatnonzero(np.abs(gap) > ROUND_OFF * count * np.max(np.abs(gap)))
        if not len(significant):
            return Profile(np.zeros(2), False)
        if significant[-1] < 3 * count // 4:
            break
        count *= 2
        if count > MOST:
            raise UnsupportedScene(
                f"the gap over a contact of radius {radius:.4g} m is not a smooth function of the "
                "distance from the axis, as this solver requires; solve it with the "
                "semi-analytical solver"
            )
    if fineness > 1:
        gap = _fit_gap(indenter, radius, count * fineness)
    slope = 2 * chebyshev.chebder(gap[: significant[-1] + 1])
    at_axis = float(chebyshev.chebval(-1.0, slope))
    return Profile(
        slope @ _abel_matrix(len(slope), fineness),
        abs(at_axis) > 1e-6 * float(np.sum(np.abs(slope))),
    )


def _piecewise_profile(
    indenter: ShapedBody, radius: float, ends: Sequence[float], fineness: int
) -> Profile:
    """Compute the Abel transform of a gap that is smooth between its breaks.

    The integral over φ is divided where t sin φ is a break. The gap is even at the axis, and so is
    S. It is therefore fitted by even polynomials: a slope of S at the axis would be an infinite
    pressure. S has a singularity (t - b)^(3/2) above a break b of the curvature, so that its series
    decreases slowly. The last coefficient makes S exact at the contact edge, which determines the
    approach. The error of the series is part of the error estimate, which compares two numbers of
    polynomials.

    indenter  shape of the indenter
    radius    contact radius [length]
    ends      ends of the smooth intervals over the contact radius, from 0 to 1
    fineness  factor on the number of orders, 1 by default
    """
    count = PIECEWISE_ORDERS * fineness
    inner, weights = unit_gauss(2 * count)
    t = np.append(inner, 1.0)
    angles, shares = unit_gauss(PIECE_ANGLES)
    integral = np.zeros_like(t)
    places, fit = _chebyshev_fit(PIECE)
    for low, high in pairwise(ends):
        gap = fit @ indenter.initial_gap(radius * (low + (high - low) * places), 0.0)
        slope = 2.0 / (high - low) * chebyshev.chebder(gap)
        above = t > low
        first, last = (np.arcsin(np.minimum(end / t[above], 1.0)) for end in (low, high))
        x = t[above, None] * np.sin(first[:, None] + (last - first)[:, None] * angles)
        values = chebyshev.chebval(2.0 * (x - low) / (high - low) - 1.0, slope)
        integral[above] += (last - first) * (values @ shares)
    even = legendre.legvander(inner, 2 * count - 2)[:, ::2]
    fitted = (4 * np.arange(count) + 1) * ((weights * inner * integral[:-1]) @ even)
    fitted[-1] += integral[-1] - np.sum(fitted)
    orders = np.arange(2 * count - 1)
    by_order = (2 * orders + 1) * legendre.legvander(2 * inner - 1, orders[-1])
    return Profile((weights * (even @ fitted)) @ by_order, apex=False)


def _fit_gap(indenter: ShapedBody, radius: float, count: int) -> Array:
    """Fit a Chebyshev series in 2r/a - 1 to the undeformed gap,
    with a = `radius` (count,) [length]."""
    places, fit = _chebyshev_fit(count)
    return np.asarray(fit @ indenter.initial_gap(radius * places, 0.0))


@cache
def _chebyshev_fit(count: int) -> tuple[Array, Array]:
    """Return Chebyshev points on 0 < x < 1, and the matrix (count, count)
    from values at them to the coefficients of polynomials of 2x - 1."""
    points = chebyshev.chebpts1(count)
    fit = chebyshev.chebvander(points, count - 1).T * (2.0 / count)
    fit[0] /= 2
    return (1 + points) / 2, np.asarray(fit, dtype=float)


@cache
def _abel_matrix(count: int, fineness: int) -> Array:
    """Compute the matrix (count, count + 1) from the slope f' of the gap to its Abel transform S.

        S(t) = t ∫₀^(π/2) f'(t sin φ) dφ

    f' has Chebyshev coefficients (count,) in 2x - 1, with x = r/a. S has Legendre coefficients
    (count + 1,) in 2t - 1. A row of coefficients of f' is multiplied from the left.
    """
    t, weights = unit_gauss(count + 1)
    angles, shares = unit_gauss((ANGLES + count) * fineness)
    places = np.multiply.outer(t, np.sin(np.pi / 2 * angles))
    waves = np.einsum("tac,a->tc", chebyshev.chebvander(2 * places - 1, count - 1), shares)
    by_order = (2 * np.arange(count + 1) + 1) * legendre.legvander(2 * t - 1, count)
    return np.asarray(np.einsum("t,tc,tl->cl", np.pi / 2 * weights * t, waves, by_order))
