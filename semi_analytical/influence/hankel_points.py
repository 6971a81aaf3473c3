"""Quadrature points and weights for Hankel transforms of the response of a layered body."""

from math import ceil, inf, log2

import numpy as np
from scipy.special import erfc

from contact_scene.array_types import Array

GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(16)
# Phase of the Bessel functions across one Gauss panel: 16 points integrate 16 rad to 1e-16.
PANEL_PHASE = 16.0
# Below this alpha r the surface FRF is that of the base alone, even of a base 1e12 times softer.
# The neglected stress is zero in double precision; the neglected displacement at depth is 1e-12 on
# a base 1e6 times softer.
SMALLEST_PHASE = 1e-18
# The integrand is multiplied by a window that falls around alpha r = FADE_CENTRE. The integral
# beyond cancels, because the FRF is analytic in a sector about the real axis. The width suffices
# for poles 30 degrees off the axis (see the tests).
FADE_CENTRE = 96.0
FADE_WIDTH = 16.0


def hankel_points(r: float, limit: float) -> tuple[Array, Array]:
    """Return Gauss points and weights for Hankel transforms on the wavenumbers 0 < alpha < limit.

    The transforms yield the response of a layered body to a point force. Panels double in width, so
    that layers of all thicknesses are resolved. Beyond PANEL_PHASE / r they have equal widths,
    which resolve the Bessel functions.

    r      largest distance from the force [length]
    limit  largest wavenumber [1/length]
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


def faded_points(low: float, high: float, limit: float = inf) -> tuple[Array, Array]:
    """Return quadrature points and weights for Hankel transforms at distances that are not zero.

    The transforms yield the response of a layered body to a point force. A smooth window removes
    wavenumbers that are large compared with the inverse of the smallest distance.

    low, high  smallest and largest distance from the force [length]
    limit      wavenumber beyond which the integrand is zero [1/length]
    """
    alpha, weight = hankel_points(high, min(limit, (FADE_CENTRE + 6 * FADE_WIDTH) / low))
    return alpha, weight * (erfc((alpha * low - FADE_CENTRE) / FADE_WIDTH) / 2)
