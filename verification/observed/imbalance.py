"""Energy that an increment cannot account for."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np


class Imbalance(float):
    """Difference of two energies of an increment, relative to the largest energy so far.

    terms  the increment, from 1, and the energies, in words
    """

    terms: str

    def __new__(cls, number: int, largest: float, difference: float, **terms: float) -> Imbalance:
        """Compare energies [force length] of the increment of this number."""
        found = super().__new__(cls, abs(difference) / largest)
        said = (f"{name.replace('_', ' ')} {energy:.6g} J" for name, energy in terms.items())
        found.terms = f"increment {number}: {', '.join(said)}; difference {difference:.3g} J"
        return found


def largest_of(found: Iterable[float]) -> float:
    """Return the largest of dimensionless numbers; infinite if one is not finite, 0 without any."""
    numbers = list(found)
    return max(numbers, default=0.0) if np.all(np.isfinite(numbers)) else float("inf")
