"""Solver of one scene with a variable discretisation: the interface that every solver exports.

The commands plan and solve with the settings of a scene file. Error estimates solve again with
coarser discretisations, and a requested accuracy with finer ones. A solver describes here its
parameters, their coarser and finer values, and the cost of a solve. The module `discretised` of
each solver package has the class; `contact_results.solvers` lists them.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil
from typing import Any, ClassVar, NamedTuple, Self, TypeAlias

from contact_scene.contact_features import Features
from contact_scene.discretisation import (
    FiniteElementDiscretisation,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.quantities.increment import ReportedIncrement
from contact_scene.quantities.stated_error import Part
from contact_scene.quantities.summary import ContactStatus
from contact_scene.reading.scene_text import increments_text
from contact_scene.scene import Scene, SceneFile
from contact_scene.stepping.checkpoint import CheckpointStore
from contact_scene.stepping.increment_error import has_increment_error

# Coarse solve: description, fraction of the cells along a side, and number of additional cells.
Share: TypeAlias = tuple[str, float, int]
# The edges of contact and stick zone lie at other positions within the cells of each.
# Other parameters than the cells are compared on the first.
SHARES = (
    ("2/5 of the {}", 2 / 5, 0),
    ("half the {} plus 2", 1 / 2, 2),
    ("1/3 of the {}", 1 / 3, 0),
)
# Solves of the comparison for small grids, whose coarse solves would not resolve the contact.
SHARES_OF_SMALL = (
    ("2/3 of the {}", 2 / 3, 0),
    ("3/2 of the {}", 3 / 2, 0),
)
LEAST_TOLERANCE = 1e-13
# Relative round-off of double precision in systems of a few hundred equations, and in sums of a few
# hundred waves with cancellation.
PRECISION = 1e-13
# Largest fraction of the difference between two levels that the tolerance of coarse solves may
# cause: two digits of the difference are correct, as many as a stated error has.
NEGLIGIBLE = 1e-2
# Ratio of the relative error of a scalar to the relative residual that causes this error.
PER_TOLERANCE = 10.0
# Exponent of the unknowns in the CPU time of a solve (`contact_errors.cost_estimate`).
EXPONENT = 1.1
# Scalars in proportion to the friction limit or to slip.
TANGENTIAL = (
    "tangential_shift",
    "tangential_force",
    "twist",
    "torque",
    "stick_radius",
    "stick_area",
    "dissipated_energy",
    "energy_per_cycle",
)
# Linear elements, and linear interpolation between rings, resolve a feature as twice their number
# of cells.
LINEAR = 2.0

# Refinement factor of each discretisation parameter, by the part of the error that it causes.
Refinement: TypeAlias = Mapping[Part, float]
# Settings of a solver in a scene file.
Discretisation: TypeAlias = (
    SurfaceDiscretisation | FiniteElementDiscretisation | RadialDiscretisation
)
# Function that is called after every increment.
Progress: TypeAlias = Callable[[ReportedIncrement], None]
# Names and texts of what a command prints.
Pairs: TypeAlias = Iterator[tuple[str, str]]


class Work(NamedTuple):
    """Numbers of unknowns and repetitions of a solve, from which its CPU time is estimated.

    unknowns     number of traction components in all cells; of a finite-element solve, square of
                 the number of elements over the contact radius; of a radial solve, fourth power of
                 the factor of the default numbers of rings and angles
    repetitions  number of increments; of a finite-element solve, increments and set-up times the
                 number of angular harmonics
    overhead     number of unknowns whose work equals the overhead of an operation
    """

    unknowns: float
    repetitions: float
    overhead: float

    def size(self, share: float = 1.0) -> float:
        """Count the unknowns and the overhead of a solve.

        share  fraction of the cells along a side, for a coarser solve of an error estimate
        """
        return share**2 * self.unknowns + self.overhead

    def cost(self, share: float = 1.0) -> float:
        """Compute a number proportional to the CPU time of a solve.

        The ratio of the numbers of two solves is the ratio of their CPU times, if scene and solver
        are equal.

        share  fraction of the cells along a side, for the cost of a coarser solve of an error
               estimate
        """
        return self.repetitions * self.size(share) ** EXPONENT


@dataclass(frozen=True)
class Fineness:
    """Discretisation parameters of one solve: grid or mesh, increments and tolerance.

    Error estimates compare solves whose parameters differ in one of these values.

    space       grid of cells, mesh settings of finite elements, or factor of the default number of
                rings
    increments  number of increments of each load step
    tolerance   limit of every relative residual of the contact equations
    edges       false to omit the subcell edge correction of the semi-analytical solver
    """

    space: Any
    increments: tuple[int, ...]
    tolerance: float
    edges: bool = True


@dataclass(frozen=True)
class CoarseSolve:
    """Specification of a coarse solve that changes one mesh parameter other than the element count.

    Examples of such parameters are the size of the meshed section and the number of angular
    harmonics. The solve measures the error that the parameter causes.

    part        name of the part of the error that the solve measures, such as "harmonics"
    differs     text that describes the changed parameter in the record of the solve
    key, value  name of the mesh parameter, and its coarser value
    ratio       coarsening factor of the parameter, above 1
    """

    part: Part
    differs: str
    key: str
    value: Any
    ratio: float


@dataclass(frozen=True)
class DiscretisedSolver(ABC):
    """Interface of a solver for one scene whose discretisation can be coarsened and refined.

    Runs have the discretisation of the settings, error estimates coarsen it, and a requested
    accuracy refines it. The plans of all solvers have the attributes `effects` and `increments`.

    scene           scene to solve
    discretisation  settings of the scene file for this solver; parameters that are neither
                    coarsened nor refined are taken from it
    chosen_plan     plan of a solved result; None for the plan that the solver makes of the scene
    """

    scene: Scene
    discretisation: Any
    chosen_plan: Any = None

    # Table of the solver in a scene file, and class of the settings in this table.
    table: ClassVar[str]
    settings: ClassVar[type[Discretisation]]
    # Part of the error that the cells cause, name of the cells, their largest number along a side
    # (elements: over the contact radius; rings: multiple of the default), and coarse solves.
    part: ClassVar[Part]
    cells: ClassVar[str]
    most: ClassVar[float]
    shares: ClassVar[Sequence[Share]] = SHARES
    # True if the set-up of a solve depends on its mesh and takes a large part of the time.
    factorises_each_mesh: ClassVar[bool] = False

    @classmethod
    def of_file(cls, contents: SceneFile) -> Self:
        """Create the solver of a scene file, with the settings of its table in the file."""
        return cls(contents.scene, getattr(contents, cls.table))

    @classmethod
    @abstractmethod
    def of(cls, result: Any) -> Self:
        """Create the solver that repeats the solve of a result with coarser discretisations.

        The scene, the discretisation settings and the plan (modelled effects, increments) are those
        of the result.
        """

    @property
    @abstractmethod
    def plan(self) -> Any:
        """Plan of a solve: modelled physical effects, and increments of each load step.

        The plan depends on the scene, not on the grid or mesh.
        """

    @abstractmethod
    def solve(self, fineness: Fineness, progress: Any = None, store: Any = None) -> Any:
        """Solve the contact problem of the scene with given discretisation parameters.

        Raises a SolverError if the solve fails.

        fineness  grid or mesh, number of increments of each load step, and tolerance
        progress  function that is called after every increment, or None
        store     store of checkpoints from which an interrupted solve resumes, or None
        """

    @abstractmethod
    def space_of(self, result: Any) -> Any:
        """Return the spatial discretisation with which a contact result was computed.

        The discretisation is a grid of cells, the mesh settings of finite elements, or the factor
        of the default number of rings, depending on the solver.
        """

    def fineness_of(self, result: Any) -> Fineness:
        """Return the discretisation parameters with which a contact result was computed.

        The parameters are the grid, mesh or ring factor, the number of increments of each load
        step, and the tolerance.
        """
        return Fineness(self.space_of(result), result.plan.increments, result.tolerance)

    # ---- runs with the settings of a scene file

    @cached_property
    def run_plan(self) -> Any:
        """Plan of a run: modelled physical effects, and increments of each load step.

        Raises UnsupportedScene if the solver cannot solve the scene.
        """
        return self.plan

    @abstractmethod
    def run(self, progress: Progress | None = None, store: CheckpointStore | None = None) -> Any:
        """Solve the scene with its settings and the plan of a run; raises a SolverError.

        progress  function that is called after every increment, or None
        store     store of checkpoints from which an interrupted solve resumes, or None
        """

    @abstractmethod
    def run_fineness(self) -> Fineness:
        """Return the discretisation parameters of a run."""

    def run_memory(self) -> float:
        """Estimate the peak memory of a run [byte]."""
        return self.memory(self.run_fineness())

    def describe_run(self) -> Pairs:
        """Yield names and texts of the discretisation, the tolerance and the increments of a run.

        The text marks a discretisation that the program has chosen.
        """
        yield from self.describe_space()
        yield "tolerance", f"{self.discretisation.tolerance:.3g}"
        yield "increments", increments_text(self.run_plan.increments)
        yield from self.describe_work()

    @abstractmethod
    def describe_space(self) -> Pairs:
        """Yield names and texts of the grid, mesh or rings of a run."""

    def describe_work(self) -> Pairs:
        """Yield further names and texts of a run, which follow its increments."""
        yield from ()

    def increment_reasons(self) -> Sequence[tuple[str, str, str]]:
        """Return load step, number of increments and reason of this number, as texts for a table.

        The sequence is empty if the solver states no reasons.
        """
        return ()

    @abstractmethod
    def describe_result(self, result: Any) -> Pairs:
        """Yield names and texts of the discretisation of a result."""

    # ---- coarse solves

    @abstractmethod
    def coarser(self, result: Any, share: float, more: int) -> Any:
        """Return the discretisation of a coarse solve: a coarser grid or mesh, or fewer rings.

        Where the accuracy of the radial solver does not depend on rings, the discretisation is
        finer instead.

        result  result whose errors are estimated
        share   fraction of the cells of the result along a side, or of its elements or rings
        more    number of cells or elements that are added to this fraction
        """

    def mesh_coarse_solves(self, base: Any, result: Any) -> Iterable[CoarseSolve]:
        """Return the coarse solves that change a mesh parameter other than the number of elements.

        Such parameters are the size of the meshed section, the overlap of the penalty method and
        the angular harmonics. Solvers without such parameters return none.

        base    mesh of a coarse solve, in which the parameters are changed
        result  result whose errors are estimated
        """
        return ()

    def few(self, coarse: Fineness, result: Any) -> Fineness:
        """Return the discretisation of the coarse solves that measure the increment error.

        These solves may use fewer cells than other coarse solves, because the effect of the
        increments hardly depends on the cells. By default, the argument `coarse` is returned.

        coarse  discretisation with the cells of a coarse solve
        result  result whose errors are estimated
        """
        return coarse

    def shares_of(self, space: Any) -> Sequence[Share]:
        """Return the coarse solves in the cells, elements or rings for a result on a grid or mesh.

        space  grid, mesh settings or ring factor of the result
        """
        return self.shares

    @abstractmethod
    def cell_sides(self, result: Any) -> tuple[float, ...]:
        """Return the side lengths of a cell, an element or a ring of a result.

        There is one length for each direction of refinement. The ratio of the lengths of two solves
        is the coarsening factor r in the error formula.
        """

    @abstractmethod
    def unknowns(self, result: Any) -> int:
        """Count the unknowns of a solve: tractions of cells or rings, displacements of elements."""

    @abstractmethod
    def record_entry(self, space: Any) -> Mapping[str, Any]:
        """Return the key and the value of a grid or mesh in records such as summary.json.

        The mapping has one entry, for example cells: (64, 64) or elements_per_radius: 16.

        space  grid, mesh settings or ring factor
        """

    @abstractmethod
    def measure_features(self, result: Any, end: Any) -> Features:
        """Measure contact, stick zone and layers in cells, for a load step that ends in contact.

        The sizes determine if the cells resolve the contact, and which convergence order the errors
        have.

        result  result of the solver
        end     state at the end of the load step
        """

    def features(self, result: Any) -> Sequence[Features]:
        """Return the sizes of contact, stick zone and layers in cells at the end of each load step.

        A load step that ends without contact receives the sizes of the previous load step.
        """
        found: list[Features] = []
        for end in result.steps:
            found.append(self.measure_features(result, end) if end.contact_area else found[-1])
        return found

    def residuals(self, result: Any) -> Sequence[float]:
        """Return the relative residual of the contact equations at the end of each load step.

        Used to estimate the error that the tolerance of the solve causes. By default the residual
        is assumed equal to the tolerance.
        """
        return [result.tolerance] * len(result.steps)

    def neglected_errors(self, result: Any) -> Mapping[str, float]:
        """Return the relative errors of scalars, by name, due to effects that the solver neglects.

        An example is the error of the peak pressure by roughness that the cells do not resolve. By
        default the tangential scalars have the asymmetry of the friction map, because solvers of
        bodies of revolution take its means over circles.
        """
        friction = self.scene.friction
        mapped = None if friction is None else friction.coefficient_map
        return {} if mapped is None else dict.fromkeys(TANGENTIAL, mapped.asymmetry)

    @property
    def is_reference(self) -> bool:
        """True if this solver has the method by which the pressing of the scene is known.

        The error estimate then compares with coarse solves, not with the known pressing.
        """
        return False

    def with_half_the_points(self) -> Self | None:
        """Return the solver of the scene with every second point of the indenter left out.

        The value is None if the shape of the indenter is not given by points.
        """
        half = self.scene.indenter.with_half_the_points()
        if half is None:
            return None
        return replace(self, scene=self.scene.model_copy(update={"indenter": half}))

    # ---- refinement

    @property
    def parts(self) -> tuple[Part, ...]:
        """Parts of the error that `refine_space` reduces, the part of the cells first."""
        return (self.part,)

    @abstractmethod
    def first_space(self) -> Any:
        """Return the grid, mesh or ring factor of the first level of an adaptive refinement.

        The first level is the coarsest discretisation. Further levels are refined from it until the
        errors meet the requested accuracy.
        """

    @abstractmethod
    def refine_space(self, space: Any, by: Refinement) -> Any:
        """Refine the grid, mesh or ring factor of one refinement level, to obtain the next one.

        space  grid, mesh settings or ring factor of the present level
        by     required refinement factor of each discretisation parameter, by name
        """

    def refine_fineness(self, fineness: Fineness, by: Refinement) -> Fineness:
        """Refine grid or mesh, increments and tolerance of one level, to obtain the next level.

        Load steps without an increment error keep their number of increments.

        fineness  parameters of the present level: grid or mesh, increments and tolerance
        by        required refinement factor of each parameter, by name; a parameter without entry
                  is kept
        """
        return replace(
            fineness,
            space=self.refine_space(fineness.space, by),
            increments=change_increments(
                fineness.increments,
                has_increment_error(self.scene),
                lambda count: ceil(by.get("increments", 1.0) * count - 1e-9),
            ),
            tolerance=max(LEAST_TOLERANCE, fineness.tolerance / by.get("tolerance", 1.0)),
        )

    @abstractmethod
    def work(self, fineness: Fineness) -> Work:
        """Count the unknowns and the increments of a solve, from which its CPU time is estimated.

        fineness  grid or mesh, increments and tolerance of the solve
        """

    @abstractmethod
    def memory(self, fineness: Fineness) -> int:
        """Estimate the peak memory of a solve with given discretisation parameters [byte].

        fineness  grid or mesh, increments and tolerance of the solve
        """

    def stress_memory(self, fineness: Fineness) -> int:
        """Estimate the peak memory of the stress in the body below a result [byte].

        The value is 0 if the stress needs no more memory than the solve.

        fineness  grid or mesh, increments and tolerance of the solve
        """
        return 0


def change_settings(space: Any, **changes: object) -> Any:
    """Return a copy of the mesh settings of a finite-element solve with some values changed.

    space    mesh settings; a grid or ring factor without changes is returned
    changes  new values by name of the setting
    """
    return space.model_copy(update=changes) if changes else space


def slip_zone(end: Any, per_length: float) -> tuple[float | None, float | None]:
    """Return stick radius and width of the slip annulus of an axisymmetric contact, in cells.

    Used to determine if the cells, half elements or half rings resolve the slip. Radius and width
    are None if the state has no stick radius, as without friction. The width is None in full stick.

    end         state at the end of a load step
    per_length  number of cells per unit of length [1/length]
    """
    if end.stick_radius is None:
        return None, None
    slips = end.status is not ContactStatus.FULL_STICK
    annulus = per_length * (end.contact_radius - end.stick_radius) if slips else None
    return per_length * end.stick_radius, annulus


def change_increments(
    counts: Sequence[int], matters: Sequence[bool], number: Callable[[int], int]
) -> tuple[int, ...]:
    """Change the numbers of increments of the load steps that have an increment error.

    counts   number of increments of each load step
    matters  for each load step, true if it has an increment error
    number   function from the present to the new number of increments of a load step
    """
    pairs = zip(counts, matters, strict=True)
    return tuple(number(count) if matter else count for count, matter in pairs)


def coarse_tolerance(cells: float) -> float:
    """Choose the tolerance of coarse solves so that it hardly changes the estimated errors.

    An error is estimated from the difference between a coarse and a fine solve. With m cells per
    contact radius in the coarse solve, this difference is at least about 1/m² of a scalar. The
    tolerance causes 1 % (`NEGLIGIBLE`) of the difference.

    cells  cells per contact radius in the coarse solves
    """
    return NEGLIGIBLE / PER_TOLERANCE / cells**2
