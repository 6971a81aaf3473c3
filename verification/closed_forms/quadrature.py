"""Gauss quadrature rules for the closed-form contact solutions."""

from functools import cache

import numpy as np
from numpy.typing import NDArray


@cache
def unit_gauss(order: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return nodes and weights of the Gauss-Legendre rule on the interval from 0 to 1.

    order  number of nodes
    """
    nodes, weights = np.polynomial.legendre.leggauss(order)
    nodes, weights = (nodes + 1) / 2, weights / 2
    nodes.setflags(write=False)
    weights.setflags(write=False)
    return nodes, weights


def composite_gauss(
    bounds: NDArray[np.float64], order: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return nodes and weights of a Gauss-Legendre rule on each of several adjacent panels.

    bounds  ends of the panels, in ascending order
    order   number of nodes of a panel
    """
    nodes, weights = unit_gauss(order)
    widths = np.diff(bounds)[:, None]
    return (bounds[:-1, None] + widths * nodes).ravel(), (widths * weights).ravel()
