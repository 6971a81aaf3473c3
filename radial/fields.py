"""Result of a solve: scene, plan, and fields over the radius for every increment.

Names and signs of the fields are those of CONVENTIONS.
"""

from __future__ import annotations

from dataclasses import dataclass

from contact_scene import RadialDiscretisation, Scene
from contact_scene.discretised import Fineness
from contact_scene.quantities.load_history import LoadHistory
from contact_scene.quantities.ring_increment import RingIncrement
from radial.plan import Plan


@dataclass(frozen=True, kw_only=True)
class Increment(RingIncrement):
    """Converged state of the contact at the end of one increment of the load history, for output.

    Fields are values at the output rings. No ring lies where the pressure is infinite (the axis
    below a tip, the rim of a punch). `peak_pressure` is then the largest pressure at a ring of the
    largest contact; that of a smaller contact without friction is taken at the same fraction of its
    own radius.

    iterations  number of contact radii tried; for a contact at points (rings × angles) the number
                of Newton steps
    """

    approach: float


@dataclass(frozen=True, repr=False)
class Result(LoadHistory[Increment]):
    """Result of a solve of a load history: scene, discretisation, plan and all increments.

    scene       the solved contact problem, in its normal form
    fineness    number of output rings, and tolerance of the residuals
    plan        physical effects that the solve includes, and number of increments of each load step
    increments  converged states at the ends of all increments of the load history, in order
    """

    scene: Scene
    fineness: RadialDiscretisation
    plan: Plan
    increments: tuple[Increment, ...]

    @property
    def solver(self) -> str:
        """Name of the solver."""
        return "radial"

    @property
    def tolerance(self) -> float:
        """Tolerance of the solve, an upper bound of all residuals of all increments."""
        return self.fineness.tolerance

    @property
    def ring_fineness(self) -> Fineness:
        """Factor of the default number of rings, increments of each load step, and tolerance."""
        return Fineness(self.plan.fineness, self.plan.increments, self.tolerance)
