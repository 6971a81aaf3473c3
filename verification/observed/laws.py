"""Laws of contact and friction for the results of any solver."""

from __future__ import annotations

from typing import Any

import semi_analytical
from verification.observed.surfaces import surface_imbalance, surface_violation


def observed(result: Any) -> tuple[float, float | None]:
    """Return the largest violation of a law and the largest energy imbalance of any increment.

    Both are dimensionless, and infinite if a number is not finite. The imbalance is None if the
    bodies are coupled one way, because they then have no energy.
    """
    if isinstance(result, semi_analytical.Result):
        return surface_violation(result), surface_imbalance(result)
    if result.solver == "radial":
        from verification.observed.radii import ring_laws

        return ring_laws(result)
    from verification.observed.sections import section_laws

    return section_laws(result)
