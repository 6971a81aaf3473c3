"""Order and parity of displacements and stresses at depth, and of the tractions that cause them."""

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
    """Return the names of the acting traction components: "z" for pressure, or `TRACTIONS`.

    The names select the responses that are computed.

    sheared  True with shear
    """
    return TRACTIONS if sheared else PRESSURE


def parity(field: str, traction: str) -> tuple[int, int]:
    """Return the parity along x and y of the response of a field component to a traction component.

    1 is even, -1 is odd. Each occurrence of an axis in the two names is one change of sign under
    reflection.

    field     name of a displacement or stress component, entry of FIELDS
    traction  name of a traction component, entry of TRACTIONS
    """
    axes = field + traction
    return (-1) ** axes.count("x"), (-1) ** axes.count("y")


def each_response(
    coefficients: NDArray[np.float64],
) -> Iterator[tuple[NDArray[np.float64], tuple[int, int]]]:
    """Iterate over the responses of displacement and stress components to tractions.

    Each response (nx, ny) is yielded with its parity along x and y: 1 even, -1 odd.

    coefficients  3 displacements and 6 stresses by each traction component (9, tractions, nx, ny)
    """
    tractions = acting(coefficients.shape[1] > 1)
    for responses, field in zip(coefficients, FIELDS, strict=True):
        for response, traction in zip(responses, tractions, strict=True):
            yield response, parity(field, traction)


def empty_response(shape: tuple[int, ...], *, sheared: bool = True) -> NDArray[np.float64]:
    """Return an uninitialised array for the displacements and stresses by unit tractions.

    The array has the shape (9, tractions, *shape), for 3 displacements and 6 stresses.

    shape    shape of each response
    sheared  True for the three tractions q_x, q_y, p; False for the pressure p alone
    """
    return np.empty((len(FIELDS), len(acting(sheared)), *shape))
