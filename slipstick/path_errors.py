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
    """Errors at the ends of all steps; solves the scene with twice the increments in every step.
    Without shear nothing depends on the path, and nothing is solved. Raises what `solve` raises.

    keeper  of that solve
    """
    if not result.plan.shear:
        return compared(result, result)
    plan = result.plan.doubled()
    finer = solve(result.scene, result.grid, result.tolerance, progress, plan, keeper)
    return compared(result, finer)
