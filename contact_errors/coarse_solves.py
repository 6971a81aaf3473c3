"""Coarse solves of a result, and their comparison with it: one procedure for all solvers.

A solver is described by its discretisation parameters, which are coarsened for error estimates and
refined for a requested accuracy. A difference between levels needs no tolerance below a fraction of
it, and no more increments than the fewest whose effect is known.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import ceil, log
from typing import Any, ClassVar, Self, TypeAlias

from contact_errors.cost_estimate import Work
from contact_errors.error_formula import (
    PER_TOLERANCE,
    Comparison,
    Features,
    SolvedRun,
    Values,
    values_of,
)
from contact_scene import Scene
from contact_scene.quantities.stated_error import (
    CoarseSolveRecord,
    Part,
    StatedErrors,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import SolverError
from contact_scene.stepping.increment_error import with_error

# Coarse solves: description, fraction of the cells along a side, and further cells. Each has the
# edges of zones at other positions within the cells.
SHARES = ("2/5 of the {}", 2 / 5, 0), ("half the {} plus 2", 1 / 2, 2)
# A step with fewer increments is compared with finer histories, because halves of few increments do
# not converge regularly.
FEW, MANY = 4, (32, 8)
LEAST_TOLERANCE = 1e-13


# Largest part of the difference between two levels that the tolerance of coarse solves may cause.
NEGLIGIBLE = 1e-2

# Refinement factors by the part of the error.
Refinement: TypeAlias = Mapping[Part, float]
# A result with its numbers.
Solved: TypeAlias = tuple[Any, Sequence[Values]]
# Numbers of two solves that differ in one parameter: of the finer and of the coarser one.
Effect: TypeAlias = tuple[Sequence[Values], Sequence[Values]]


@dataclass(frozen=True)
class Fineness:
    """Discretisation of a solve.

    space       grid of cells, mesh of elements, or multiple of the rings
    increments  of every load step
    tolerance   bound of every residual
    edges       false for cells without edge correction
    """

    space: Any
    increments: tuple[int, ...]
    tolerance: float
    edges: bool = True


@dataclass(frozen=True)
class CoarseSolve:
    """A coarse solve in a parameter of a mesh.

    part        part of the error
    differs     description
    key, value  parameter, and its coarser value
    ratio       coarsening factor
    """

    part: Part
    differs: str
    key: str
    value: Any
    ratio: float


@dataclass(frozen=True)
class DiscretisedSolver(ABC):
    """Solver of one scene with its discretisation parameters.

    discretisation  parameters that are not changed, and the coarsest values of the others
    chosen_plan     plan of a result; None for that of the first level of refinement
    """

    scene: Scene
    discretisation: Any
    chosen_plan: Any = None

    # Part of the error, name of the cells, their largest number along a side (over the radius, or
    # multiple of the rings), and coarse solves.
    part: ClassVar[Part]
    cells: ClassVar[str]
    most: ClassVar[float]
    shares: ClassVar[Sequence[tuple[str, float, int]]] = SHARES

    @classmethod
    @abstractmethod
    def of(cls, result: Any) -> Self:
        """Return the solver with the discretisation of a result."""

    @classmethod
    def stated_errors(cls, result: Any) -> StatedErrors:
        """Estimate the errors of all numbers at the ends of all steps, by coarse solves."""
        run, coarse = solved_run(cls.of(result), result)
        return StatedErrors(tuple(run.errors()), coarse)

    @property
    @abstractmethod
    def plan(self) -> Any:
        """Effects and increments."""

    @abstractmethod
    def solve(self, fineness: Fineness, progress: Any = None, store: Any = None) -> Any:
        """Solve the scene; raises a SolverError.

        progress, store   observer of increments, and checkpoint store
        """

    @abstractmethod
    def space_of(self, result: Any) -> Any:
        """Return the grid, mesh or multiple of the rings of a result."""

    def fineness_of(self, result: Any) -> Fineness:
        """Return the discretisation of a result."""
        return Fineness(self.space_of(result), result.plan.increments, result.tolerance)

    # ---- coarse solves

    @abstractmethod
    def coarser(self, result: Any, share: float, more: int) -> Any:
        """Return a grid, mesh or rings with a fraction of the cells along a side plus `more`
        cells."""

    def of_mesh(self, base: Any, result: Any) -> Iterable[CoarseSolve]:
        """Return coarse solves in the other parameters of a mesh; `base` is that of a coarse
        solve."""
        return ()

    def few(self, coarse: Fineness, result: Any) -> Fineness:
        """Return the discretisation of the solves that compare increments."""
        return coarse

    @abstractmethod
    def sides(self, result: Any) -> tuple[float, ...]:
        """Return the sides of a cell."""

    @abstractmethod
    def shown(self, space: Any) -> Mapping[str, Any]:
        """Return the discretisation for the record."""

    @abstractmethod
    def features(self, result: Any) -> Sequence[Features]:
        """Return the resolution at the end of each step."""

    def residuals(self, result: Any) -> Sequence[float]:
        """Return the tolerance of the residuals, for each load step."""
        return [result.tolerance] * len(result.steps)

    def neglected(self, result: Any) -> Mapping[str, float]:
        """Return relative errors of numbers by effects that the solver neglects."""
        return {}

    # ---- refinement

    @abstractmethod
    def first(self) -> Any:
        """Return the grid, mesh or rings of the coarsest level."""

    @abstractmethod
    def finer(self, space: Any, by: Refinement) -> Any:
        """Return the grid, mesh or rings, refined by at least these factors."""

    def refined(self, fineness: Fineness, by: Refinement) -> Fineness:
        """Return the discretisation, refined by at least these factors.

        Steps without an increment error keep their increments.
        """
        return replace(
            fineness,
            space=self.finer(fineness.space, by),
            increments=tuple(
                ceil(by.get("increments", 1.0) * count - 1e-9) if matters else count
                for count, matters in zip(fineness.increments, with_error(self.scene), strict=True)
            ),
            tolerance=max(LEAST_TOLERANCE, fineness.tolerance / by.get("tolerance", 1.0)),
        )

    @abstractmethod
    def work(self, fineness: Fineness) -> Work:
        """Return the size of a solve."""

    @abstractmethod
    def memory(self, fineness: Fineness) -> int:
        """Estimate the largest memory of a solve [byte]."""


def solved_run(
    solver: DiscretisedSolver, result: Any
) -> tuple[SolvedRun, tuple[CoarseSolveRecord, ...]]:
    """Make the coarse solves of a result, each once.

    The increments are compared on few cells, and the other parameters of a mesh on its coarsest
    level. All further coarse solves have the coarsest value of these parameters. Their effects on
    the numbers are added where a coarse solve is compared with the run.
    """
    values, matters, features = values_of(result), with_error(result.scene), solver.features(result)
    run = solver.fineness_of(result)
    run = replace(run, tolerance=max(run.tolerance, coarse_tolerance(features)))
    known: dict[Fineness, Solved | None] = {}
    made: list[CoarseSolveRecord] = []

    def solved(differs: str, coarse: Fineness) -> Solved | None:
        """Return a coarse solve with its numbers; None for a refused one."""
        if coarse not in known:
            shown, increments = solver.shown(coarse.space), coarse.increments
            record = CoarseSolveRecord(differs=differs, increments=increments, **shown)
            try:
                found = solver.solve(coarse)
                known[coarse] = found, values_of(found)
                made.append(record.model_copy(update=_spent(found)))
            except SolverError as error:
                known[coarse] = None
                made.append(record.model_copy(update={"refused": str(error)}))
        return known[coarse]

    def compare(part: Part, base: Sequence[Values], coarse: Sequence[Values], ratio: float) -> None:
        comparisons.append(Comparison(part, base, coarse, [ratio] * len(values)))

    spaces = [solver.coarser(result, share, more) for _, share, more in solver.shares]
    required: dict[Part, Sequence[bool]] = {solver.part: [True] * len(values)}
    required["increments"] = matters
    comparisons: list[Comparison] = []

    effects: list[Effect] = []
    recuts = dict.fromkeys(recounted(run.increments, matters)) if any(matters) else ()
    for few in (solver.few(replace(run, space=space), result) for space in spaces if recuts):
        if first := solved(f"few {solver.cells}", few):
            for counts in recuts:
                differs = f"few {solver.cells}, other increments"
                other = solved(differs, replace(few, increments=counts))
                if other:
                    factors = ratios(few.increments, counts, matters)
                    comparisons.append(Comparison("increments", first[1], other[1], factors))
                    if sum(counts) < sum(run.increments):
                        run, effects = replace(run, increments=counts), [(first[1], other[1])]
            break

    changes: dict[str, Any] | None = None
    for (text, *_), space in zip(solver.shares, spaces, strict=True):
        found = solved(text.format(solver.cells), replace(run, space=changed(space, changes)))
        if not found:
            continue
        sides = zip(solver.sides(found[0]), solver.sides(result), strict=True)
        compare(solver.part, values, added(found[1], effects), min(b / a for b, a in sides))
        for coarse in solver.of_mesh(space, result) if changes is None else ():
            required[coarse.part] = [True] * len(values)
            further = {**(changes or {}), coarse.key: coarse.value}
            if other := solved(coarse.differs, replace(run, space=changed(space, further))):
                compare(coarse.part, found[1], other[1], coarse.ratio)
                effects.append((found[1], other[1]))
                found, changes = other, further
        changes = changes or {}
    return SolvedRun(
        scene=result.scene,
        values=values,
        tolerance=solver.residuals(result),
        features=features,
        comparisons=comparisons,
        required=required,
        neglected=solver.neglected(result),
    ), tuple(made)


def coarse_tolerance(features: Sequence[Features]) -> float:
    """Return the tolerance of coarse solves.

    The difference between two levels of m cells per contact radius is at least about 1/m² of a
    number. The error by the tolerance is `NEGLIGIBLE` of it on half of the cells of the run.
    """
    most = max(step.contact for step in features)
    return NEGLIGIBLE / PER_TOLERANCE * (2 / most) ** 2


def changed(space: Any, changes: Mapping[str, Any] | None) -> Any:
    """Return a mesh with other parameters."""
    return space.model_copy(update=changes) if changes else space


def added(found: Sequence[Values], effects: Sequence[Effect]) -> Sequence[Values]:
    """Add effects to the numbers of a coarse solve."""
    for effect in effects:
        found = [
            {n: x + fine[n] - coarse[n] for n, x in here.items() if n in fine and n in coarse}
            for here, fine, coarse in zip(found, *effect, strict=True)
        ]
    return found


def at_ends(result: Any, resolved: Callable[[Any], Features]) -> Sequence[Features]:
    """Return the resolution at the end of each step; without contact that of the previous step."""
    found: list[Features] = []
    for end in result.steps:
        found.append(resolved(end) if end.contact_area else found[-1])
    return found


def slip_zone(end: Any, per_length: float) -> tuple[float | None, float | None]:
    """Return the stick radius and the width of the slip annulus of a contact of revolution, in
    cells."""
    if end.stick_radius is None:
        return None, None
    slips = end.status is not ContactStatus.FULL_STICK
    annulus = per_length * (end.contact_radius - end.stick_radius) if slips else None
    return per_length * end.stick_radius, annulus


def _spent(found: Any) -> Mapping[str, int]:
    """Return the work of a solve."""
    names = ("iterations", "convolutions")
    return {
        name: sum(getattr(increment, name) for increment in found.increments)
        for name in names
        if getattr(found.increments[0], name, None) is not None
    }


def recounted(counts: Sequence[int], matters: Sequence[bool]) -> list[tuple[int, ...]]:
    """Return the increments of two coarse solves; steps without increment error keep theirs."""
    both = [
        _pair(count) if matter else (count, count)
        for count, matter in zip(counts, matters, strict=True)
    ]
    return [tuple(pair[level] for pair in both) for level in (0, 1)]


def ratios(
    counts: Sequence[int], others: Sequence[int], matters: Sequence[bool]
) -> tuple[float, ...]:
    """Return the coarsening factor of the increments at the end of each step.

    A step that depends on the history has the factor nearest to 1 of the steps so far. The factor
    is 1 if no step so far has an increment error.
    """
    found, nearest = [], 1.0
    for count, other, matter in zip(counts, others, matters, strict=True):
        ratio = count / other
        if matter and (nearest == 1 or abs(log(ratio)) < abs(log(nearest))):
            nearest = ratio
        found.append(nearest)
    return tuple(found)


def _pair(count: int) -> tuple[int, int]:
    if count < FEW:
        return MANY
    if count < 2 * FEW:
        return 4 * count, 2 * count
    return count // 2, max(FEW, count // 4)
