"""Exceptions of all solvers, one class per cause that a caller may treat separately."""

from typing import Any


class SolverError(RuntimeError):
    """Valid scene without a reliable solution by this solve.

    last_state  last converged state of the history, or None
    where       position in the history, such as "step 2, increment 3 of 18"; None before its start
    """

    last_state: Any = None
    where: str | None = None

    def __str__(self) -> str:
        message = super().__str__()
        return message if self.where is None else f"{self.where}: {message}"


class UnsupportedScene(SolverError):
    """Scene with physics that the solver does not support."""


class GrossSliding(SolverError):
    """Tangential force above the friction limit."""


def motion_undefined() -> GrossSliding:
    """Create the error of a history that continues from an undefined shift or twist."""
    return GrossSliding(
        "the previous increment reached the friction limit under force control, where the shift or "
        "twist is undefined, so the history cannot continue; prescribe the shift or twist instead"
    )


class ContactAtWindowEdge(SolverError):
    """Contact at the border of the window, which cuts off its tractions."""


class ContactAtZoneEdge(SolverError):
    """Contact at the end of the fine elements or rings, which cuts off its tractions."""


class ContactNotResolved(SolverError):
    """Contact of too few cells or rings, or of none."""


class NothingTouches(ContactNotResolved):
    """Prescribed approach without contact of any cell or ring."""


class SurfacesOverlap(SolverError):
    """Overlap above its limit in the penalty method; smaller increments do not help.

    overlap  overlap relative to the displacement of the bodies
    """

    def __init__(self, overlap: float, augmentations: int, allowed: float) -> None:
        times = f"{augmentations} augmentation{'s' if augmentations != 1 else ''}"
        super().__init__(
            f"the surfaces overlap by {overlap:.1e} of the approach after {times}, allowed are "
            f"{allowed:.1e}; use a larger penalty or more augmentations"
        )
        self.overlap = overlap


class ResourceRefused(SolverError):
    """Solve that requires more than the available memory."""


class AccuracyOutOfReach(SolverError):
    """Requested accuracy that no grid reaches."""


class NotConverged(SolverError):
    """Iteration that ended above its tolerance; the increment has no result.

    iterations  number of iterations
    residual    largest dimensionless residual
    tolerance   limit of the residuals
    """

    def __init__(self, problem: str, iterations: int, residual: float, tolerance: float) -> None:
        super().__init__(
            f"{problem} did not converge: residual {residual:.2e} after {iterations} iterations, "
            f"tolerance {tolerance:.1e}; try smaller load increments or a looser tolerance"
        )
        self.iterations = iterations
        self.residual = residual
        self.tolerance = tolerance
