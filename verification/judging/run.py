"""One solve as part of a case: a scene, how finely, by which solver."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from contact_scene import FiniteElementDiscretisation, Scene, SurfaceDiscretisation
from contact_scene.discretisation import EdgeCorrection
from verification.solver import Method, Solver

if TYPE_CHECKING:
    import fem_reference
    import radial
    import semi_analytical
    from semi_analytical import Plan, SurfaceGrid

SOLVER_TOLERANCE = 1e-8
BY_DEFAULT = SurfaceDiscretisation().edge
# Fields of cells and elements are judged apart from the solver, with other norms.
OTHER_NORMS = 10.0
# Of fields over the radius integrals are sums over the rings: measured on all radial cases, they
# leave up to 1.2e-3, and 4e-3 where the solver interpolates between the angles of its points; of
# the energy 1.4e-4, below a cone.
OVER_RINGS, OVER_ANGLES, ENERGY_OVER_RINGS = 2e-3, 5e-3, 2e-4


@dataclass(frozen=True)
class Run:
    """One solve: a scene on a grid to a tolerance. The label names it within its case.

    effects  from the plan of the scene to the one to solve with; None: as planned
    edge     when the edge correction is applied; as a user's run applies it unless orders of the
             uncorrected method are judged
    problem  which of the problems of its case, in words; empty where there is one
    """

    label: str
    scene: Scene
    grid: SurfaceGrid
    tolerance: float = SOLVER_TOLERANCE
    effects: Callable[[Plan], Plan] | None = None
    problem: str = ""
    edge: EdgeCorrection = BY_DEFAULT

    solver: ClassVar[Solver] = Solver.CELLS

    @property
    def laws(self) -> float:
        """By how much its fields may violate a law."""
        return OTHER_NORMS * self.tolerance

    @property
    def energy(self) -> float:
        """Part of the energy that an increment may leave unaccounted for."""
        return self.laws

    @property
    def spacing(self) -> float:
        """The longer side of a cell [length]."""
        return max(self.grid.spacing)

    def solve(self) -> semi_analytical.Result:
        """Return the solution; raises what `semi_analytical.solve` raises."""
        from semi_analytical import plan, solve

        decided = plan(self.scene, edge=self.edge)
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
    def laws(self) -> float:
        """By how much its fields may violate a law."""
        return OTHER_NORMS * self.tolerance

    @property
    def energy(self) -> float:
        """Part of the energy that an increment may leave unaccounted for."""
        return self.laws

    @property
    def spacing(self) -> float:
        """Side of an element at the contact over the contact radius."""
        return 1 / (self.discretisation.elements_per_radius + self.beyond)

    def solve(self) -> fem_reference.Result:
        """Return the solution; raises what `fem_reference.solve` raises."""
        import fem_reference

        method = fem_reference.Method(self.method.value)
        return fem_reference.solve(self.scene, self.discretisation, method)


@dataclass(frozen=True)
class RadiiRun:
    """One solve: a scene of revolution on radii. The label names it within its case.

    fineness   how many times as many orders and rings as the solver chooses
    rings      at which fields are told
    laws       by how much its fields may violate a law
    at_points  whether torsion is solved at points on rings where a closed form would do
    problem    which of the problems of its case, in words; empty where there is one
    """

    label: str
    scene: Scene
    fineness: float = 1
    rings: int = 512
    tolerance: float = SOLVER_TOLERANCE
    laws: float = OVER_RINGS
    at_points: bool = False
    problem: str = ""

    solver: ClassVar[Solver] = Solver.RADII
    energy: ClassVar[float] = ENERGY_OVER_RINGS

    @property
    def spacing(self) -> float:
        """Rings that the solver chooses over those that it takes."""
        return 1 / self.fineness

    def solve(self) -> radial.Result:
        """Return the solution; raises what `radial.solve` raises."""
        import radial
        from contact_scene import RadialDiscretisation
        from radial.angular_grid import Circle

        asked = RadialDiscretisation(rings=self.rings, tolerance=self.tolerance)
        plan = radial.plan(self.scene)
        if self.at_points:
            plan = replace(plan, circle=Circle.ONE)
        return radial.solve(self.scene, asked, plan=replace(plan, fineness=self.fineness))


AnyRun = Run | SectionRun | RadiiRun


def per_radius(elements: int, contact_radius: float | None = None) -> FiniteElementDiscretisation:
    """So many elements over this contact radius [length], or over the estimated one."""
    return FiniteElementDiscretisation(
        elements_per_radius=elements, contact_radius=contact_radius, tolerance=SOLVER_TOLERANCE
    )
