"""The radial functions of the fields at some depths, tabulated over the distance.

What is tabulated is smooth: in the outermost layer only what the layers add to the half-space of
its material, which acts like images no closer than 2h - z, and below it everything, from no closer
than z. This clearance is the length on which the functions vary near the axis.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, log2, pi, sqrt

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.special import erfc, j0, j1

from semi_analytical.frf.depth import Descent, Level, in_plane, material_at, remainder_at_depth
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.radial_table import FADE_CENTRE, FADE_WIDTH, PANEL_PHASE
from semi_analytical.stress.radial_functions import ORDERS, integrands

Array = NDArray[np.float64]

NODES = 20
GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(16)
# exp(-alpha d) (alpha d)^2 is below 1e-17 from here on.
REACH = 48.0
# Below this alpha r nothing is left of a stress; of a displacement, 1e-12 on a base 1e6 times
# softer than the layers.
SMALLEST_PHASE = 1e-18


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
        panels = np.clip(np.searchsorted(self.edges, r) - 1, 0, len(coefficients) - 1)
        for panel in np.unique(panels):
            inside = np.flatnonzero(panels == panel)
            low, high = self.edges[panel], self.edges[panel + 1]
            t = (2 * r[inside] - low - high) / (high - low)
            values[:, inside] = coefficients[panel].T @ chebyshev.chebvander(t, NODES - 1).T
        return values


def clearance(stack: Stack, level: Level) -> float:
    """Distance of the nearest source of what is tabulated at a level [length]."""
    if level.layer == 0:
        return 2 * stack.layers[0].thickness - level.depth
    return level.depth


def depth_table(stack: Stack, levels: tuple[Level, ...], reach: float) -> DepthTable:
    """Tabulate the fields of a layered body at some levels up to the distance `reach` [length]."""
    nearest = min(clearance(stack, level) for level in levels)
    core = min(nearest / 2, reach)
    panels = max(0, ceil(2 * log2(reach / core)))
    edges = np.concatenate([[0.0], core * sqrt(2.0) ** np.arange(panels + 1)])
    values = np.empty((len(levels), panels + 1, NODES, len(ORDERS)))
    for panel, (low, high) in enumerate(pairwise(edges)):
        r = (low + high) / 2 + (high - low) / 2 * _chebyshev_nodes()
        fade_end = (FADE_CENTRE + 6 * FADE_WIDTH) / low if panel else np.inf
        alpha, weight = _wavenumbers(high, min(REACH / nearest, fade_end))
        if panel:
            # What is cut off would have cancelled itself, see influence/radial_table.py.
            weight *= erfc((alpha * low - FADE_CENTRE) / FADE_WIDTH) / 2
        values[:, panel] = _transforms(stack, levels, r, alpha, weight)
    return DepthTable(edges, np.einsum("kn,lpnf->lpkf", _to_coefficients(), values))


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


def _wavenumbers(r: float, limit: float) -> tuple[Array, Array]:
    """Gauss points and weights on (0, limit), fit for distances up to r.

    Panels double in width, for layers of any thickness, until the phase asks for equal ones.
    """
    step = min(PANEL_PHASE / r, limit)
    doublings = step / 2.0 ** np.arange(ceil(log2(PANEL_PHASE / SMALLEST_PHASE)), -1, -1)
    equal = np.arange(step, limit, step)[1:]
    bounds = np.concatenate([[0.0], doublings, equal, [limit]])
    middle, half = (bounds[1:] + bounds[:-1]) / 2, np.diff(bounds) / 2
    alpha = (middle[:, None] + half[:, None] * GAUSS_NODES).ravel()
    return alpha, (half[:, None] * GAUSS_WEIGHTS).ravel()


def _chebyshev_nodes() -> Array:
    return np.cos((np.arange(NODES) + 0.5) * pi / NODES)


def _to_coefficients() -> Array:
    """Matrix from values at the Chebyshev nodes to Chebyshev coefficients."""
    k = np.arange(NODES)
    matrix: Array = 2 / NODES * np.cos(np.outer(k, (k + 0.5) * pi / NODES))
    matrix[0] /= 2
    return matrix
