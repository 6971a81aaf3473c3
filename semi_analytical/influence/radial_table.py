"""Surface displacement by a point force on a layered body, as four functions of the distance.

The point solutions are Hankel transforms of the surface FRF,

    zz    K0 = 1/2pi  int  C22 J0(alpha r) alpha d alpha,
    mean  P  = 1/4pi  int (C11 + Csh) J0(alpha r) alpha d alpha,
    twist Q  = 1/4pi  int (C11 - Csh) J2(alpha r) alpha d alpha,
    cross C  = 1/2pi  int  C12 J1(alpha r) alpha d alpha,

with u_z = K0 p, u_x = (P - cos 2phi Q) q_x - sin 2phi Q q_y, u_z = cos phi C q_x.
They fall like 1/r near and far, with other constants, so r times them is tabulated: bounded, and
smooth in log r, which lets one table serve layers of very different thickness.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, log2, pi, sqrt

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.special import erfc, j0, j1

from semi_analytical.frf.stack import HalfSpace, Stack
from semi_analytical.frf.surface import SurfaceScalars, remainder_scalars, scalars

Array = NDArray[np.float64]

# Chebyshev nodes of one panel; with panels of ratio sqrt 2 the interpolation error stays below
# 1e-13 even where a stiff film on a thin incompressible layer makes the response wave (16: 3e-11).
NODES = 20
GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(16)
# Phase of the Bessel functions across one Gauss panel: 16 points integrate 16 rad to 1e-16.
PANEL_PHASE = 16.0
# Below this alpha r the FRF is that of the base alone, even of one 1e12 times softer.
SMALLEST_PHASE = 1e-18
# The integrand is faded out around alpha r = FADE_CENTRE. What is cut off would have cancelled
# itself: the FRF is analytic in a sector about the real axis, so it does not answer to such
# distances at such short waves. Wide enough for poles 30 degrees off the axis, see the tests.
FADE_CENTRE, FADE_WIDTH = 96.0, 16.0
# exp(-2 x) x^2 is below 1e-17 from here on: the remainder of the FRF has died out.
REMAINDER_REACH = 24.0


@dataclass(frozen=True)
class RadialTable:
    """r times the four radial functions (zz, mean, twist, cross) on 0 <= r <= edges[-1].

    edges         panel bounds [length], shape (panels + 1,), edges[0] = 0
    coefficients  Chebyshev coefficients, shape (panels, NODES, 4) [length^2/force]
    near          values at r = 0: the outer material's half-space, shape (4,)
    """

    edges: Array
    coefficients: Array
    near: Array

    @property
    def core(self) -> float:
        """Within this distance the response is the half-space's and a smooth remainder [length]."""
        return float(self.edges[1])

    def remainder(self) -> RadialTable:
        """Table of what the layers add to the outer material's half-space."""
        coefficients = self.coefficients.copy()
        coefficients[:, 0] -= self.near
        return RadialTable(self.edges, coefficients, np.zeros(4))

    def __call__(self, r: Array, functions: slice) -> Array:
        """Interpolate some of the functions at distances r, shape (len(r), functions)."""
        coefficients = self.coefficients[:, :, functions]
        values = np.empty((len(r), coefficients.shape[2]))
        panels = np.clip(np.searchsorted(self.edges, r) - 1, 0, len(self.coefficients) - 1)
        for panel in range(len(self.coefficients)):
            inside = np.flatnonzero(panels == panel)
            if not inside.size:
                continue
            low, high = self.edges[panel], self.edges[panel + 1]
            t = (2 * r[inside] - low - high) / (high - low)
            values[inside] = chebyshev.chebvander(t, NODES - 1) @ coefficients[panel]
        return values


def radial_table(stack: Stack, reach: float) -> RadialTable:
    """Tabulate a layered body's point response up to the distance `reach` [length].

    On the first panel, half the outermost thickness, it is the half-space's response plus the
    Hankel transform of the remainder; beyond, the transform of the whole FRF. So nothing is lost
    where a rigid or stiff base leaves a small part of the half-space's response.
    """
    near = half_space_response(stack.outer)
    if not stack.layers:
        return RadialTable(np.array([0.0, reach]), _constant(near), near)
    core = min(stack.layers[0].thickness / 2, reach)
    panels = max(0, ceil(2 * log2(reach / core)))
    edges = np.concatenate([[0.0], core * sqrt(2.0) ** np.arange(panels + 1)])
    values = np.empty((panels + 1, NODES, 4))
    for panel, (low, high) in enumerate(pairwise(edges)):
        r = (low + high) / 2 + (high - low) / 2 * _chebyshev_nodes()
        if panel == 0:
            alpha, weight = _wavenumbers(high, REMAINDER_REACH / stack.layers[0].thickness)
            values[panel] = near + _hankel(r, alpha, weight, remainder_scalars(stack, alpha))
        else:
            alpha, weight = _wavenumbers(high, (FADE_CENTRE + 6 * FADE_WIDTH) / low)
            weight *= erfc((alpha * low - FADE_CENTRE) / FADE_WIDTH) / 2
            values[panel] = _hankel(r, alpha, weight, scalars(stack, alpha))
    return RadialTable(edges, np.einsum("kn,pnf->pkf", _to_coefficients(), values), near)


def half_space_response(material: HalfSpace) -> Array:
    """r times (zz, mean, twist, cross) of a homogeneous half-space: constants."""
    G, nu = material
    return np.array([2 - 2 * nu, 2 - nu, -nu, 1 - 2 * nu]) / (4 * pi * G)


def _hankel(r: Array, alpha: Array, weight: Array, response: SurfaceScalars) -> Array:
    """r times the four Hankel transforms at distances r, shape (len(r), 4)."""
    c11, c12, c22, csh = response
    phase = np.outer(r, alpha)
    bessel0, bessel1 = j0(phase), j1(phase)
    bessel2 = 2 * bessel1 / phase - bessel0
    measure = alpha * weight
    zz = bessel0 @ (measure * c22) / (2 * pi)
    mean = bessel0 @ (measure * (c11 + csh)) / (4 * pi)
    twist = bessel2 @ (measure * (c11 - csh)) / (4 * pi)
    cross = bessel1 @ (measure * c12) / (2 * pi)
    transforms: Array = np.stack([zz, mean, twist, cross], axis=1)
    return r[:, None] * transforms


def _wavenumbers(r: float, limit: float) -> tuple[Array, Array]:
    """Gauss points and weights on (0, limit), fit for distances up to r.

    Panels double in width, because layers of any thickness act on their own scale of alpha, until
    the Bessel functions' phase asks for equal ones.
    """
    step = PANEL_PHASE / r
    first = SMALLEST_PHASE / r
    doublings = first * 2.0 ** np.arange(ceil(log2(step / first)) + 1)
    equal = np.arange(doublings[-1] + step, limit + step, step)
    bounds = np.concatenate([[0.0], doublings, equal])
    bounds = np.append(bounds[bounds < limit], limit)
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


def _constant(near: Array) -> Array:
    """Coefficients of one panel on which the functions do not vary."""
    coefficients = np.zeros((1, NODES, 4))
    coefficients[0, 0] = near
    return coefficients
