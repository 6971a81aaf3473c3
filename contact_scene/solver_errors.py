"""Exceptions of all solvers, one class per cause that a caller may treat separately."""

from typing import Any


class SolverError(RuntimeError):
    """Error of a solve that found no reliable solution of a valid scene.

    last_state  last converged increment of the load history; None without one
    where       position in the load history, such as "step 2, increment 3 of 18"; None before its
                start
    """

    last_state: Any = None
    where: str | None = None

    def __str__(self) -> str:
        message = super().__str__()
        return message if self.where is None else f"{self.where}: {message}"


class UnsupportedScene(SolverError):
    """Error for a scene with physics that the chosen solver does not support."""


class GrossSliding(SolverError):
    """Error for a tangential load or a torque that friction cannot carry."""


def motion_undefined() -> GrossSliding:
    """Create the error GrossSliding for a history that continues from an undefined shift or twist.

    Under force control, the tangential shift and the twist of the indenter are undefined at the
    friction limit.
    """
    return GrossSliding(
        "the previous increment reached the friction limit under force control, where the shift or "
        "twist is undefined, so the history cannot continue; prescribe the shift or twist instead"
    )


class ContactAtWindowEdge(SolverError):
    """Error for a contact that reaches the border of the window, which cuts off its tractions."""


class ContactAtZoneEdge(SolverError):
    """Error for a contact that reaches the end of the fine elements or rings.

    The end would cut off the tractions of the contact.
    """


class ContactNotResolved(SolverError):
    """Error for a contact that covers no cell or ring, or too few for a reliable result."""


class NothingTouches(ContactNotResolved):
    """Error for a prescribed approach at which no cell and no ring comes into contact."""


class SurfacesOverlap(SolverError):
    """Error for an overlap of the surfaces above its limit in the penalty method.

    Smaller load increments do not reduce the overlap.

    overlap  largest overlap, relative to the displacement of the bodies
    """

    def __init__(self, overlap: float, augmentations: int, allowed: float) -> None:
        times = f"{augmentations} augmentation{'s' if augmentations != 1 else ''}"
        super().__init__(
            f"the surfaces overlap by {overlap:.1e} of the approach after {times}, allowed are "
            f"{allowed:.1e}; use a larger penalty or more augmentations"
        )
        self.overlap = overlap


class ResourceRefused(SolverError):
    """Error for a solve that requires more than the available memory."""


class AccuracyOutOfReach(SolverError):
    """Error for a requested accuracy that no discretisation reaches."""


class NotConverged(SolverError):
    """Error for an iteration that ended above its tolerance, so that the increment has no result.

    iterations  number of iterations
    residual    largest dimensionless residual at the end
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
