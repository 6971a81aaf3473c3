"""What a pressure at the nodes of elements says of the contact's edge and of its axis.

CalculiX fits a plane to the pressures at the points of integration of a face, keeps it within the
least and the largest of them, and takes the mean over all faces at a node that have such points. So
a node on the edge has half the pressure of the points next to it, where there is none.
"""

from collections.abc import Mapping
from math import sqrt
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

Vector = NDArray[np.float64]

AT_AXIS = 0.1, 0.5  # over the contact radius: between, nodes tell the pressure at the axis
BESIDE_EDGE = 0.8  # beyond, they tell where it ends
RIPPLING = 3  # nodes next to it do not
FITTED = 5  # nodes


def on_nodes(found: Mapping[str, Any]) -> tuple[Vector, Vector]:
    """Radii and pressure, over those of Hertz."""
    return np.array(found["radii"]), np.array(found["pressure"])


def up_to_edge(r: Vector, pressure: Vector) -> tuple[float, Vector]:
    """Where the pressure vanishes, and itself, close to the edge by the last nodes that tell it:
    its square is a parabola over r². As it is, to the middle of the last two nodes, where too few
    tell."""
    near = np.flatnonzero(r > BESIDE_EDGE * r[-1])[:-RIPPLING][-FITTED:]
    if len(near) < FITTED:
        return float((r[-2] + r[-1]) / 2), pressure
    square = Polynomial.fit(r[near] ** 2, pressure[near] ** 2, 2).convert()
    start, slope, bend = np.asarray(square.coef, dtype=np.float64)
    # The root that is there without a bend, as under a ball on a bare half-space.
    edge = sqrt(2 * start / (-slope + sqrt(slope**2 - 4 * start * bend)))
    by_fit = np.where(r < edge, np.sqrt(np.maximum(square(r**2), 0.0)), 0.0)
    return edge, np.where(r > r[near[-1]], by_fit, pressure)


def at_axis(r: Vector, pressure: Vector, edge: float) -> float:
    """By a polynomial in r²: stresses next to the bore are not to be judged."""
    first, last = AT_AXIS
    near = (r > first * edge) & (r < last * edge)
    return float(Polynomial.fit(r[near] ** 2, pressure[near], 2)(0.0))
