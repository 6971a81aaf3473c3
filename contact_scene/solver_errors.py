"""What can go wrong in a solve, one class per thing a caller may want to treat differently.

Both solvers raise these, so that a caller need not know which one it has called.
"""

from typing import Any


class SolverError(RuntimeError):
    """The scene is well formed, but this solve cannot give a trustworthy answer.

    last_state  the last converged state of the history, or None
    where       the place in the history, such as "step 2, increment 3 of 18"; None before it
    """

    last_state: Any = None
    where: str | None = None

    def __str__(self) -> str:
        message = super().__str__()
        return message if self.where is None else f"{self.where}: {message}"


class UnsupportedScene(SolverError):
    """The scene asks for physics that this version of the solver does not have."""


class GrossSliding(SolverError):
    """The tangential load exceeds what friction can carry under force control."""


def motion_undefined() -> GrossSliding:
    """To be raised for a history that was to go on from where the motion is undefined."""
    return GrossSliding(
        "the increment before reached the friction limit under force control, where the motion is "
        "undefined, so the history cannot go on; prescribe the shift or twist instead"
    )


class ContactAtWindowEdge(SolverError):
    """The contact reached the border of the computed window, so its tractions are cut off."""


class ContactAtZoneEdge(SolverError):
    """The contact reached the end of fine elements or of rings, so its tractions are cut off."""


class ContactNotResolved(SolverError):
    """The contact is smaller than the cells: none touches, or only a few carry the load."""


class NothingTouches(ContactNotResolved):
    """No cell or ring comes into contact at a prescribed approach."""


class SurfacesOverlap(SolverError):
    """The springs of a penalty leave more overlap than is allowed; smaller increments do not help.

    overlap  what is left, relative to what the bodies move
    """

    def __init__(self, overlap: float, augmentations: int, allowed: float) -> None:
        times = f"{augmentations} augmentation{'s' if augmentations != 1 else ''}"
        super().__init__(
            f"the surfaces overlap by {overlap:.1e} of the approach after {times}, allowed "
            f"{allowed:.1e}; give a larger penalty or more augmentations"
        )
        self.overlap = overlap


class ResourceRefused(SolverError):
    """The solve would need more memory than this machine has available."""


class AccuracyOutOfReach(SolverError):
    """An accuracy was asked for that no grid can meet."""


class NotConverged(SolverError):
    """The iteration stopped above its tolerance; nothing of the failed increment is returned.

    iterations  iterations spent
    residual    the worst dimensionless residual reached
    tolerance   what was asked for
    """

    def __init__(self, problem: str, iterations: int, residual: float, tolerance: float) -> None:
        super().__init__(
            f"{problem} did not converge: residual {residual:.2e} after {iterations} iterations, "
            f"tolerance {tolerance:.1e}; try smaller load increments or a looser tolerance"
        )
        self.iterations = iterations
        self.residual = residual
        self.tolerance = tolerance
