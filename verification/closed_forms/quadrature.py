"""Gauss rules of the closed forms."""

from functools import cache

import numpy as np
from numpy.typing import NDArray


@cache
def unit_gauss(order: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Nodes and weights with sum(weights * f(nodes)) = integral of f from 0 to 1."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    nodes, weights = (nodes + 1) / 2, weights / 2
    nodes.setflags(write=False)
    weights.setflags(write=False)
    return nodes, weights
