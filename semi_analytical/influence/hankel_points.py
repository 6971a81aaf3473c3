"""Wavenumbers at which a Hankel transform of a layered body's response is summed, and weights."""

from math import ceil, inf, log2

import numpy as np
from scipy.special import erfc

from contact_scene.array_types import Array

GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(16)
# Phase of the Bessel functions across one Gauss panel: 16 points integrate 16 rad to 1e-16.
PANEL_PHASE = 16.0
# Below this alpha r the surface's FRF is that of the base alone, even of one 1e12 times softer, and
# nothing is left of a stress; of a displacement at depth, 1e-12 on a base 1e6 times softer.
SMALLEST_PHASE = 1e-18
# The integrand is faded out around alpha r = FADE_CENTRE. What is cut off would have cancelled
# itself: the FRF is analytic in a sector about the real axis, so it does not answer to such
# distances at such short waves. Wide enough for poles 30 degrees off the axis, see the tests.
FADE_CENTRE, FADE_WIDTH = 96.0, 16.0


def hankel_points(r: float, limit: float) -> tuple[Array, Array]:
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


def faded_points(low: float, high: float, limit: float = inf) -> tuple[Array, Array]:
    """The same for distances from low to high, faded out where shorter waves do not matter.

    limit  where the integrand has died out by itself [1/length]
    """
    alpha, weight = hankel_points(high, min(limit, (FADE_CENTRE + 6 * FADE_WIDTH) / low))
    return alpha, weight * (erfc((alpha * low - FADE_CENTRE) / FADE_WIDTH) / 2)
