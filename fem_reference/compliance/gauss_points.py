"""Gauss points of the element edges in contact, at which the penalty law acts on rings.

Three Gauss points on an edge resolve the overlap of the surfaces that the penalty springs permit
when displacements are quadratic. Two hat functions do not resolve it. For displacements of the
degree k there are k + 1 points. The exact contact law cannot act at Gauss points, because the
displacements cannot distinguish the pressures of all points on an edge.
"""

from collections.abc import Callable

import numpy as np
from numpy.polynomial.polynomial import polyval

from contact_scene.array_types import Field
from fem_reference.elasticity.hat_functions import TractionBasis, corners_under
from fem_reference.mesh.element_order import ELEMENTS

DEGREE = ELEMENTS.degree
POINTS_PER_EDGE = DEGREE + 1
# Places of the points on an edge from -1 to 1, and their Gauss weights.
PLACES, PARTS = np.polynomial.legendre.leggauss(POINTS_PER_EDGE)
# Places of the nodes, and values of their trace functions at the points (nodes, points).
NODES = 2 * ELEMENTS.places - 1
TRACES = polyval(PLACES, np.linalg.inv(np.vander(NODES, increasing=True)))


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

    nodes  radii of all nodes on the surface, the first and the last at corners (m,) [length]
    reach  outer radius of the tractions, rounded down to a corner [length]
    power  power of r in the integrals: 1, and 0 in plane strain
    """
    edges = corners_under(nodes, reach) - 1
    half = np.diff(nodes[::DEGREE])[:edges, None] / 2
    radii = (_middles(nodes, DEGREE)[:edges, None] + half * PLACES).ravel()
    weights = (half * PARTS).ravel() * radii**power
    products = np.zeros((len(nodes), len(radii)))
    for edge in range(edges):
        at = slice(edge * POINTS_PER_EDGE, (edge + 1) * POINTS_PER_EDGE)
        products[DEGREE * edge : DEGREE * (edge + 1) + 1, at] = TRACES * weights[at]
    return GaussPoints(radii, products, weights, weights * radii, power)


def loading_part(radii: Field, tractions: Field, power: int = 1) -> Field:
    """Return the part of tractions at Gauss points that loads the surface nodes (n,).

    An edge has one point more than nodes, as one corner belongs to the adjacent edge. Tractions
    that load no node do not deform the body. They oscillate from point to point, most of all with a
    stiff penalty. The other part is the projection on the trace functions of the displacements.

    radii      radii of the Gauss points of adjacent edges (n,) [length]
    tractions  one component of the tractions at the points (n,)
    power      power of r in the integrals: 1, and 0 in plane strain
    """
    middles = _middles(radii, POINTS_PER_EDGE)
    half = (radii[POINTS_PER_EDGE - 1 :: POINTS_PER_EDGE] - middles) / PLACES[-1]
    inner = middles[:, None] + half[:, None] * NODES[:-1]
    nodes = np.append(inner, middles[-1] + half[-1])
    basis = gauss_points(nodes, power=power)
    traces = (basis.products / basis.weights).T
    return traces @ np.linalg.solve(basis.products @ traces, basis.products @ tractions)


def _middles(radii: Field, every: int) -> Field:
    """Compute the middles of edges from the radii of nodes or points, `every` for each edge."""
    after = radii[POINTS_PER_EDGE // 2 :: every]
    return (radii[(POINTS_PER_EDGE - 1) // 2 :: every][: len(after)] + after) / 2
