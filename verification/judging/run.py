"""Runs of a verification case: one scene, its discretisation and the solver.

There is one class for each of the three solvers.
"""

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
# Factor on the tolerance for fields of cells and elements. The laws are evaluated with other norms
# than those of the solver.
OTHER_NORMS = 10.0
# Accepted violations for the radial solver, whose integrals are sums over rings. The largest
# violations in all radial cases are 1.2e-3, 4e-3 if the solver interpolates between the angles of
# its points, and 1.4e-4 of the energy (cone).
OVER_RINGS, OVER_ANGLES, ENERGY_OVER_RINGS = 2e-3, 5e-3, 2e-4


@dataclass(frozen=True)
class Run:
    """Run of the semi-analytical solver: one scene on a grid of cells, solved to a tolerance.

    label      name of the run within its case
    scene      bodies and loads
    grid       grid of cells
    tolerance  bound of every residual [1]
    effects    function that changes the set of computed physical effects before the solve; None: no
               change
    problem    name of the problem, if a case has several problems; else empty
    edge       setting of the edge correction; the default of users, unless orders of convergence of
               the uncorrected method are judged
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
        """Largest accepted violation of a law of contact or friction in the fields of this
        run [1].
        """
        return OTHER_NORMS * self.tolerance

    @property
    def energy(self) -> float:
        """Largest accepted energy imbalance of an increment, over the largest energy so far [1]."""
        return self.laws

    @property
    def spacing(self) -> float:
        """Longer side of a cell of the grid, the discretisation size h in orders of convergence
        [length].
        """
        return max(self.grid.spacing)

    def solve(self) -> semi_analytical.Result:
        """Solve the scene on the grid of cells, with the physical effects that the solver or the
        run chooses.

        Raises the exceptions of `semi_analytical.solve`.
        """
        from semi_analytical import plan, solve

        decided = plan(self.scene, edge=self.edge)
        if self.effects is not None:
            decided = self.effects(decided)
        return solve(self.scene, self.grid, self.tolerance, plan=decided)


@dataclass(frozen=True)
class SectionRun:
    """Run of the finite element solver: one scene on an axisymmetric mesh.

    label           name of the run within its case
    scene           bodies and loads
    discretisation  mesh and tolerance
    method          contact algorithm
    beyond          distance of the contact edge beyond the radius that the mesh divides, in
                    elements, if known; for meshes that differ in this distance alone, the mean
    problem         name of the problem, if a case has several problems; else empty
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
        """Bound of every residual of the finite element solve [1]."""
        return self.discretisation.tolerance

    @property
    def laws(self) -> float:
        """Largest accepted violation of a law of contact or friction in the fields of this
        run [1].
        """
        return OTHER_NORMS * self.tolerance

    @property
    def energy(self) -> float:
        """Largest accepted energy imbalance of an increment, over the largest energy so far [1]."""
        return self.laws

    @property
    def spacing(self) -> float:
        """Side of an element at the contact over the contact radius: size h in orders of
        convergence [1].
        """
        return 1 / (self.discretisation.elements_per_radius + self.beyond)

    def solve(self) -> fem_reference.Result:
        """Solve the scene by finite elements on the mesh and with the contact method of the run.

        Raises the exceptions of `fem_reference.solve`.
        """
        import fem_reference

        method = fem_reference.Method(self.method.value)
        return fem_reference.solve(self.scene, self.discretisation, method)


@dataclass(frozen=True)
class RadiiRun:
    """Run of the radial solver: one scene whose tractions are represented over the radius.

    label      name of the run within its case
    scene      bodies and loads
    fineness   factor on the numbers of polynomials and rings that the solver chooses
    rings      number of rings at which the solver returns its fields
    tolerance  bound of every residual [1]
    laws       largest accepted violation of a law of contact or friction in these fields [1]
    at_points  True if torsion is solved at points on rings although a closed form would suffice
    problem    name of the problem, if a case has several problems; else empty
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
        """Relative discretisation size: number of rings that the solver would choose over the
        number used.
        """
        return 1 / self.fineness

    def solve(self) -> radial.Result:
        """Solve the scene by the radial solver with the fineness of the run.

        Raises the exceptions of `radial.solve`.
        """
        import radial
        from contact_scene import RadialDiscretisation
        from radial.angular_grid import RingAngles

        asked = RadialDiscretisation(rings=self.rings, tolerance=self.tolerance)
        plan = radial.plan(self.scene)
        if self.at_points:
            plan = replace(plan, circle=RingAngles.ONE)
        return radial.solve(self.scene, asked, plan=replace(plan, fineness=self.fineness))


AnyRun = Run | SectionRun | RadiiRun


def per_radius(elements: int, contact_radius: float | None = None) -> FiniteElementDiscretisation:
    """Create a finite element discretisation with a given number of elements per contact radius.

    elements        number of elements over the radius
    contact_radius  radius over which the elements are counted [length]; None: the estimated radius
    """
    return FiniteElementDiscretisation(
        elements_per_radius=elements, contact_radius=contact_radius, tolerance=SOLVER_TOLERANCE
    )
