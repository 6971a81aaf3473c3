"""What any solver returns, against all laws."""

from __future__ import annotations

from typing import Any

import semi_analytical
from verification.observed.surfaces import surface_imbalance, surface_violation


def observed(result: Any) -> tuple[float, float | None]:
    """The largest violation of a law of contact and friction in any increment of a result, and the
    largest part of the energy that any cannot account for; both dimensionless, and infinite if a
    number is not finite. The second is None where bodies have no energy because they are coupled
    one way."""
    if isinstance(result, semi_analytical.Result):
        return surface_violation(result), surface_imbalance(result)
    if result.solver == "radial":
        from verification.observed.radii import ring_laws

        return ring_laws(result)
    from verification.observed.sections import section_laws

    return section_laws(result)
