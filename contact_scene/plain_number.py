"""Numbers and nothing else: what is more than that means something by the rest."""

from decimal import Decimal
from numbers import Real
from typing import Any

import numpy as np


def is_plain(value: Any) -> bool:
    """Whether nothing is lost when a value is taken for a number: it has no unit, mask, imaginary
    part or second entry, and is neither a truth value nor a time."""
    if type(value) in (float, int):
        return True
    if type(value) is np.ndarray:
        return value.shape == () and value.dtype.kind in "fiu"
    if isinstance(value, bool | np.timedelta64) or not isinstance(value, Real | Decimal):
        return False
    return not has_unit(value)


def has_unit(value: Any) -> bool:
    """Whether a value is one of a library of units, as of pint, astropy or unyt."""
    return hasattr(value, "units") or hasattr(value, "unit")
