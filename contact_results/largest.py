"""Place of the largest value of a field, independent of round-off."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# Relative difference of values that are equal by symmetry: round-off must not choose their place.
EQUAL = 1e-9
# Round-off of values that should be 0, relative to the largest magnitude of the field.
ZERO = 1e-13


def index_of_largest(values: NDArray[np.float64]) -> int:
    """Return the flat index of the first value that equals the largest up to round-off.

    A value that is not a number counts as the largest, so that it is not hidden.

    values  values of a field; -inf in points that do not count
    """
    sizes = np.abs(values[np.isfinite(values)])
    zero = ZERO * np.max(sizes, initial=0.0)
    return int(np.argmax(np.isclose(values, np.max(values), EQUAL, zero, equal_nan=True)))
