"""How far apart two results of the same scene are."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from contact_scene.residuals import worst

if TYPE_CHECKING:
    from semi_analytical import Increment, Result


def largest_difference(one: Result, other: Result) -> float:
    """At the ends of all steps: Σ|Δp|/Σp, Σ|Δq|/Σp, and approach and shift over the approach;
    NaN wins."""
    ends = zip(one.steps, other.steps, strict=True)
    return worst(*(_difference(a, b) for a, b in ends))


def _difference(one: Increment, other: Increment) -> float:
    total = np.sum(other.pressure)
    nothing = np.zeros((2, *other.pressure.shape))
    shears = [nothing if end.shear is None else end.shear for end in (one, other)]
    shifts = [
        np.zeros(2) if e.tangential_shift is None else e.tangential_shift for e in (one, other)
    ]
    return worst(
        float(np.sum(np.abs(one.pressure - other.pressure)) / total),
        float(np.sum(np.abs(shears[0] - shears[1])) / total),
        abs(one.approach / other.approach - 1),
        float(np.max(np.abs(shifts[0] - shifts[1])) / other.approach),
    )
