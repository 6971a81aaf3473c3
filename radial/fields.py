"""What a solve returns: fields over the radius, with the names and signs of CONVENTIONS."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from contact_scene import RadialDiscretisation, Scene
from contact_scene.quantities.ring_increment import RingIncrement
from radial.plan import Plan


@dataclass(frozen=True, kw_only=True)
class Increment(RingIncrement):
    """The converged state at the end of one increment of the load history.

    Fields are values at the rings. Where the pressure is infinite, below a tip or at a rim, there
    is no ring, and `peak_pressure` is that of the ring next to it.

    iterations  contact radii that were tried
    """


@dataclass(frozen=True)
class Result:
    """All increments of a load history, with what was asked for and decided."""

    scene: Scene
    fineness: RadialDiscretisation
    plan: Plan
    increments: tuple[Increment, ...]
    solver: ClassVar[str] = "radial"

    @property
    def tolerance(self) -> float:
        """Bound of every residual at the end of every increment."""
        return self.fineness.tolerance

    @property
    def steps(self) -> tuple[Increment, ...]:
        """The last increment of every loading step."""
        return tuple(i for i in self.increments if i.index == i.increments_in_step)
