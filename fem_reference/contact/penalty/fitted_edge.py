"""Radius of contact and of stick from values at Gauss points, finer than the points lie.

Pressure, and the shear that is missing from full slip, fall to zero like the square root of the
distance from the edge. Their squares are fitted by a parabola in r², without the last element. It
takes values of springs alone: augmented ones ripple at the edge. Over a whole element of places
where the edge can lie the radii come within 0.1 h.
"""

from math import pi

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

FITTED = (1.2, 5.9)  # distances from the last point, in elements; none of any point
FEWEST = 5  # points for a fit


def edge_radius(
    radii: Field, values: Field, last: int, element: float, outwards: bool = True
) -> float:
    """Radius where values that fall like a square root reach zero [length].

    values    (n,), positive up to the point `last`, and in its neighbourhood before it
    element   length of an element [length]
    outwards  whether they fall outwards, or inwards
    """
    side = 1 if outwards else -1
    beyond = last + side
    middle = radii[last]
    if 0 <= beyond < len(radii):
        middle = 0.5 * (radii[last] + radii[beyond])
    behind = side * (radii[last] - radii) / element
    fitted = (behind > FITTED[0]) & (behind < FITTED[1]) & (values > 0)
    if np.count_nonzero(fitted) < FEWEST:
        return float(middle)
    squares = np.polynomial.Polynomial.fit(radii[fitted] ** 2, values[fitted] ** 2, 2)
    zeros = squares.roots()
    real = np.sqrt(np.maximum(zeros.real[np.abs(zeros.imag) == 0], 0.0))
    near = real[np.abs(real - middle) < element]
    return float(near[np.argmin(np.abs(near - middle))] if len(near) else middle)


def stick_area(
    radii: Field, room: Field, in_stick: Mask, contact_radius: float, element: float
) -> float:
    """Area of the rings that stick [length^2].

    room      µp − |q| (n,), not negative
    in_stick  points in contact that do not slip (n,)
    """
    if not np.any(in_stick):
        return 0.0
    area = 0.0
    padded = np.concatenate([[False], in_stick, [False]])
    for point in np.flatnonzero(padded[1:] != padded[:-1]).tolist():
        # `point` is the first one beyond the change.
        if padded[point]:
            reached = edge_radius(radii, room, point - 1, element)
            area += pi * min(reached, contact_radius) ** 2
        elif point > 0:
            area -= pi * edge_radius(radii, room, point, element, outwards=False) ** 2
    return max(0.0, area)
