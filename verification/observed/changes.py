"""By how much the end of a run changes where its path is cut more finely."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.observed.end_state import approach

if TYPE_CHECKING:
    from verification.observed.end_state import Result


def approach_change(coarse: Result, fine: Result) -> float:
    """Change of the approach relative to the finer."""
    return abs(approach(coarse) / approach(fine) - 1)


def energy_change(coarse: Result, fine: Result) -> float:
    """Change of the dissipated energy relative to the finer."""
    before, after = (result.steps[-1].dissipated_energy or 0.0 for result in (coarse, fine))
    return abs(before / after - 1)


def increment_size(result: Result) -> float:
    """Part of the contact radius that an increment adds."""
    return 1 / len(result.increments)
