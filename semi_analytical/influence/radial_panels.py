"""Chebyshev interpolation of functions of the distance from a point force on panels.

The first panel begins at the force. The bounds of the others grow by the factor sqrt(2), so that
powers of the distance are equally smooth on each panel.
"""

from collections.abc import Iterator
from math import ceil, log2, pi, sqrt

import numpy as np

from contact_scene.array_types import Array, Indices

# Chebyshev nodes of one panel. The interpolation error is below 1e-13 also for the oscillating
# response of a stiff film on a thin incompressible layer (3e-11 with 16 nodes).
NODES = 20
AT_ONCE = 1 << 11  # number of places at a time, limited by the processor cache


def panel_edges(core: float, reach: float) -> Array:
    """Return the bounds of interpolation panels over the distance from a force (panels + 1,)
    [length].

    core   bound of the first panel, which begins at 0
    reach  distance that the last panel must include
    """
    panels = max(0, ceil(2 * log2(reach / core)))
    return np.concatenate([[0.0], core * sqrt(2.0) ** np.arange(panels + 1)])


def nodes_between(low: float, high: float) -> Array:
    """Return the Chebyshev interpolation nodes of the panel of distances from `low` to `high`
    (NODES,)."""
    on_unit = np.cos((np.arange(NODES) + 0.5) * pi / NODES)
    return np.asarray((low + high) / 2 + (high - low) / 2 * on_unit)


def coefficients_of(values: Array) -> Array:
    """Compute Chebyshev coefficients of functions from their values at the nodes of each panel.

    Values and result have the shape (..., panels, NODES, functions).
    """
    k = np.arange(NODES)
    matrix = 2 / NODES * np.cos(np.outer(k, (k + 0.5) * pi / NODES))
    matrix[0] /= 2
    return np.asarray(np.einsum("kn,...nf->...kf", matrix, values))


def places_on_panels(edges: Array, r: Array) -> Iterator[tuple[int, Indices, Array]]:
    """Assign distances from a point force to the panels of an interpolation table.

    Panels without distances are skipped.

    edges   panel bounds (panels + 1,)
    r       distances (n,)
    yields  panel index, indices of its distances, and their positions on the panel in [-1, 1]
    """
    panels = np.clip(np.searchsorted(edges, r) - 1, 0, len(edges) - 2)
    for panel in map(int, np.flatnonzero(np.bincount(panels))):
        inside = np.flatnonzero(panels == panel)
        low, high = edges[panel], edges[panel + 1]
        yield panel, inside, (2 * r[inside] - low - high) / (high - low)


def interpolated(coefficients: Array, place: Array) -> Array:
    """Interpolate tabulated functions of the distance on one panel, shape (functions, positions).

    coefficients  Chebyshev coefficients of the functions on the panel (NODES, functions)
    place         positions on the panel in [-1, 1] (positions,)
    """
    found = np.empty((coefficients.shape[1], len(place)))
    for start in range(0, len(place), AT_ONCE):
        some = slice(start, start + AT_ONCE)
        found[:, some] = coefficients.T @ _polynomials(place[some])
    return found


def _polynomials(place: Array) -> Array:
    """Evaluate the first NODES Chebyshev polynomials T_k at positions in [-1, 1], (NODES,
    positions).

    The recursion T_{m+k} = 2 T_m T_k - T_{m-k} doubles the number of polynomials in each step.
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
