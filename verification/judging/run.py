"""One solve as part of a case: a scene, how finely, by which solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from contact_scene import FiniteElementDiscretisation, Scene
from verification.solver import Method, Solver

if TYPE_CHECKING:
    import fem_reference
    import radial
    import semi_analytical
    from semi_analytical import Plan, SurfaceGrid

SOLVER_TOLERANCE = 1e-8


@dataclass(frozen=True)
class Run:
    """One solve: a scene on a grid to a tolerance. The label names it within its case.

    effects  from the plan of the scene to the one to solve with; None: as planned
    problem  which of the problems of its case, in words; empty where there is one
    """

    label: str
    scene: Scene
    grid: SurfaceGrid
    tolerance: float = SOLVER_TOLERANCE
    effects: Callable[[Plan], Plan] | None = None
    problem: str = ""

    solver: ClassVar[Solver] = Solver.CELLS

    @property
    def spacing(self) -> float:
        """The longer side of a cell [length]."""
        return max(self.grid.spacing)

    def solve(self) -> semi_analytical.Result:
        """The solution; raises what `semi_analytical.solve` raises."""
        from semi_analytical import plan, solve

        decided = plan(self.scene)
        if self.effects is not None:
            decided = self.effects(decided)
        return solve(self.scene, self.grid, self.tolerance, plan=decided)


@dataclass(frozen=True)
class SectionRun:
    """One solve: a scene on the mesh of a section. The label names it within its case.

    beyond  elements by which the contact reaches past the radius that the mesh counts them over,
            where that is known; the mean, where meshes differ in that alone
    problem  which of the problems of its case, in words; empty where there is one
    """

    label: str
    scene: Scene
    discretisation: FiniteElementDiscretisation
    method: Method = Method.COMPLEMENTARITY
    beyond: float = 0.0
    problem: str = ""

    solver: ClassVar[Solver] = Solver.ELEMENTS

    @property
    def tolerance(self) -> float:
        """Bound of every residual."""
        return self.discretisation.tolerance

    @property
    def spacing(self) -> float:
        """Side of an element at the contact over the contact radius."""
        return 1 / (self.discretisation.elements_per_radius + self.beyond)

    def solve(self) -> fem_reference.Result:
        """The solution; raises what `fem_reference.solve` raises."""
        import fem_reference

        method = fem_reference.Method(self.method.value)
        return fem_reference.solve(self.scene, self.discretisation, method)


@dataclass(frozen=True)
class RadiiRun:
    """One solve: a scene of revolution on radii. The label names it within its case.

    fineness  how many times as many orders and rings as the solver chooses
    rings     at which fields are told
    """

    label: str
    scene: Scene
    fineness: float = 1
    rings: int = 512

    def solve(self) -> radial.Result:
        """The solution; raises what `radial.solve` raises."""
        import radial
        from contact_scene import RadialDiscretisation

        asked = RadialDiscretisation(rings=self.rings, tolerance=SOLVER_TOLERANCE)
        return radial.solve(self.scene, asked, fineness=self.fineness)


AnyRun = Run | SectionRun


def per_radius(elements: int, contact_radius: float | None = None) -> FiniteElementDiscretisation:
    """So many elements over this contact radius [length], or over the estimated one."""
    return FiniteElementDiscretisation(
        elements_per_radius=elements, contact_radius=contact_radius, tolerance=SOLVER_TOLERANCE
    )
