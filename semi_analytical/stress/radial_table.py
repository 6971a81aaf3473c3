"""The radial functions of the fields at some depths, tabulated over the distance.

What is tabulated is smooth: in the outermost layer only what the layers add to the half-space of
its material, which acts like images no closer than 2h - z, and below it everything, from no closer
than z. This clearance is the length on which the functions vary near the axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import pi

import numpy as np
from numpy.typing import NDArray
from scipy.special import j0, j1

from semi_analytical.frf.depth import Descent, Level, in_plane, material_at, remainder_at_depth
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.hankel_points import faded_points, hankel_points
from semi_analytical.influence.radial_panels import (
    coefficients_of,
    interpolated,
    nodes_between,
    panel_edges,
    places_on_panels,
)
from semi_analytical.stress.radial_functions import ORDERS, integrands

Array = NDArray[np.float64]

# exp(-alpha d) (alpha d)^2 is below 1e-17 from here on.
REACH = 48.0


@dataclass(frozen=True)
class DepthTable:
    """Radial functions at some levels on 0 <= r <= edges[-1].

    edges         panel bounds [length], shape (panels + 1,), edges[0] = 0
    coefficients  Chebyshev coefficients, shape (levels, panels, NODES, functions)
    """

    edges: Array
    coefficients: Array

    def at(self, level: int, r: Array) -> Array:
        """The functions at distances r at one of the levels, shape (functions, len(r))."""
        coefficients = self.coefficients[level]
        values = np.empty((coefficients.shape[2], len(r)))
        for panel, inside, place in places_on_panels(self.edges, r):
            values[:, inside] = interpolated(coefficients[panel], place)
        return values


def clearance(stack: Stack, level: Level) -> float:
    """Distance of the nearest source of what is tabulated at a level [length]."""
    if level.layer == 0:
        return 2 * stack.layers[0].thickness - level.depth
    return level.depth


def depth_table(stack: Stack, levels: tuple[Level, ...], reach: float) -> DepthTable:
    """Tabulate the fields of a layered body at some levels up to the distance `reach` [length]."""
    nearest = min(clearance(stack, level) for level in levels)
    edges = panel_edges(min(nearest / 2, reach), reach)
    values = []
    for panel, (low, high) in enumerate(pairwise(edges)):
        died_out = REACH / nearest
        points = faded_points(low, high, died_out) if panel else hankel_points(high, died_out)
        values.append(_transforms(stack, levels, nodes_between(low, high), *points))
    return DepthTable(edges, coefficients_of(np.stack(values, axis=1)))


def _transforms(
    stack: Stack, levels: tuple[Level, ...], r: Array, alpha: Array, weight: Array
) -> Array:
    """Hankel transforms at distances r, shape (levels, len(r), functions)."""
    descent = Descent(stack, alpha)
    sources = np.stack([_integrands(descent, level) for level in levels])
    sources *= alpha * weight / (2 * pi)
    values = np.empty((len(levels), len(r), len(ORDERS)))
    for order, bessel in enumerate(_bessel(np.outer(r, alpha))):
        chosen = [k for k, of in enumerate(ORDERS) if of == order]
        values[:, :, chosen] = np.einsum("ra,lfa->lrf", bessel, sources[:, chosen], optimize=True)
    return values


def _integrands(descent: Descent, level: Level) -> Array:
    stack, alpha = descent.stack, descent.alpha
    if level.layer == 0:
        fields = remainder_at_depth(stack, alpha, level.depth)
    else:
        fields = descent.at(level)
    return integrands(fields, in_plane(fields, material_at(stack, level), alpha))


def _bessel(x: Array) -> tuple[Array, Array, Array, Array]:
    """J_0 to J_3. The recurrence cancels for small x, where the measure alpha d alpha vanishes."""
    first, second = j0(x), j1(x)
    third = 2 * second / x - first
    return first, second, third, 4 * third / x - second
