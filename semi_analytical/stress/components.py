"""Order and parity of the fields at depth and of the tractions that cause them."""

import numpy as np
from numpy.typing import NDArray

# Axes of every component; displacement first, then stress in the order of CONVENTIONS.md.
FIELDS = ("x", "y", "z", "xx", "yy", "zz", "yz", "xz", "xy")
DISPLACEMENT = slice(0, 3)
STRESS = slice(3, 9)
# (q_x, q_y, p), as in the FRF.
TRACTIONS = ("x", "y", "z")


def parity(field: int, traction: int) -> tuple[int, int]:
    """+1 if a response is even, -1 if it is odd, along x and along y.

    By reflection each axis named in the field or the traction is one change of sign.
    """
    axes = FIELDS[field] + TRACTIONS[traction]
    return (-1) ** axes.count("x"), (-1) ** axes.count("y")


def empty_response(shape: tuple[int, ...]) -> NDArray[np.float64]:
    """An array (FIELDS, TRACTIONS, *shape)."""
    return np.empty((len(FIELDS), len(TRACTIONS), *shape))
