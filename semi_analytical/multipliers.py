"""Multipliers of resultants: what makes a projected traction carry the load that is asked for.

The projection on tractions with given sums is q = P(y + Σ λ m), P the projection cell by cell and m
the rigid motions that the sums belong to. The λ minimise a convex function (the dual), found by a
damped Newton method. It works on the gradient of that function, the defect of the sums: its values
are differences of large numbers near the limit of what can be carried.
"""

from collections.abc import Callable
from typing import Protocol, TypeVar

import numpy as np

from contact_scene.array_types import Vector

MAX_SWEEPS = 100


class Shifted(Protocol):
    """A traction shifted by multipliers and projected."""

    @property
    def defect(self) -> Vector:
        """Sums of the traction less those asked for: the gradient of the dual."""

    def settled(self, multiplier: Vector) -> bool:
        """Whether the defect is round-off."""

    def newton_step(self) -> Vector:
        """Change of the multipliers that removes the defect to first order."""


Point = TypeVar("Point", bound=Shifted)


def find_multiplier(
    shifted_by: Callable[[Vector], Point], multiplier: Vector
) -> tuple[Point, Vector]:
    """The point without defect, and its multipliers; not settled where no traction has the sums.

    shifted_by  the point that belongs to a multiplier
    multiplier  where to start
    """
    shifted = shifted_by(multiplier)
    for _ in range(MAX_SWEEPS):
        if shifted.settled(multiplier):
            break
        step = shifted.newton_step()
        steepest = -float(np.sum(shifted.defect * step))
        part = 1.0
        while True:
            trial = shifted_by(multiplier + part * step)
            # The defect is the slope of the dual: the step may pass the minimum only a little.
            if np.sum(trial.defect * step) <= 0.5 * steepest or part < 1e-9:
                break
            part *= 0.5
        multiplier = multiplier + part * step
        shifted = trial
    return shifted, multiplier
