"""Requested accuracy: refine until stated errors meet it, or a limit on time or memory is reached.

The first level determines the numbers that the request applies to, and refuses a request that
cannot be met. A parameter is refined by (part / allowed)^(1/(0.6 p)), at most 4 times per level.
Each part of an error may use an equal share of the request. If a number has not converged the cells
are doubled.
"""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np

from contact_errors.coarse_solves import (
    DiscretisedSolver,
    Fineness,
    Refinement,
    solved_run,
)
from contact_errors.cost_estimate import estimated_seconds
from contact_errors.error_formula import (
    BELIEVED,
    ORDERS,
    UNKNOWN,
    SolvedRun,
    Values,
    largest_so_far,
    scale,
)
from contact_errors.stress_errors import largest_stresses
from contact_scene.accuracy import LARGEST_TENSION, AccuracyRequest
from contact_scene.machine import available_bytes
from contact_scene.quantities.stated_error import (
    AccuracyReached,
    AccuracySettings,
    ErrorStatus,
    Part,
    StatedError,
    StatedErrors,
)
from contact_scene.solver_errors import AccuracyOutOfReach, ContactNotResolved, SolverError

# Context of the solve of a discretisation: its observer of increments, or its checkpoint store.
InContext: TypeAlias = Callable[[Any], AbstractContextManager[Any]]
# Called after each level: its number, the requested and the reached errors.
Estimated = Callable[[int, Mapping[str, float], Mapping[str, float | None]], None]

# Errors must be below 1/1.15 of the request, because stopping at the first error below a limit
# selects errors that are too small.
SPARE = 1.15
# Largest and least refinement of the cells per level, and their refinement for a number not
# converged.
MAX_AT_ONCE, LEAST_AT_ONCE, UNCONVERGED = 4.0, 1.15, 2.0
# Doublings of the cells of the first level until they resolve the contact.
MAX_DOUBLINGS = 5
MAX_ROUNDS = 7
# The first level may overestimate an error by the first factor. Refinements above the second one
# cannot be computed.
DOUBT, FURTHEST = 4.0, 1e4
# A number below this fraction of its natural size is zero with round-off.
ROUND_OFF = 1e-7


def _no_context(fineness: object) -> AbstractContextManager[None]:
    """Context of a solve without observer or checkpoint store."""
    return nullcontext()


@dataclass(frozen=True)
class RefinementLevel:
    """A result with its error estimates.

    values, stated  numbers and their errors at the ends of the steps
    run             the result with its coarse solves
    seconds         elapsed time of the solve with its coarse solves
    processor_seconds
                    CPU time of the same solves
    """

    fineness: Fineness
    result: Any
    values: Sequence[Values]
    stated: StatedErrors
    run: SolvedRun
    seconds: float
    processor_seconds: float

    def largest(self, name: str) -> float:
        """Return the largest size of a number in the history; 0 for an absent number."""
        return float(np.max(largest_so_far(self.values)[-1].get(name, 0.0)))

    def errors(self, name: str) -> Iterator[StatedError]:
        """Return the errors of a number at the ends of all steps that have it."""
        return (step[name] for step in self.stated.steps if name in step)

    def reached(self, name: str) -> float | None:
        """Return the largest error of a number over its largest size; None if any has not
        converged."""
        errors = list(self.errors(name))
        if any(e.error is None or e.status is ErrorStatus.NOT_CONVERGED for e in errors):
            return None
        return float(max(np.max(e.error or 0.0) for e in errors)) / self.largest(name)

    def meets(self, shares: Mapping[str, float]) -> bool:
        """Return true if all errors meet the request with the margin `SPARE`."""
        reached = {name: self.reached(name) for name in shares}
        return all(r is not None and SPARE * r <= shares[name] for name, r in reached.items())

    def needed(self, shares: Mapping[str, float], believed: float = BELIEVED) -> Refinement:
        """Determine the refinement of every parameter that meets a request.

        believed  fraction of the convergence orders: 1 for the most likely refinement
        """
        factors: dict[Part, float] = {}
        for name, share in shares.items():
            of_cells = self.run.order(name)
            for error in self.errors(name):
                parts = {p: float(np.max(s)) / self.largest(name) for p, s in error.parts.items()}
                allowed = share / SPARE / max(1, sum(size > 0 for size in parts.values()))
                wanted: dict[Part, float] = {
                    part: (size / allowed) ** (1 / (believed * ORDERS.get(part, of_cells)))
                    for part, size in parts.items()
                    if part != "neglected" and size > allowed
                }
                if error.status is ErrorStatus.NOT_CONVERGED:
                    wanted[self.part] = max(wanted.get(self.part, 1.0), UNCONVERGED)
                factors |= {p: max(factor, factors.get(p, 1.0)) for p, factor in wanted.items()}
        return factors

    @property
    def part(self) -> Part:
        """Part of the error by the cells."""
        return next(iter(self.run.required))


@dataclass(frozen=True)
class Levels:
    """Refinement levels of a scene by one solver.

    stress_at  load step at whose end the largest tensile stress is requested, or None
    watching   context of each solve, with its progress
    keeping    context of each solve, with its checkpoint store
    """

    solver: DiscretisedSolver
    stress_at: int | None = None
    watching: InContext = _no_context
    keeping: InContext = _no_context

    def first(self) -> RefinementLevel:
        """Solve the coarsest level whose cells resolve the contact; raises a SolverError."""
        plan = self.solver.plan
        fineness = Fineness(
            self.solver.first(), plan.increments, self.solver.discretisation.tolerance
        )
        for _ in range(MAX_DOUBLINGS):
            try:
                return self.solved(fineness)
            except ContactNotResolved:
                fineness = self.solver.refined(fineness, {self.solver.part: UNCONVERGED})
        return self.solved(fineness)

    def solved(self, fineness: Fineness) -> RefinementLevel:
        """Solve a level with its errors; raises a SolverError."""
        began, began_processor = time.perf_counter(), time.process_time()
        with self.keeping(fineness) as store, self.watching(fineness) as progress:
            result = self.solver.solve(fineness, progress, store)
        run, coarse = solved_run(self.solver, result)
        values, errors = list(run.values), list(run.errors())
        if self.stress_at is not None:
            at, stated = self.stress_at - 1, StatedErrors(tuple(errors), coarse)
            wanted = (f"{LARGEST_TENSION}@body",)
            for value, error in largest_stresses(result, stated, wanted, self.stress_at).values():
                values[at] = {**values[at], LARGEST_TENSION: np.array([abs(value)])}
                errors[at] = {**errors[at], LARGEST_TENSION: error or UNKNOWN}
        return RefinementLevel(
            fineness=self.solver.fineness_of(result),
            result=result,
            values=values,
            stated=StatedErrors(tuple(errors), coarse),
            run=run,
            seconds=time.perf_counter() - began,
            processor_seconds=time.process_time() - began_processor,
        )

    def following(self, level: RefinementLevel, by: Refinement) -> tuple[Fineness, float]:
        """Return a finer discretisation, and the expected CPU time of its solves [s]."""
        finer = self.solver.refined(level.fineness, by)
        works = self.solver.work(level.fineness), self.solver.work(finer)
        return finer, estimated_seconds(level.processor_seconds, *works)

    def settings(self, fineness: Fineness) -> AccuracySettings:
        """Return the discretisation for the summary."""
        return AccuracySettings(
            increments=fineness.increments,
            tolerance=fineness.tolerance,
            **self.solver.shown(fineness.space),
        )

    def too_large(self, fineness: Fineness) -> str | None:
        """Return the reason if a level exceeds the solver's limits or the memory, else None."""
        ((name, size),) = self.solver.shown(fineness.space).items()
        shown = f"{name} = {size}"
        if np.max(size) > self.solver.most:
            return f"a level with {shown} exceeds the limit {self.solver.most:g}"
        needed, available = self.solver.memory(fineness), available_bytes()
        if needed <= available:
            return None
        return (
            f"a level with {shown} needs about {needed / 2**30:.1f} GiB, and "
            f"{available / 2**30:.1f} GiB are available"
        )


def bounded(by: Refinement, cells: Part, most: float = MAX_AT_ONCE) -> Refinement:
    """Limit all refinement factors, and refine at least the cells."""
    first = {cells, "increments"}
    found = {part: min(by[part], most if part in first else most**2) for part in by}
    if found.keys() <= first and max(found.values(), default=1.0) < LEAST_AT_ONCE:
        found[cells] = LEAST_AT_ONCE
    return found


@dataclass(frozen=True)
class Refined:
    """The finest level, and its accuracy compared with the request."""

    level: RefinementLevel
    accuracy: AccuracyReached


@dataclass(frozen=True)
class Price:
    """Cost of one request.

    settings  discretisation of the last level
    seconds   CPU time of the first and the last level [s]
    memory    of the last level [byte]
    fits      true if the memory is available
    """

    settings: AccuracySettings
    seconds: float
    memory: int
    fits: bool


def refine(
    levels: Levels,
    request: AccuracyRequest,
    most_seconds: float = np.inf,
    estimated: Estimated | None = None,
) -> Refined:
    """Solve finer and finer levels until a request is met.

    If a limit is reached, or the next level has no result, the last level is returned with the
    reason. Raises AccuracyOutOfReach for a request that cannot be met, and the errors of the first
    level.

    most_seconds  limit of the total time; no level starts that is expected to exceed it
    estimated     called with the errors of each level
    """
    level = levels.first()
    (shares, left_out), spent, rounds, stopped = targets_of(request, level, levels), 0.0, 0, None
    while stopped is None:
        spent, rounds = spent + level.seconds, rounds + 1
        reached = {name: level.reached(name) for name in shares}
        if estimated is not None:
            estimated(rounds, shares, reached)
        if level.meets(shares):
            break
        by = bounded(level.needed(shares), level.part)
        following, seconds = levels.following(level, by)
        shared = max(1.0, level.seconds / max(level.processor_seconds, 1e-3))
        stopped = levels.too_large(following)
        if rounds == MAX_ROUNDS:
            stopped = f"{rounds} rounds have not met it"
        elif stopped is None and spent + shared * seconds > most_seconds:
            stopped = (
                f"after {spent:.3g} s the next round would take about {shared * seconds:.2g} s, "
                f"beyond the {most_seconds:.3g} s of --most-seconds"
            )
        if stopped is None:
            try:
                level = levels.solved(following)
            except SolverError as error:
                stopped = f"the next round has no answer: {error}"
    accuracy = AccuracyReached(
        asked=shares,
        reached=reached,
        met=stopped is None,
        settings=levels.settings(level.fineness),
        rounds=rounds,
        left_out=left_out,
        stopped=stopped,
    )
    return Refined(level, accuracy)


def price(levels: Levels, first: RefinementLevel, request: AccuracyRequest) -> Price:
    """Estimate the cost of a request from the first level; raises AccuracyOutOfReach."""
    shares, _ = targets_of(request, first, levels)
    by = bounded(first.needed(shares, believed=1.0), first.part, FURTHEST)
    fineness, seconds = levels.following(first, {} if first.meets(shares) else by)
    fits, memory = levels.too_large(fineness) is None, levels.solver.memory(fineness)
    return Price(levels.settings(fineness), first.processor_seconds + seconds, memory, fits)


def targets_of(
    request: AccuracyRequest, level: RefinementLevel, levels: Levels
) -> tuple[dict[str, float], dict[str, str]]:
    """Determine the numbers that a request applies to with their largest errors relative to their
    largest values, and the reasons why it does not apply to others, by a first result.

    Raises AccuracyOutOfReach for a named number that is absent or infinite, and for a number that
    the largest possible discretisation will not determine as requested.
    """
    left_out = {name: why for name in request.shares() if (why := _why_left_out(name, level))}
    for name in request.named:
        if name in left_out:
            raise AccuracyOutOfReach(f"{name} can have no requested accuracy: {left_out[name]}")
    shares = {name: share for name, share in request.shares().items() if name not in left_out}
    doubted = {name: DOUBT * share for name, share in shares.items()}
    needed = bounded(level.needed(doubted, believed=1.0), level.part, FURTHEST)
    finest = levels.solver.refined(level.fineness, needed)
    if needed.get(level.part, 1.0) > UNCONVERGED and (too_large := levels.too_large(finest)):
        raise AccuracyOutOfReach(f"no grid can meet the request: {too_large}")
    return shares, left_out


def _why_left_out(name: str, level: RefinementLevel) -> str:
    """Return the reason why a number has no accuracy; empty if it has one."""
    if not any(name in step for step in level.stated.steps):
        return "the results of this scene by this solver do not contain it"
    if name == "peak_pressure" and any(features.infinite for features in level.run.features):
        return "its exact value is infinite"
    natural = max(scale(name, step) for step in level.run.values)
    return "it is zero throughout" if level.largest(name) <= ROUND_OFF * natural else ""
