"""Result of a solve: fields over the radius, with the names and signs of CONVENTIONS."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from contact_scene import RadialDiscretisation, Scene
from contact_scene.quantities.ring_increment import RingIncrement
from radial.plan import Plan


@dataclass(frozen=True, kw_only=True)
class Increment(RingIncrement):
    """Converged state at the end of one increment of the load history.

    Fields are values at the rings. No ring lies where the pressure is infinite (below a tip, at a
    rim). There `peak_pressure` is the pressure at the adjacent ring.

    iterations  number of contact radii tried, or of Newton steps with a tangential load or torsion
    """


@dataclass(frozen=True)
class Result:
    """Result of a solve: scene, discretisation, plan and all increments."""

    scene: Scene
    fineness: RadialDiscretisation
    plan: Plan
    increments: tuple[Increment, ...]
    solver: ClassVar[str] = "radial"

    @property
    def tolerance(self) -> float:
        """Return the limit of every residual at the end of every increment."""
        return self.fineness.tolerance

    @property
    def steps(self) -> tuple[Increment, ...]:
        """Return the last increment of each load step."""
        return tuple(i for i in self.increments if i.index == i.increments_in_step)
