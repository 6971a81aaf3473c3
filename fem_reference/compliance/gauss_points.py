"""Gauss points of the element edges in contact, at which the penalty law acts on rings.

Three Gauss points on an edge resolve the overlap of the surfaces that the penalty springs permit
when displacements are quadratic. Two hat functions do not resolve it. The exact contact law cannot
act at Gauss points, because the displacements cannot distinguish the pressures of three points on
an edge.
"""

from collections.abc import Callable

import numpy as np

from contact_scene.array_types import Field
from fem_reference.elasticity.hat_functions import TractionBasis, corners_under

POINTS_PER_EDGE = 3
# Places of the points on an edge from -1 to 1, and their Gauss weights.
PLACES, PARTS = np.polynomial.legendre.leggauss(POINTS_PER_EDGE)


class GaussPoints(TractionBasis):
    """Traction basis of the penalty law: tractions concentrated on rings through Gauss points.

    The basis function of a ring of radius r_g is one at the ring and zero at all others. The
    integral of f over r dr is Σ f(r_g) w_g r_g with the Gauss weights w_g.
    """

    def integrate(self, function: Callable[[Field], Field]) -> Field:
        """Compute the integral of f(r) φ_g r dr for each Gauss-point function φ_g (points,).

        The basis function φ_g is one at its Gauss point and zero at all others, so that the
        integral is a product with the Gauss weight.

        function  f, a function of an array of radii, such as the undeformed gap
        """
        return self.weights * function(self.radii)


def gauss_points(nodes: Field, reach: float = np.inf, power: int = 1) -> GaussPoints:
    """Create the basis of tractions at the Gauss points of all surface edges of elements.

    Each edge in the contact zone has POINTS_PER_EDGE points. Used for the penalty law.

    nodes  radii of corner and midside nodes, alternating; first and last are corners (m,) [length]
    reach  outer radius of the tractions, rounded down to a corner [length]
    power  power of r in the integrals: 1, and 0 in plane strain
    """
    quadratic = np.array([PLACES * (PLACES - 1) / 2, 1 - PLACES**2, PLACES * (PLACES + 1) / 2])
    edges = corners_under(nodes, reach) - 1
    half = (nodes[2::2] - nodes[:-1:2])[:edges, None] / 2
    radii = (nodes[1::2][:edges, None] + half * PLACES).ravel()
    weights = (half * PARTS).ravel() * radii**power
    products = np.zeros((len(nodes), len(radii)))
    for edge in range(edges):
        at = slice(edge * POINTS_PER_EDGE, (edge + 1) * POINTS_PER_EDGE)
        products[2 * edge : 2 * edge + 3, at] = quadratic * weights[at]
    return GaussPoints(radii, products, weights, weights * radii, power)


def loading_part(radii: Field, tractions: Field, power: int = 1) -> Field:
    """Return the part of tractions at Gauss points that loads the surface nodes (n,).

    Three points of an edge load two nodes, as one corner belongs to the adjacent edge. Tractions
    that load no node do not deform the body. They oscillate from point to point, most of all with a
    stiff penalty. The other part is the projection on the quadratic functions of the displacements.

    radii      radii of the Gauss points of adjacent edges (n,) [length]
    tractions  one component of the tractions at the points (n,)
    power      power of r in the integrals: 1, and 0 in plane strain
    """
    middles = radii[POINTS_PER_EDGE // 2 :: POINTS_PER_EDGE]
    half = (radii[POINTS_PER_EDGE - 1 :: POINTS_PER_EDGE] - middles) / PLACES[-1]
    nodes = np.append(np.ravel([middles - half, middles], order="F"), middles[-1] + half[-1])
    basis = gauss_points(nodes, power=power)
    traces = (basis.products / basis.weights).T
    return traces @ np.linalg.solve(basis.products @ traces, basis.products @ tractions)
