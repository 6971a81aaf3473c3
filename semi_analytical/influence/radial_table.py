"""Tables of radial functions of the response of a layered body to a point force.

The functions depend on the distance from the force. They are interpolated by Chebyshev polynomials
on panels of the distance. The first panel begins at the force. The bounds of the others grow by the
factor sqrt(2), so that powers of the distance are equally smooth on each panel.
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, log2, pi, sqrt

import numpy as np

from contact_scene.array_types import Array
from semi_analytical.influence.hankel_points import faded_points, hankel_points

# Chebyshev nodes of one panel. The interpolation error is below 1e-13 also for the oscillating
# response of a stiff film on a thin incompressible layer (3e-11 with 16 nodes).
NODES = 20
AT_ONCE = 1 << 11  # number of places at a time, limited by the processor cache
# Value of alpha d above which exp(-alpha d) (alpha d)^2 is below 1e-17.
LARGEST_PHASE = 48.0

Transforms = Callable[[Array, Array, Array], Array]


@dataclass(frozen=True)
class RadialTable:
    """Table of several functions of the distance r from a point force, on 0 <= r <= edges[-1].

    The functions are displacements or stresses of a layered body.

    edges         panel bounds, edges[0] = 0, shape (panels + 1,) [length]
    coefficients  Chebyshev coefficients, shape (panels, NODES, functions)
    """

    edges: Array
    coefficients: Array

    def __call__(self, r: Array) -> Array:
        """Interpolate the tabulated functions at distances from the point force; shape (functions,
        n).

        r  distances from the force (n,) [length]
        """
        panels = np.clip(np.searchsorted(self.edges, r) - 1, 0, len(self.edges) - 2)
        values = np.empty((self.coefficients.shape[2], len(r)))
        for panel in np.flatnonzero(np.bincount(panels)):
            inside = np.flatnonzero(panels == panel)
            low, high = self.edges[panel], self.edges[panel + 1]
            place = (2 * r[inside] - low - high) / (high - low)
            for start in range(0, len(place), AT_ONCE):
                some = slice(start, start + AT_ONCE)
                values[:, inside[some]] = self.coefficients[panel].T @ _chebyshev_polynomials(
                    place[some]
                )
        return values


def tabulate(transforms: Transforms, clearance: float, reach: float) -> tuple[Array, Array]:
    """Tabulate functions of the distance from a point force, given as Hankel transforms.

    Return the panel bounds (panels + 1,) and the Chebyshev coefficients (..., panels, NODES,
    functions).

    transforms  function of distances (n,), wavenumbers and quadrature weights that returns the
                Hankel transforms (..., n, functions)
    clearance   distance d of the force from the nearest singularity of the functions [length]; the
                integrands fall like exp(-alpha d) with the wavenumber alpha
    reach       largest distance of the table [length]
    """
    core, limit = min(clearance / 2, reach), LARGEST_PHASE / clearance
    panels = max(0, ceil(2 * log2(reach / core)))
    edges = np.concatenate([[0.0], core * sqrt(2.0) ** np.arange(panels + 1)])
    on_unit = np.cos((np.arange(NODES) + 0.5) * pi / NODES)
    values = []
    for low, high in pairwise(edges):
        nodes = (low + high) / 2 + (high - low) / 2 * on_unit
        points = faded_points(low, high, limit) if low else hankel_points(high, limit)
        values.append(transforms(nodes, *points))
    k = np.arange(NODES)
    matrix = 2 / NODES * np.cos(np.outer(k, (k + 0.5) * pi / NODES))
    matrix[0] /= 2
    return edges, np.asarray(np.einsum("kn,...nf->...kf", matrix, np.stack(values, axis=-3)))


def _chebyshev_polynomials(place: Array) -> Array:
    """Evaluate the first NODES Chebyshev polynomials T_k at n positions in one panel (NODES, n).

    The recursion T_{m+k} = 2 T_m T_k - T_{m-k} doubles the number of polynomials in each step.

    place  positions between the ends of the panel, from -1 to 1 (n,)
    """
    found = np.empty((NODES, len(place)))
    found[0], found[1] = 1.0, place
    known = 2
    while known < NODES:
        last = known - 1
        more = found[known : known + last]
        np.multiply(2 * found[last], found[1 : 1 + len(more)], out=more)
        more -= found[:last][::-1][: len(more)]
        known += len(more)
    return found
