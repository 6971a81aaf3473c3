"""What a pressure at the nodes of elements says of the contact's edge and of its axis."""

from collections.abc import Mapping
from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]

AT_AXIS = 0.1, 0.5  # over the contact radius: between, nodes tell the pressure at the axis
BESIDE_EDGE = 0.8  # beyond, they tell where it ends
RIPPLING = 3  # nodes next to it do not
FITTED = 5  # nodes at least


def on_nodes(found: Mapping[str, Any]) -> tuple[Vector, Vector]:
    """Radii and pressure, over those of Hertz."""
    return np.array(found["radii"]), np.array(found["pressure"])


def edge_of(r: Vector, pressure: Vector) -> float:
    """Where the pressure would vanish, r² a parabola in its square close to the edge: nodes next to
    it share the stress of an element that is half open."""
    near = np.flatnonzero(r > BESIDE_EDGE * r[-1])[:-RIPPLING]
    if len(near) < FITTED:
        return float((r[-2] + r[-1]) / 2)
    return sqrt(np.polynomial.Polynomial.fit(pressure[near] ** 2, r[near] ** 2, 2)(0.0))


def at_axis(r: Vector, pressure: Vector, edge: float) -> float:
    """By a polynomial in r²: stresses next to the bore are not to be judged."""
    first, last = AT_AXIS
    near = (r > first * edge) & (r < last * edge)
    return float(np.polynomial.Polynomial.fit(r[near] ** 2, pressure[near], 2)(0.0))
