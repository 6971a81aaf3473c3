"""Order of the finite elements: all that depends on the degree of their displacements.

A further order is another record. All elements have the order `ELEMENTS`.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import permutations
from math import sqrt

import numpy as np
from skfem import ElementLineP2, ElementQuad2
from skfem.element import Element

from contact_scene.array_types import Field


@dataclass(frozen=True)
class ElementOrder:
    """Finite elements whose displacements have one degree k in each direction.

    The nodes of an edge divide it into k equal parts. The volume strain of an element is projected
    onto polynomials of the degree k - 1 in r and z together, which is exact for displacements of
    the degree k and prevents locking.

    degree    k
    element   scikit-fem element of one displacement component
    trace     scikit-fem element of its values on an edge
    strains   places on a side from 0 to 1 at which strains are most accurate, in both directions
    recovery  description of the stress recovery from these places, for files
    beyond    correction of the polynomial that locates the contact edge (see `ring_edge`), for
              square elements: rows are powers of the ratio, columns powers of Poisson's ratio
    kind      type of the cells that represent an element in files
    cells     nodes of each of these cells, as numbers of the nodes of the element
    """

    degree: int
    element: Element
    trace: Element
    strains: tuple[float, ...]
    recovery: str
    beyond: tuple[tuple[float, ...], ...]
    kind: str
    cells: tuple[tuple[int, ...], ...]

    @cached_property
    def places(self) -> Field:
        """Places of the nodes on an edge from 0 to 1 (k + 1,)."""
        return np.linspace(0.0, 1.0, self.degree + 1)

    @cached_property
    def pressures(self) -> tuple[tuple[int, int], ...]:
        """Exponents of r and z in the polynomials onto which the volume strain is projected."""
        totals = range(self.degree)
        return tuple((total - i, i) for total in totals for i in range(total + 1))

    def nodes(self, corners: Field) -> Field:
        """Compute the coordinates of all nodes on a mesh line from those of the corners.

        corners  ascending coordinates of the corners
        """
        at = self.places[:-1]
        return np.append(corners[:-1, None] * (1.0 - at) + corners[1:, None] * at, corners[-1])


def lagrange_polynomials(known: Field, wanted: Field) -> Field:
    """Evaluate the polynomials that are one at one known coordinate and zero at the others (n, p).

    known   coordinates of p points, common (p,) or for each wanted coordinate (n, p)
    wanted  coordinates at which the polynomials are evaluated (n,)
    """
    points = known.shape[-1]
    values = np.ones((len(wanted), points))
    for k, other in permutations(range(points), 2):
        values[:, k] *= (wanted - known[..., other]) / (known[..., k] - known[..., other])
    return values


# Strains are most accurate at 2 x 2 Gauss points (Barlow 1976). The correction at the contact edge
# is extrapolated from Hertz contacts with 36 and 72 elements per contact radius, with an error of
# 3e-4.
BIQUADRATIC = ElementOrder(
    degree=2,
    element=ElementQuad2(),
    trace=ElementLineP2(),
    strains=(0.5 - 0.5 / sqrt(3.0), 0.5 + 0.5 / sqrt(3.0)),
    recovery=(
        "stress at the 2 x 2 Gauss points, interpolated to the nodes of one material by cubic "
        "polynomials; by linear ones, with the mean of both sides, between elements of unlike size"
    ),
    beyond=(
        (0.0173, -0.0439, -0.0072),
        (-0.0019, 0.0013, 0.0011),
        (-0.0400, 0.1039, 0.0294),
        (-0.0103, 0.0235, 0.0361),
    ),
    kind="quad9",
    cells=((0, 1, 2, 3, 4, 5, 6, 7, 8),),
)
ELEMENTS = BIQUADRATIC
"""Order of all elements."""
