"""One solve as part of a case: a scene, how finely, by which solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from contact_scene import FiniteElementDiscretisation, Scene
from fem_reference import Method, Result, solve
from semi_analytical import Plan, SurfaceGrid

SOLVER_TOLERANCE = 1e-8


@dataclass(frozen=True)
class Run:
    """One solve: a scene on a grid to a tolerance. The label names it within its case.

    effects  from the plan of the scene to the one to solve with; None: as planned
    """

    label: str
    scene: Scene
    grid: SurfaceGrid
    tolerance: float = SOLVER_TOLERANCE
    effects: Callable[[Plan], Plan] | None = None

    solver: ClassVar[str] = "semi-analytical"

    @property
    def spacing(self) -> float:
        """The longer side of a cell [length]."""
        return max(self.grid.spacing)


@dataclass(frozen=True)
class SectionRun:
    """One solve: a scene on the mesh of a section. The label names it within its case.

    beyond  elements by which the contact reaches past the radius that the mesh counts them over,
            where that is known; the mean, where meshes differ in that alone
    """

    label: str
    scene: Scene
    discretisation: FiniteElementDiscretisation
    method: Method = Method.COMPLEMENTARITY
    beyond: float = 0.0
    solver: ClassVar[str] = "finite elements"

    @property
    def tolerance(self) -> float:
        """Bound of every residual."""
        return self.discretisation.tolerance

    @property
    def spacing(self) -> float:
        """Side of an element at the contact over the contact radius."""
        return 1 / (self.discretisation.elements_per_radius + self.beyond)

    def solve(self) -> Result:
        """The solution; raises what `fem_reference.solve` raises."""
        return solve(self.scene, self.discretisation, self.method)


def per_radius(elements: int, contact_radius: float | None = None) -> FiniteElementDiscretisation:
    """So many elements over this contact radius [length], or over the estimated one."""
    return FiniteElementDiscretisation(
        elements_per_radius=elements, contact_radius=contact_radius, tolerance=SOLVER_TOLERANCE
    )
