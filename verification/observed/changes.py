"""By how much the end of a run changes where its path is cut more finely."""

from __future__ import annotations

from typing import TYPE_CHECKING

from verification.observed.end_state import approach

if TYPE_CHECKING:
    from verification.observed.end_state import Result


def approach_change(coarse: Result, fine: Result) -> float:
    """Change of the approach relative to the finer."""
    return abs(approach(coarse) / approach(fine) - 1)


def increment_size(result: Result) -> float:
    """Part of the contact radius that an increment adds."""
    return 1 / len(result.increments)
