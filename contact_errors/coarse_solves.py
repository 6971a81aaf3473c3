"""Coarse solves of a result, and their comparison with it: one procedure for all solvers.

A solver is described by its discretisation parameters, which are coarsened for error estimates and
refined for a requested accuracy. The first coarse solves change the cells (elements, rings) alone.
One of them is the base of the comparisons in which the other parameters of a mesh and the
increments are changed.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import ceil, log
from typing import Any, ClassVar, Self, TypeAlias

from contact_errors.cost_estimate import Work, estimated_seconds
from contact_errors.error_formula import Comparison, Features, SolvedRun
from contact_errors.values import Values, values_of
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
SHARES = ("half the {} plus 2", 1 / 2, 2), ("2/5 of the {}", 2 / 5, 0)
# A step with fewer increments is compared with finer histories, because halves of few increments do
# not converge regularly.
FEW, MANY = 4, (32, 8)
LEAST_TOLERANCE = 1e-13


# Numbers of two solves that differ in their increments; empty without such solves.
Effect: TypeAlias = tuple[Sequence[Values], ...]


@dataclass(frozen=True)
class Refinement:
    """Refinement factors.

    cells       of the cells along a side, or of the elements or rings over the radius
    increments  of the increments of all steps with an increment error
    others      of the remaining parameters, by the part of the error
    """

    cells: float = 1.0
    increments: float = 1.0
    others: Mapping[Part, float] = field(default_factory=dict)


@dataclass(frozen=True)
class Fineness:
    """Discretisation of a solve.

    space       grid of cells, mesh of elements, or multiple of the rings
    increments  of every load step
    tolerance   bound of every residual
    """

    space: Any
    increments: tuple[int, ...]
    tolerance: float


@dataclass(frozen=True)
class CoarseSolve:
    """A coarse solve to be made.

    part     discretisation parameter that is coarsened
    differs  description
    space    see `Fineness`
    ratio    coarsening factor; None where it is that of the sides of the cells
    """

    part: Part
    differs: str
    space: Any
    ratio: float | None = None


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

    def few(self, base: Any, result: Any) -> Any:
        """Return the grid, mesh or rings of the solves that compare increments."""
        return base

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
                ceil(by.increments * count - 1e-9) if matters else count
                for count, matters in zip(fineness.increments, with_error(self.scene), strict=True)
            ),
            tolerance=max(LEAST_TOLERANCE, fineness.tolerance / by.others.get("tolerance", 1.0)),
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

    The first coarse solve has the increments of the run. The increments are then changed on its
    cells, or on a coarser grid if this takes less time. All further coarse solves have the fewest
    increments, and the effect of the increments on the numbers is added.
    """
    run, made = solver.fineness_of(result), list[CoarseSolveRecord]()
    known: dict[Fineness, Any] = {run: result}

    def solved(differs: str, coarse: Fineness) -> Any:
        """Return the result of a coarse solve; None for a refused one."""
        if coarse not in known:
            shown, increments = solver.shown(coarse.space), coarse.increments
            record = CoarseSolveRecord(differs=differs, increments=increments, **shown)
            try:
                known[coarse] = solver.solve(coarse)
                made.append(record.model_copy(update=_spent(known[coarse])))
            except SolverError as error:
                known[coarse] = None
                made.append(record.model_copy(update={"refused": str(error)}))
        return known[coarse]

    def compare(base: Any, coarse: CoarseSolve, fineness: Fineness, effect: Effect = ()) -> Any:
        """Compare a coarse solve with its base, and return it; None for a refused one."""
        required[coarse.part] = [True] * len(values)
        found = solved(coarse.differs, fineness)
        if found is not None:
            sides = zip(solver.sides(found), solver.sides(base), strict=True)
            ratio = coarse.ratio or min(there / here for there, here in sides)
            both = values_of(base), added(values_of(found), effect)
            comparisons.append(Comparison(coarse.part, *both, [ratio] * len(values)))
        return found

    values, matters = values_of(result), with_error(result.scene)
    comparisons: list[Comparison] = []
    required: dict[Part, Sequence[bool]] = {}
    of_cells = [
        CoarseSolve(solver.part, text.format(solver.cells), solver.coarser(result, share, more))
        for text, share, more in solver.shares
    ]
    base = space = None
    while base is None and of_cells:
        coarse = of_cells.pop(0)
        space = coarse.space
        base = compare(result, coarse, replace(run, space=space))
    if base is not None:
        others = [*dict.fromkeys(recounted(run.increments, matters))] if any(matters) else []
        few, fewest = replace(run, space=_for_increments(solver, run, space, result, others)), run
        first, effect = solved("few increments", few), Effect()
        for counts in others if first else ():
            found = solved("other increments", replace(few, increments=counts))
            if found is not None:
                both = values_of(first), values_of(found)
                factors = ratios(run.increments, counts, matters)
                comparisons.append(Comparison("increments", *both, factors))
                if sum(counts) < sum(fewest.increments):
                    fewest, effect = replace(run, increments=counts), both
        for coarse in of_cells:
            compare(result, coarse, replace(fewest, space=coarse.space), effect)
        for coarse in solver.of_mesh(space, result):
            compare(base, coarse, replace(fewest, space=coarse.space), effect)
    return SolvedRun(
        scene=result.scene,
        values=values,
        tolerance=solver.residuals(result),
        features=solver.features(result),
        comparisons=comparisons,
        required={**required, "increments": matters},
        neglected=solver.neglected(result),
    ), tuple(made)


def added(found: Sequence[Values], effect: Effect) -> Sequence[Values]:
    """Add the effect of increments: the difference of the numbers with many and with few of
    them."""
    return (
        found
        if not effect
        else [
            {name: here[name] + many[name] - few[name] for name in here if name in {*many} & {*few}}
            for here, many, few in zip(found, *effect, strict=True)
        ]
    )


def _for_increments(
    solver: DiscretisedSolver, run: Fineness, space: Any, result: Any, others: Sequence[Any]
) -> Any:
    """Return the cells of the first coarse solve, or fewer if all solves then take less time."""
    few = solver.few(space, result)
    unit = solver.work(run)

    def seconds(cells: Any, solves: Sequence[Any]) -> float:
        works = (solver.work(Fineness(cells, counts, run.tolerance)) for counts in solves)
        return sum(estimated_seconds(1.0, unit, work) for work in works)

    return few if seconds(few, [run.increments, *others]) < seconds(space, others) else space


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
