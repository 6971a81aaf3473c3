"""Order and parity of the fields at depth and of the tractions that cause them."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

# Axes of every component; displacement first, then stress in the order of CONVENTIONS.md.
FIELDS = ("x", "y", "z", "xx", "yy", "zz", "yz", "xz", "xy")
DISPLACEMENT = slice(0, 3)
STRESS = slice(3, 9)
# (q_x, q_y, p), as in the FRF.
TRACTIONS = ("x", "y", "z")


PRESSURE = TRACTIONS[2:]


def acting(sheared: bool) -> tuple[str, ...]:
    """Return the tractions that act: the pressure alone, or all of `TRACTIONS`."""
    return TRACTIONS if sheared else PRESSURE


def parity(field: str, traction: str) -> tuple[int, int]:
    """Return the parity of a response along x and along y: +1 if even, -1 if odd.

    By reflection each occurrence of an axis in the field or the traction is one change of sign.
    """
    axes = field + traction
    return (-1) ** axes.count("x"), (-1) ** axes.count("y")


def each_response(
    coefficients: NDArray[np.float64],
) -> Iterator[tuple[NDArray[np.float64], tuple[int, int]]]:
    """Iterate over responses of (FIELDS, acting tractions, nx, ny) with their parity."""
    tractions = acting(coefficients.shape[1] > 1)
    for responses, field in zip(coefficients, FIELDS, strict=True):
        for response, traction in zip(responses, tractions, strict=True):
            yield response, parity(field, traction)


def empty_response(shape: tuple[int, ...], *, sheared: bool = True) -> NDArray[np.float64]:
    """Return an array (FIELDS, acting tractions, *shape)."""
    return np.empty((len(FIELDS), len(acting(sheared)), *shape))
