"""Data of a verification case: runs, measured quantities, references, tolerances and orders.

There is one class of runs for each of the three solvers.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import IntEnum
from typing import TYPE_CHECKING, Any, ClassVar

from contact_scene import FiniteElementDiscretisation, Scene, SurfaceDiscretisation
from contact_scene.discretisation import EdgeCorrection
from verification.convergence.observed_order import ORDER_WIDTH
from verification.observed.ring_errors import judged_within
from verification.problems.problem import EXACT, NUMERICAL, Reference
from verification.solver import Method, Solver

if TYPE_CHECKING:
    import fem_reference
    import radial
    import semi_analytical
    from semi_analytical import Plan, SurfaceGrid
    from verification.exhibits.chart import Chart


SOLVER_TOLERANCE = 1e-8
BY_DEFAULT = SurfaceDiscretisation().edge
# Factor on the tolerance for fields of cells and elements. The laws are evaluated with other norms
# than those of the solver.
OTHER_NORMS = 10.0
# Accepted violations for the radial solver, whose integrals are sums over rings. The largest
# violations in all radial cases are 1.2e-3, 4e-3 if the solver interpolates between the angles of
# its points, and 1.4e-4 of the energy (cone).
OVER_RINGS = 2e-3
OVER_ANGLES = 5e-3
ENERGY_OVER_RINGS = 2e-4


# Words for measured quantities in the discretisation of a run, by placeholder. The description of
# an observable contains placeholders, such as {point} for "cell" or "ring".
CELLS = {
    "point": "cell",
    "edge": "√(contact area / π), cells at the edge counted in part",
    "stick": "√(stick area / π)",
    "axis": "of the cells around the axis",
    "domain": "window",
    "sum": "Σ",
    "between": "0.1 to 0.95",
    "but": "two cells around the stick edge apart, ",
}
STRIPS = CELLS | {
    "point": "strip",
    "edge": "half of the contact width, fitted below the strip width",
    "stick": "half of the width of the stick zone",
}
HATS = {
    "point": "ring",
    "edge": "where the pressure ends, from its last two values",
    "stick": "stick radius",
    "axis": "on the axis",
    "domain": "contact",
    "sum": "∫",
    "but": "",
}
RINGS = HATS | {"edge": "radius of the contact"}
SPRINGS = HATS | {
    "point": "Gauss point",
    "edge": "where the pressure ends, by a fit of its square",
}


@dataclass(frozen=True)
class AnyRun(ABC):
    """Run of one of the three solvers: one scene with one discretisation.

    label    name of the run within its case
    scene    bodies and loads
    problem  name of the problem, if a case has several problems; else empty
    """

    label: str
    scene: Scene
    problem: str = field(default="", kw_only=True)

    solver: ClassVar[Solver]

    @property
    @abstractmethod
    def tolerance(self) -> float:
        """Bound of every residual [1]."""

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
    def as_users(self) -> bool:
        """True if the settings are those of users, with which stated errors are judged."""
        return True

    @property
    @abstractmethod
    def spacing(self) -> float:
        """Discretisation size h in orders of convergence."""

    @property
    @abstractmethod
    def count(self) -> int:
        """Number of cells per side, of elements per contact radius, or of rings of the output."""

    def side_over(self, radius: float) -> float:
        """Compute the side of an element over the contact radius; of cells and rings likewise [1].

        radius  contact radius [length]
        """
        return 1 / self.count

    @property
    @abstractmethod
    def words(self) -> Mapping[str, str]:
        """Words for measured quantities in the discretisation of this run, by placeholder."""

    @abstractmethod
    def solve(self) -> Any:
        """Solve the scene of the run; raises the exceptions of its solver."""

    @abstractmethod
    def record(self, result: Any) -> Mapping[str, Any]:
        """Return the fields of `RunRecord` that belong to the discretisation, by name."""


@dataclass(frozen=True)
class Run(AnyRun):
    """Run of the semi-analytical solver: one scene on a grid of cells, solved to a tolerance.

    grid       grid of cells
    tolerance  bound of every residual [1]
    effects    function that changes the set of computed physical effects before the solve; None: no
               change
    edge       setting of the edge correction; the default of users, unless orders of convergence of
               the uncorrected method are judged
    """

    grid: SurfaceGrid
    tolerance: float = SOLVER_TOLERANCE
    effects: Callable[[Plan], Plan] | None = None
    edge: EdgeCorrection = BY_DEFAULT

    solver: ClassVar[Solver] = Solver.CELLS

    @property
    def as_users(self) -> bool:
        return self.edge == BY_DEFAULT

    @property
    def spacing(self) -> float:
        """Longer side of a cell of the grid, or width of a strip: the discretisation size h in
        orders of convergence [length].
        """
        return self.grid.cell_side

    @property
    def count(self) -> int:
        return self.grid.cells[0]

    def side_over(self, radius: float) -> float:
        return self.grid.spacing[0] / radius

    @property
    def words(self) -> Mapping[str, str]:
        return STRIPS if self.grid.of_strips else CELLS

    def record(self, result: Any) -> Mapping[str, Any]:
        return {
            "cells": self.grid.cells,
            "window": self.grid.window,
            "convolutions": sum(i.convolutions for i in result.increments),
            "edge_change": max(i.edge_change or 0.0 for i in result.increments),
        }

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
class SectionRun(AnyRun):
    """Run of the finite element solver: one scene on an axisymmetric mesh.

    discretisation  mesh and tolerance
    method          contact algorithm
    beyond          distance of the contact edge beyond the radius that the mesh divides, in
                    elements, if known; for meshes that differ in this distance alone, the mean
    """

    discretisation: FiniteElementDiscretisation
    method: Method = Method.COMPLEMENTARITY
    beyond: float = 0.0

    solver: ClassVar[Solver] = Solver.ELEMENTS

    @property
    def tolerance(self) -> float:
        """Bound of every residual of the finite element solve [1]."""
        return self.discretisation.tolerance

    @property
    def spacing(self) -> float:
        """Side of an element at the contact over the contact radius: size h in orders of
        convergence [1].
        """
        return 1 / (self.discretisation.elements_per_radius + self.beyond)

    @property
    def count(self) -> int:
        return self.discretisation.elements_per_radius

    @property
    def words(self) -> Mapping[str, str]:
        within = f"{judged_within(self.discretisation.elements_per_radius):.2g}"
        own = SPRINGS if self.method is Method.PENALTY else HATS
        return own | {"within": within, "between": f"0.1 to {within}"}

    def record(self, result: Any) -> Mapping[str, Any]:
        return {
            "elements_per_radius": self.discretisation.elements_per_radius,
            "method": self.method,
            "factorizations": sum(i.factorizations for i in result.increments),
        }

    def solve(self) -> fem_reference.Result:
        """Solve the scene by finite elements on the mesh and with the contact method of the run.

        Raises the exceptions of `fem_reference.solve`.
        """
        import fem_reference

        method = fem_reference.Method(self.method.value)
        return fem_reference.solve(self.scene, self.discretisation, method)


@dataclass(frozen=True)
class RadiiRun(AnyRun):
    """Run of the radial solver: one scene whose tractions are represented over the radius.

    fineness   factor on the numbers of polynomials and rings that the solver chooses
    rings      number of rings at which the solver returns its fields
    tolerance  bound of every residual [1]
    laws       largest accepted violation of a law of contact or friction in these fields [1]
    at_points  True if torsion is solved at points on rings although a closed form would suffice
    """

    fineness: float = 1
    rings: int = 512
    tolerance: float = SOLVER_TOLERANCE
    laws: float = OVER_RINGS
    at_points: bool = False

    solver: ClassVar[Solver] = Solver.RADII

    @property
    def energy(self) -> float:
        return ENERGY_OVER_RINGS

    @property
    def spacing(self) -> float:
        """Relative discretisation size: number of rings that the solver would choose over the
        number used.
        """
        return 1 / self.fineness

    @property
    def count(self) -> int:
        return self.rings

    @property
    def words(self) -> Mapping[str, str]:
        return RINGS

    def record(self, result: Any) -> Mapping[str, Any]:
        return {"rings": self.rings}

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


def per_radius(elements: int, contact_radius: float | None = None) -> FiniteElementDiscretisation:
    """Create a finite element discretisation with a given number of elements per contact radius.

    elements        number of elements over the radius
    contact_radius  radius over which the elements are counted [length]; None: the estimated radius
    """
    return FiniteElementDiscretisation(
        elements_per_radius=elements, contact_radius=contact_radius, tolerance=SOLVER_TOLERANCE
    )


@dataclass(frozen=True)
class NotYetAsymptotic:
    """Allowance for an order of convergence that is observed on levels too coarse for the theory.

    allowance  accepted difference from the expected order
    because    cause of the difference

    The tolerance of the order is the larger of the allowance and the interval of the observed
    order, not their sum. Raises ValueError for an allowance that any order would meet.
    """

    allowance: float
    because: str

    def __post_init__(self) -> None:
        if not 0 < self.allowance < ORDER_WIDTH:
            raise ValueError(f"got {self.allowance}; an order judged to {ORDER_WIDTH} needs less")


@dataclass(frozen=True)
class Order:
    """Declaration of an order of convergence: the expected exponent p with which errors fall as
    h^p.

    Where the exact answer is not known, the changes between refinement levels replace the errors;
    changes fall with the same exponent.

    of        quantity whose order is determined
    meaning   description of the error or change
    levels    labels of the runs, coarse to fine; runs of equal size form one level, with the root
              mean square of their errors
    error     function from the result of a run to its error, of either sign; for changes, function
              from the results of two levels to their difference > 0
    expected  exponent p according to theory
    because   reason for the expected order
    not_yet   allowance for levels that are not asymptotic; None if there is no known reason
    refined   discretisation parameter that is refined
    size      function from a result to its discretisation parameter h; None: cell or element side
    apart     distance between the two compared levels in the list of levels; 0 for errors
    """

    name: str
    of: str
    meaning: str
    levels: tuple[str, ...]
    error: Callable[..., float]
    expected: float
    because: str
    not_yet: NotYetAsymptotic | None = None
    refined: str = "mesh"
    size: Callable[[Any], float] | None = None
    apart: int = 0


class Level(IntEnum):
    """Amount of computation of the verification: number of runs and fineness of their
    discretisation.

    Quick runs at every push, standard before a merge, full at night.
    """

    QUICK = 0
    STANDARD = 1
    FULL = 2


@dataclass(frozen=True)
class Required:
    """Prescribed tolerance of a judged quantity; it does not depend on results.

    allowed  largest accepted error, relative to the error scale of the quantity
    because  reason for this tolerance
    """

    allowed: float
    because: str


@dataclass(frozen=True)
class Derived:
    """Tolerance of a judged quantity that is computed from its values on several refinement levels.

    The tolerance is 2 √(u_num² + u_ref²), relative to the error scale of the quantity. u_num is the
    numerical uncertainty from the refinement levels, u_ref the uncertainty of the reference.

    levels   labels of the runs, coarse to fine
    order    expected order of convergence of the value
    cap      upper bound of the tolerance; without it a poor solver would get a wide tolerance
    because  reason for order and cap
    """

    levels: tuple[str, ...]
    order: float
    cap: float
    because: str


@dataclass(frozen=True)
class Quantity:
    """Number that a case judges against a reference.

    The number is measured on one run, on two runs that must agree, or without a run, such as the
    frequency response of a body.

    name        name of the verdict
    meaning     description of the number
    unit        SI unit; empty for a ratio
    run         label of the run; without a single run, the object of the measurement in words
    measure     function from the results of the runs to the number
    reference   reference value with its uncertainty
    tolerance   largest accepted error
    scale       error scale, in the unit of the number; None: absolute value of the reference
    scale_name  description of the error scale
    scalar      name, component and load step of a registered scalar, whose stated error is judged
                in addition; None for other numbers
    runs        labels of the runs whose results are measured; None: the single run
    coarse      label of a run that is coarser than the last of `runs`, from which the uncertainty
                of a numerical reference follows; empty: the last run is solved on half its cells

    Raises ValueError for a reference that is neither exact nor numerical and has no uncertainty.
    """

    name: str
    meaning: str
    unit: str
    run: str
    measure: Callable[..., float]
    reference: Reference
    tolerance: Required | Derived
    scale: float | None = None
    scale_name: str = "the reference"
    scalar: tuple[str, int, int] | None = None
    runs: tuple[str, ...] | None = None
    coarse: str = ""

    def __post_init__(self) -> None:
        kind, known = self.reference.kind, self.reference.uncertainty
        # An uncertainty that follows from a coarser solve is 0 at first, and never NaN.
        if not (known > 0 or kind in EXACT or (known == 0 and kind in NUMERICAL and self.runs)):
            raise ValueError(f"{self.name}: a reference of kind {kind} needs an uncertainty > 0")

    @property
    def labels(self) -> tuple[str, ...]:
        """Labels of the runs on whose results the number is measured; empty without a run."""
        return (self.run,) if self.runs is None else self.runs


def computed_error(
    name: str,
    meaning: str,
    where: str,
    measure: Callable[[], float],
    reference: Reference,
    tolerance: Required,
    over: str = "1",
) -> Quantity:
    """Create the judged error of numbers that are computed without a run.

    where      object of the measurement in words
    measure    function that returns the error, which is dimensionless
    reference  exact value of the error, which is mostly 0
    over       description of the number by which the error is divided
    """
    return Quantity(name, meaning, "", where, measure, reference, tolerance, 1.0, over, runs=())


@dataclass(frozen=True)
class Case:
    """Verification case: runs to solve, and all quantities that are judged.

    name         identifier for commands and files: letters, digits and underscores
    problem      description of the problem and of the source of its answer
    runs         solves of the case, by any solver
    quantities   numbers that are judged against references; a case may consist of these alone
    orders       orders of convergence that are judged
    charts       function from the results, by label of the run, to the charts
    limits       limits of the conclusions from this case
    equations    governing equations of the reference, in LaTeX
    no_order     reason for which no order of convergence is judged; empty if one is judged
    shows        equations, figures and statements of `cases.requirements` that the case shows
    """

    name: str
    title: str
    problem: str
    runs: tuple[AnyRun, ...]
    quantities: tuple[Quantity, ...]
    orders: tuple[Order, ...] = ()
    charts: Callable[[Mapping[str, Any]], tuple[Chart, ...]] | None = None
    limits: tuple[str, ...] = ()
    equations: tuple[str, ...] = ()
    no_order: str = ""
    shows: tuple[str, ...] = ()

    def run(self, label: str) -> AnyRun:
        """Return the run of the case with the given label.

        Raises KeyError for an unknown label.
        """
        return {run.label: run for run in self.runs}[label]
