"""What finite increments cost in a result, by solving it again with twice as many."""

from __future__ import annotations

from typing import TYPE_CHECKING

from contact_results.path_error import compared
from contact_scene.path_error import PathError
from semi_analytical import Result, solve

if TYPE_CHECKING:
    from contact_scene.standing import Keeper
    from slipstick.solvers.solver import Progress


def path_errors(
    result: Result, progress: Progress | None = None, keeper: Keeper | None = None
) -> tuple[PathError, ...]:
    """Errors at the ends of all steps; solves the scene with twice the increments wherever the
    path matters, and not at all where it matters nowhere. Raises what `solve` raises.

    keeper  of that solve
    """
    refined = result.plan.refined()
    finer = result
    if refined != result.plan:
        finer = solve(result.scene, result.grid, result.tolerance, progress, refined, keeper)
    return compared(result, finer)
