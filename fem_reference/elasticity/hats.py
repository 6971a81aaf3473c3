"""Tractions that are linear between corner nodes: hat functions over the radius.

Displacements of the surface are quadratic on an element, tractions linear, and gap and slip are
tested with the same hats: no more conditions than the displacement can meet, so that the pressure
does not ripple and the matrix stays symmetric.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Matrix = NDArray[np.float64]

# Gauss points on an element: exact for the products below, and for smooth gaps to round-off.
POINTS = 6
SAME = 1e-9


@dataclass(frozen=True)
class Hats:
    """Hat functions φ of the corner nodes, and their products with the quadratic trace ψ.

    radii     (n,) of the corners
    products  ∫ ψ_i φ_j r dr (m, n) [length^2]
    weights   ∫ φ r dr (n,) [length^2]
    arms      ∫ φ r² dr (n,) [length^3]
    """

    radii: Field
    products: Matrix
    weights: Field
    arms: Field

    def compliance(self, nodal: Matrix) -> Matrix:
        """Displacements over the hats per traction at the corners, Mᵀ C M.

        nodal  displacement per generalised force at the nodes (m, m)
        """
        weak = self.products.T @ nodal @ self.products
        return np.asarray(weak)

    def of(self, function: Callable[[Field], Field]) -> Field:
        """∫ f φ r dr of a function of the radius."""
        r, weight = _gauss_points(self.radii)
        values = function(r) * r * weight
        left, right = _hats_at_points()
        integrals = np.zeros_like(self.radii)
        integrals[:-1] += values @ left
        integrals[1:] += values @ right
        return integrals


def hats_on(nodes: Field, reach: float = np.inf) -> Hats:
    """The hats on nodes (corner and midside alternating), out to the corner at `reach`.

    At the last corner half a hat is left: no traction reaches further.
    """
    corners = nodes[::2]
    count = int(np.count_nonzero(corners <= reach * (1 + SAME)))
    radii = corners[:count]
    r, weight = _gauss_points(radii)
    left, right = _hats_at_points()
    products = np.zeros((len(nodes), count))
    arms = np.zeros(count)
    for element in range(count - 1):
        measure = r[element] * weight[element]
        for corner, hat in ((element, left), (element + 1, right)):
            products[2 * element : 2 * element + 3, corner] += _quadratic() @ (measure * hat)
            arms[corner] += np.sum(measure * r[element] * hat)
    # Quadratics add up to one.
    return Hats(radii, products, products.sum(axis=0), arms)


def _unit_gauss() -> tuple[Field, Field]:
    x, w = np.polynomial.legendre.leggauss(POINTS)
    return 0.5 * (1 + x), 0.5 * w


def _gauss_points(radii: Field) -> tuple[Field, Field]:
    """Radii and weights (elements, points)."""
    x, w = _unit_gauss()
    width = np.diff(radii)[:, None]
    return radii[:-1, None] + width * x, width * w


def _hats_at_points() -> tuple[Field, Field]:
    x, _ = _unit_gauss()
    return 1 - x, x


def _quadratic() -> Matrix:
    """Inner corner, midside, outer corner at the points (3, points)."""
    x, _ = _unit_gauss()
    return np.array([(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)])
