"""Lagrange multipliers of prescribed forces, by a damped Newton method on the dual function.

The projection on tractions with prescribed sums (forces, moments) is q = P(y + Σ λ m). P is the
projection at each point on the friction or contact law, and m are the motions conjugate to the
sums. The multipliers λ minimise the convex dual function. The line search uses its gradient, the
defect of the sums, because near the friction limit values of the function are differences of large
numbers.
"""

from collections.abc import Callable
from typing import Protocol, TypeVar

from contact_scene.array_types import Vector

MAX_SWEEPS = 100
# Relative change of the multipliers at which the line search has failed: round-off. No traction has
# the prescribed forces then, and each further step would fail like this one. The part of a step is
# no measure: close to the friction limit a step is a multiple of the multipliers without bound.
SMALLEST_CHANGE = 1e-14


class ProjectedTraction(Protocol):
    """Interface of a traction projected on the friction or contact law, for given multipliers.

    The multipliers of the prescribed forces shift the traction before its projection.
    `find_multiplier` changes the multipliers until the forces have the prescribed values.
    """

    @property
    def defect(self) -> Vector:
        """Forces and moments of the projected traction minus the prescribed ones (k,).

        All are divided by the cell area. The defect is the gradient of the convex dual function
        that the multipliers minimise.
        """

    def has_prescribed_forces(self, multiplier: Vector) -> bool:
        """Return True if the traction has the prescribed forces up to rounding errors.

        multiplier  multipliers for which the traction was computed
        """

    def newton_step(self) -> Vector:
        """Compute the Newton step of the multipliers that corrects the forces of the traction.

        The corrected forces have the prescribed values to first order.
        """


Point = TypeVar("Point", bound=ProjectedTraction)


def find_multiplier(
    shifted_by: Callable[[Vector], Point], multiplier: Vector
) -> tuple[Point, Vector]:
    """Find the multipliers for which a projected traction has the prescribed forces and moments.

    A damped Newton method is used. Return the projected traction and the multipliers. If no
    traction has the prescribed forces, the last iterate is returned, which the caller must check.

    shifted_by  function that computes the projected traction for given multipliers
    multiplier  initial guess of the multipliers
    """
    shifted = shifted_by(multiplier)
    for _ in range(MAX_SWEEPS):
        if shifted.has_prescribed_forces(multiplier):
            break
        step = shifted.newton_step()
        steepest = -float((shifted.defect * step).sum())
        part = 1.0
        while True:
            trial = shifted_by(multiplier + part * step)
            # Curvature condition on the gradient of the dual: the step passes the minimum at most
            # to half the initial slope.
            if (trial.defect * step).sum() <= 0.5 * steepest:
                break
            part *= 0.5
            size = abs(multiplier).max() or abs(step).max()
            if not part * abs(step).max() > SMALLEST_CHANGE * size:
                return shifted, multiplier
        multiplier = multiplier + part * step
        shifted = trial
    return shifted, multiplier
