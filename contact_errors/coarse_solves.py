"""Coarse solves of a contact result for its error estimate: one procedure for all solvers.

`DiscretisedSolver` is the interface of a solver whose discretisation parameters can be coarsened,
for error estimates, or refined, for a requested accuracy. `compare_with_coarse_solves` runs the
coarse solves of a result. To save time, coarse solves have a looser tolerance than the result,
where its effect on the compared differences is negligible. They also have fewer increments, where
the effect of the increments is known from a separate comparison.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, log
from typing import Any, ClassVar, Self, TypeAlias

from contact_errors.cost_estimate import Work
from contact_errors.error_formula import (
    BELIEVED,
    ORDERS,
    PER_TOLERANCE,
    Comparison,
    Features,
    SolvedRun,
    Values,
    prescribed_scalars,
    values_of,
)
from contact_errors.known_pressing import known_pressing
from contact_scene import Scene
from contact_scene.quantities.stated_error import (
    CoarseSolveRecord,
    Part,
    StatedErrors,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import ContactNotResolved, SolverError
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
# The increments of a load step are compared with twice their number, at least MANY. If a load step
# has fewer than FEW, its error follows no power of their number: FEW are compared, too. The coarse
# solves that measure the error by the cells have at most FEW: with 4, the part by the cells of the
# stick radius in the gallery's scene spence is 2.7 times that with 8.
MANY = 32
FEW = 8
LEAST_TOLERANCE = 1e-13
# Largest number of refinements until the cells resolve the contact, and their factor.
MAX_DOUBLINGS = 5
DOUBLING = 2.0
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

# Largest fraction of the difference between two levels that the tolerance of coarse solves may
# cause: two digits of the difference are correct, as many as a stated error has.
NEGLIGIBLE = 1e-2

# Refinement factor of each discretisation parameter, by the part of the error that it causes.
Refinement: TypeAlias = Mapping[Part, float]
# A result with its scalars at the end of each load step.
Solved: TypeAlias = tuple[Any, Sequence[Values]]
# Scalars of two solves that differ in one parameter: of the finer and of the coarser solve.
Effect: TypeAlias = tuple[Sequence[Values], Sequence[Values]]


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

    Error estimates coarsen the discretisation, and a requested accuracy refines it.

    scene           scene to solve
    discretisation  settings of the scene file for this solver; parameters that are neither
                    coarsened nor refined are taken from it
    chosen_plan     plan of a solved result; None for the plan that the solver makes of the scene
    """

    scene: Scene
    discretisation: Any
    chosen_plan: Any = None

    # Part of the error that the cells cause, name of the cells, their largest number along a side
    # (elements: over the contact radius; rings: multiple of the default), and coarse solves.
    part: ClassVar[Part]
    cells: ClassVar[str]
    most: ClassVar[float]
    shares: ClassVar[Sequence[Share]] = SHARES
    # True if the set-up of a solve depends on its mesh and takes a large part of the time.
    factorises_each_mesh: ClassVar[bool] = False

    @classmethod
    @abstractmethod
    def of(cls, result: Any) -> Self:
        """Create the solver that repeats the solve of a result with coarser discretisations.

        The scene, the discretisation settings and the plan (modelled effects, increments) are those
        of the result.
        """

    @classmethod
    def stated_errors(cls, result: Any) -> StatedErrors:
        """Estimate the errors of all scalars of a result at the end of each load step.

        Scalars are, for example, forces and the contact radius. The scene is solved again with
        coarser discretisations. The errors follow from the differences between these solves and the
        result.
        """
        run, coarse = compare_with_coarse_solves(cls.of(result), result)
        return StatedErrors(tuple(run.errors()), coarse)

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

    def references(self) -> Sequence[Sequence[Values]]:
        """Return scalars of the scene by other methods at the end of each load step, by name.

        By default these are the known scalars of the pressing of uncoupled bodies.
        """
        return known_pressing(self.scene)

    def with_half_the_points(self) -> Self | None:
        """Return the solver of the scene with every second point of the indenter left out.

        The value is None if the shape of the indenter is not given by points.
        """
        half = self.scene.indenter.with_half_the_points()
        if half is None:
            return None
        return replace(self, scene=self.scene.model_copy(update={"indenter": half}))

    # ---- refinement

    @abstractmethod
    def of_run(self) -> Fineness:
        """Return the discretisation of a run with the settings of the scene file."""

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


def compare_with_coarse_solves(
    solver: DiscretisedSolver, result: Any, *, by_references: bool = True
) -> tuple[SolvedRun, tuple[CoarseSolveRecord, ...]]:
    """Run the coarse solves of a result, and collect the comparisons for its error estimate.

    Scalars with an independent reference (`known_pressing`) need no coarse solve. For the others,
    each discretisation parameter is changed in a separate comparison:

    - Increments, if a load step has an increment error: two solves on few cells, with the
      increments of the result and with twice as many, at least 32. If a load step has fewer than 8,
      also a solve with 8 increments, and the limit that 32 and 8 extrapolate to.
    - Cells, elements or rings: two or three solves with coarser discretisations, compared with the
      result. For small grids one of them is finer.
    - Other parameters of a mesh: one solve each, compared on the first coarse mesh.
    - Points of a measured indenter: one solve with half of them along a side, compared on the first
      coarse grid or mesh.

    Later coarse solves use the cheaper value of a parameter that has been compared. Its measured
    effect on the scalars is added before a coarse solve is compared with the result.

    Returns the scalars of the result with all comparisons, and the records of the coarse solves.

    solver         solver of the scene with variable discretisation
    result         result whose errors are estimated
    by_references  false to run the coarse solves for scalars with an independent reference, too
    """
    values, matters, features = (
        values_of(result),
        has_increment_error(result.scene),
        solver.features(result),
    )
    run = solver.fineness_of(result)
    most = max(step.contact for step in features)
    run = replace(run, tolerance=max(run.tolerance, coarse_tolerance(most / 2)))
    known: dict[tuple[bool, Fineness], Solved | None] = {}
    made: list[CoarseSolveRecord] = []

    def solved(differs: str, coarse: Fineness, by: DiscretisedSolver = solver) -> Solved | None:
        """Solve the scene with a coarse discretisation; return the result and its scalars.

        None is returned if the solver raised an error. Each discretisation is solved once and
        recorded. A repeated call returns the stored result.

        differs  text that describes the coarse discretisation in its record
        coarse   grid or mesh, increments and tolerance
        by       solver of the scene, or of the scene with a coarser indenter
        """
        key = by is solver, coarse
        if key not in known:
            shown, increments = solver.record_entry(coarse.space), coarse.increments
            record = CoarseSolveRecord(differs=differs, increments=increments, **shown)
            try:
                found = by.solve(coarse)
                known[key] = found, values_of(found)
                made.append(record.model_copy(update=_solver_work(found)))
            except SolverError as error:
                known[key] = None
                made.append(record.model_copy(update={"refused": str(error)}))
        return known[key]

    references = solver.references() if by_references else ()
    half = solver.with_half_the_points()
    known_all = _all_known(result.scene, values, references)
    shares = () if known_all else solver.shares_of(run.space)
    spaces = [solver.coarser(result, share, more) for _, share, more in shares]
    required: dict[Part, Sequence[bool]] = {solver.part: [True] * len(values)}
    required["increments"] = matters
    comparisons: list[Comparison] = []
    twice = (2.0,) * len(values)
    if half is not None:
        required["map"] = [True] * len(values)
        if references and (fewer := half.references()):
            comparisons.append(Comparison("map", references[0], fewer[0], twice))
    points = half

    effects: list[Effect] = []
    counts = coarse_increment_counts(run.increments, matters) if any(matters) else ()
    for few in (solver.few(replace(run, space=space), result) for space in spaces if counts):
        if first := solved(f"few {solver.cells}", few):
            differs = f"few {solver.cells}, other increments"
            others = [
                (count, other[1])
                for count in counts
                if (other := solved(differs, replace(few, increments=count)))
            ]
            for count, other_values in others:
                factors = ratios(few.increments, count, matters)
                comparisons.append(Comparison("increments", first[1], other_values, factors))
            if len(others) > 1:
                comparisons.append(compare_with_limit(first[1], few.increments, others, matters))
            fewest = fewest_increments(run.increments, matters)
            if other := solved(differs, replace(few, increments=fewest)):
                run, effects = replace(run, increments=fewest), [(first[1], other[1])]
            break

    changes: dict[str, Any] | None = None
    meshes: dict[float, tuple[Sequence[Values], Sequence[Features]]] = {}
    for (text, *_), space in zip(shares, spaces, strict=True):
        found = solved(
            text.format(solver.cells), replace(run, space=change_settings(space, **(changes or {})))
        )
        if not found:
            continue
        sides = zip(solver.cell_sides(found[0]), solver.cell_sides(result), strict=True)
        of_cells = add_effects(found[1], effects), solver.features(found[0])
        meshes[min(b / a for b, a in sides)] = of_cells
        for coarse in solver.mesh_coarse_solves(space, result) if changes is None else ():
            required[coarse.part] = [True] * len(values)
            further = {**(changes or {}), coarse.key: coarse.value}
            if other := solved(
                coarse.differs, replace(run, space=change_settings(space, **further))
            ):
                factors = (coarse.ratio,) * len(values)
                comparisons.append(Comparison(coarse.part, found[1], other[1], factors))
                effects.append((found[1], other[1]))
                found, changes = other, further
        if points is not None:
            same = replace(run, space=change_settings(space, **(changes or {})))
            if other := solved("every second point of the indenter", same, points):
                comparisons.append(Comparison("map", found[1], other[1], twice))
                points = None
        changes = changes or {}
    for ratio, (coarse_values, coarse_features) in meshes.items():
        factors = (ratio,) * len(values)
        comparisons.append(Comparison(solver.part, values, coarse_values, factors, coarse_features))
    return SolvedRun(
        scene=result.scene,
        values=values,
        tolerance=solver.residuals(result),
        features=features,
        comparisons=comparisons,
        required=required,
        neglected=solver.neglected_errors(result),
        part=solver.part,
        references=references,
    ), tuple(made)


def _all_known(
    scene: Scene, values: Sequence[Values], references: Sequence[Sequence[Values]]
) -> bool:
    """Return true if all scalars of a result are prescribed or known by another method.

    scene       solved scene
    values      scalars of the result at the end of each load step, by name
    references  scalars by other methods, one sequence for each method
    """
    return bool(references) and all(
        here.keys() <= known.keys() | prescribed_scalars(ramp, scene.rig)
        for ramp, here, known in zip(scene.load_path(), values, references[0], strict=True)
        if here["contact_area"].any()
    )


def solve_coarsest(
    solver: DiscretisedSolver, fineness: Fineness, solve: Callable[[Fineness], Any]
) -> Any:
    """Solve a scene with the coarsest discretisation whose cells resolve the contact.

    While the solve raises ContactNotResolved, the cells are doubled, at most `MAX_DOUBLINGS` times.
    The error of the last solve, and any other SolverError, is raised.

    solver    solver of the scene with variable discretisation
    fineness  discretisation of the first attempt
    solve     function that solves the scene with a discretisation
    """
    for _ in range(MAX_DOUBLINGS):
        try:
            return solve(fineness)
        except ContactNotResolved:
            fineness = solver.refine_fineness(fineness, {solver.part: DOUBLING})
    return solve(fineness)


def coarse_tolerance(cells: float) -> float:
    """Choose the tolerance of coarse solves so that it hardly changes the estimated errors.

    An error is estimated from the difference between a coarse and a fine solve. With m cells per
    contact radius in the coarse solve, this difference is at least about 1/m² of a scalar. The
    tolerance causes 1 % (`NEGLIGIBLE`) of the difference.

    cells  cells per contact radius in the coarse solves
    """
    return NEGLIGIBLE / PER_TOLERANCE / cells**2


def change_settings(space: Any, **changes: object) -> Any:
    """Return a copy of the mesh settings of a finite-element solve with some values changed.

    space    mesh settings; a grid or ring factor without changes is returned
    changes  new values by name of the setting
    """
    return space.model_copy(update=changes) if changes else space


def add_effects(found: Sequence[Values], effects: Sequence[Effect]) -> Sequence[Values]:
    """Correct the scalars of a coarse solve by the effects of parameters other than the cells.

    For example, a coarse solve may have fewer increments than the result. The change of each scalar
    by the number of increments is known from two other solves (a finer and a coarser one) and is
    added. After the correction, the scalars differ from those of the result by the effect of the
    cells only. Scalars that are absent in one of the solves are omitted.

    found    scalars of the coarse solve at the end of each load step, by name
    effects  scalars of a finer and of a coarser solve, one pair for each corrected parameter
    returns  corrected scalars at the end of each load step, by name
    """
    for effect in effects:
        found = [
            {n: x + fine[n] - coarse[n] for n, x in here.items() if n in fine and n in coarse}
            for here, fine, coarse in zip(found, *effect, strict=True)
        ]
    return found


def compare_with_limit(
    values: Sequence[Values],
    increments: Sequence[int],
    others: Sequence[tuple[Sequence[int], Sequence[Values]]],
    matters: Sequence[bool],
) -> Comparison:
    """Compare a solve of few increments with the limit of infinitely many increments.

    The limit is extrapolated from two solves with more increments, assuming an error proportional
    to a power of their number. The solve of few increments is not used for the extrapolation,
    because its error does not follow this power: two balls pushed to 0.9 µW by 1, 8 and 32
    increments have errors of the shift like 4.3 : 2.8 : 1. Load steps whose other solves have fewer
    increments are not compared here.

    values, increments  scalars of the solve at the end of each load step, and its increments
    others              increments and scalars of the two other solves, the one with most increments
                        first
    matters             for each load step, true if it has an increment error
    """
    (most, finest), (more, finer) = others
    powers = [r ** (BELIEVED * ORDERS["increments"]) for r in ratios(most, more, matters)]
    limit = [
        {n: x + (x - less[n]) / (power - 1) for n, x in here.items() if n in less and power > 1}
        for here, less, power in zip(finest, finer, powers, strict=True)
    ]
    # The coarsening factor of a solve without error is 0; 1 leaves the step out.
    factors = [float(r >= 1) for r in ratios(increments, most, matters)]
    return Comparison("increments", values, limit, factors)


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


def _solver_work(found: Any) -> Mapping[str, int]:
    """Sum the iterations and the convolutions of all increments of a coarse solve, by name.

    The numbers are stored in the record of the solve. Numbers that the solver does not count are
    absent.

    found  result of the solve
    """
    names = ("iterations", "convolutions")
    return {
        name: sum(getattr(increment, name) for increment in found.increments)
        for name in names
        if getattr(found.increments[0], name, None) is not None
    }


def coarse_increment_counts(
    counts: Sequence[int], matters: Sequence[bool]
) -> list[tuple[int, ...]]:
    """Choose the numbers of increments of the coarse solves that measure the increment error.

    The first solve has twice the increments of the result in each load step, and at least 32. With
    more increments than the result, the difference is nearer to its error than with fewer. If a
    load step has fewer than 8, a second solve has 8 in each load step. Load steps without an
    increment error keep their number, because their result does not depend on the increments.

    counts   number of increments of each load step of the result
    matters  for each load step, true if it has an increment error
    """
    found = [change_increments(counts, matters, lambda count: max(MANY, 2 * count))]
    if any(matter and count < FEW for count, matter in zip(counts, matters, strict=True)):
        found.append(change_increments(counts, matters, lambda _: FEW))
    return found


def fewest_increments(counts: Sequence[int], matters: Sequence[bool]) -> tuple[int, ...]:
    """Choose the numbers of increments of the coarse solves that measure the error by the cells.

    With other numbers than the result, one more solve on few cells measures their effect. They are
    chosen if they save more increments than this solve takes, in the three solves of the cells.

    counts   number of increments of each load step of the result
    matters  for each load step, true if it has an increment error
    """
    few = change_increments(counts, matters, lambda count: min(FEW, count))
    return few if len(SHARES) * (sum(counts) - sum(few)) > sum(few) else tuple(counts)


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


def ratios(
    counts: Sequence[int], others: Sequence[int], matters: Sequence[bool]
) -> tuple[float, ...]:
    """Compute the coarsening factor of the increments between two solves, for each load step.

    The error at the end of a load step includes the errors of earlier load steps. The factor is
    therefore chosen among all load steps up to this one that have an increment error: it is the
    ratio of the two numbers of increments nearest to 1, which gives the largest error estimate.
    Without such a load step, the factor is 1.

    counts, others  numbers of increments of each load step in the two solves
    matters         for each load step, true if it has an increment error
    """
    found, nearest = [], 1.0
    for count, other, matter in zip(counts, others, matters, strict=True):
        ratio = count / other
        if matter and (nearest == 1 or abs(log(ratio)) < abs(log(nearest))):
            nearest = ratio
        found.append(nearest)
    return tuple(found)
