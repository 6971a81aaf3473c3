"""Gauss points of the contact edges, at which the penalty law acts on rings.

Three points on an edge resolve the overlap that quadratic displacements leave in the springs of the
law; two hat functions do not. The exact law cannot act there: the displacements cannot distinguish
the pressures of three points on an edge.
"""

from collections.abc import Callable

import numpy as np

from contact_scene.array_types import Field
from fem_reference.elasticity.hat_functions import TractionBasis, corners_under

POINTS_PER_EDGE = 3


class GaussPoints(TractionBasis):
    """Gauss points r_g with weights w_g r_g: the functions are one at a point, zero at others."""

    def of(self, function: Callable[[Field], Field]) -> Field:
        """Integrate f φ r dr for a function f of the radius."""
        return self.weights * function(self.radii)


def gauss_points(nodes: Field, reach: float = np.inf) -> GaussPoints:
    """Create Gauss points on every edge between Q2 nodes, up to the corner at `reach`.

    nodes  radii of corner and midside nodes in turn, corners first and last (m,) [length]
    """
    places, parts = np.polynomial.legendre.leggauss(POINTS_PER_EDGE)
    quadratic = np.array([places * (places - 1) / 2, 1 - places**2, places * (places + 1) / 2])
    edges = corners_under(nodes, reach) - 1
    half = (nodes[2::2] - nodes[:-1:2])[:edges, None] / 2
    radii = (nodes[1::2][:edges, None] + half * places).ravel()
    weights = (half * parts).ravel() * radii
    products = np.zeros((len(nodes), len(radii)))
    for edge in range(edges):
        at = slice(edge * POINTS_PER_EDGE, (edge + 1) * POINTS_PER_EDGE)
        products[2 * edge : 2 * edge + 3, at] = quadratic * weights[at]
    return GaussPoints(radii, products, weights, weights * radii)
