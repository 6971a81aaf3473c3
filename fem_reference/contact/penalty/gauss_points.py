"""Gauss points of the contact edges, where the penalty model has its tractions."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

POINTS_PER_EDGE = 3


@dataclass(frozen=True)
class GaussPoints:
    """Points on the surface with their share of area and the displacement they see.

    radii    r_g, ascending (n,) [length]
    weights  w_g r_g (n,) [length^2]: ∫ f r dr = Σ weights f
    trace    ψ_i(r_g) of the Q2 nodes (n, m) [1]: u(r_g) = trace u
    """

    radii: Field
    weights: Field
    trace: Field


def gauss_points(nodes: Field, per_edge: int = POINTS_PER_EDGE) -> GaussPoints:
    """Gauss points of every edge between Q2 nodes.

    nodes  radii of corner and midside nodes in turn, corners first and last (m,) [length]
    """
    places, parts = np.polynomial.legendre.leggauss(per_edge)
    quadratic = np.array([places * (places - 1) / 2, 1 - places**2, places * (places + 1) / 2])
    edges = (len(nodes) - 1) // 2
    half = (nodes[2::2] - nodes[:-1:2]) / 2
    radii = (nodes[1::2, None] + half[:, None] * places).ravel()
    trace = np.zeros((edges * per_edge, len(nodes)))
    for edge in range(edges):
        at = slice(edge * per_edge, (edge + 1) * per_edge)
        trace[at, 2 * edge : 2 * edge + 3] = quadratic.T
    return GaussPoints(radii, (half[:, None] * parts).ravel() * radii, trace)
