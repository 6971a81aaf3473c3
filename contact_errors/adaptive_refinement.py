"""Adaptive refinement of the discretisation of a contact solve, to a requested accuracy.

Used by the option `--accuracy` of the commands and by the table [accuracy] of a scene. A scene is
solved on finer and finer levels, until the stated errors meet the request or a limit on time or
memory is reached. The result of the first level determines the scalars that the request applies to.
A request that cannot be met is refused after the first level.

The largest parts of an error share equally what the smaller ones leave of the requested error. A
parameter of the discretisation is refined by the factor (part of the error / allowed part)^(1/p),
where p is its convergence order. The factor of the cells and of the increments is at most 4 per
level, that of other parameters at most 16. If an error estimate has not converged, the cells are
refined by at least 2.
"""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Self, TypeAlias

import numpy as np

from contact_errors.coarse_solves import compare_with_coarse_solves, solve_coarsest
from contact_errors.cost_estimate import estimated_run_seconds
from contact_errors.error_formula import (
    ORDERS,
    SolvedRun,
    Values,
    characteristic_size,
    largest_so_far,
    unknown_error,
)
from contact_errors.stress_errors import largest_stresses
from contact_results.radial_method import radial_advice
from contact_results.stress.loaded_bodies import RADIAL
from contact_scene.accuracy import LARGEST_TENSION, AccuracyRequest
from contact_scene.contact_features import EDGE, PEAK
from contact_scene.discretised import DiscretisedSolver, Fineness, Refinement, Work
from contact_scene.machine import available_bytes
from contact_scene.quantities.per_length import SHOWN_NAMES, rename_keys, shown_name
from contact_scene.quantities.stated_error import (
    AccuracyReached,
    AccuracySettings,
    ErrorStatus,
    Part,
    StatedError,
    StatedErrors,
)
from contact_scene.solver_errors import AccuracyOutOfReach, SolverError

# Function from a discretisation to the context of its solve, which yields an observer of increments
# or a checkpoint store.
InContext: TypeAlias = Callable[[Any], AbstractContextManager[Any]]
# Function that is called after each level with its number, the requested and the reached errors.
Estimated = Callable[[int, Mapping[str, float], Mapping[str, float | None]], None]

# Margin: errors must be below 1/1.15 of the request, because stopping at the first estimate below a
# limit prefers estimates that are too small.
SPARE = 1.15
# Largest and least refinement factor of the cells per level, and their factor for a scalar whose
# error has not converged.
MAX_AT_ONCE = 4.0
LEAST_AT_ONCE = 1.15
UNCONVERGED = 2.0
MAX_ROUNDS = 7
# Consecutive rounds without a smaller error after which the refinement stops. Estimates scatter, so
# that a single larger one says little.
MAX_WORSE = 2
# Parts of an error that no refinement of the discretisation reduces, with their causes.
UNREFINED: Mapping[Part, str] = MappingProxyType(
    {"map": "the points of the indenter", "neglected": "neglected effects"}
)
# Factor by which the first level may overestimate an error, and largest refinement factor from the
# first to the last level.
DOUBT = 4.0
FURTHEST = 1e4
# A scalar below this fraction of its characteristic magnitude is zero with round-off.
ROUND_OFF = 1e-7


@dataclass(frozen=True)
class RefinementLevel:
    """Result of one discretisation (level) of an adaptive refinement, with its error estimates.

    fineness       discretisation: cells, elements or rings, increments and tolerance
    result         result of the solver
    values         scalars, such as forces and contact radius, at the end of each load step, by name
    stated         error estimates of these scalars at the end of each load step
    run            the scalars with those of the coarse solves, from which the errors are computed
    seconds        elapsed time of the solve and its coarse solves [s]
    solve_seconds  CPU time of the solve [s]
    error_seconds  CPU time of its coarse solves [s]
    """

    fineness: Fineness
    result: Any
    values: Sequence[Values]
    stated: StatedErrors
    run: SolvedRun
    seconds: float
    solve_seconds: float
    error_seconds: float

    @property
    def processor_seconds(self) -> float:
        """CPU time of the solve of this level and of its coarse solves [s].

        The coarse solves yield the error estimate of the level.
        """
        return self.solve_seconds + self.error_seconds

    def largest(self, name: str) -> float:
        """Return the largest absolute value of a scalar or vector at the ends of all load steps.

        Relative errors refer to this value. The value is 0 if the result does not contain the
        scalar.

        name  name of the scalar, such as "peak_pressure"
        """
        return float(np.max(largest_so_far(self.values)[-1].get(name, 0.0)))

    def errors(self, name: str) -> Iterator[StatedError]:
        """Yield the error estimate of one scalar at the end of each load step that has the scalar.

        Load steps at whose end the scalar is zero with round-off are left out.

        name  name of the scalar, such as "peak_pressure"
        """
        for stated, values in zip(self.stated.steps, self.values, strict=True):
            if name in stated:
                size = np.max(np.abs(values[name]))
                if size > ROUND_OFF * characteristic_size(name, values):
                    yield stated[name]

    def reached_error(self, name: str) -> float | None:
        """Compute the relative error of one scalar at this refinement level.

        The relative error is the largest estimated error over the largest absolute value of the
        scalar, both at the ends of load steps. Ends at which the scalar is zero with round-off are
        left out. The result is None if an error is unknown or has not converged.

        name  name of the scalar, such as "peak_pressure"
        """
        errors = list(self.errors(name))
        if any(e.error is None or e.status is ErrorStatus.NOT_CONVERGED for e in errors):
            return None
        return float(max(np.max(e.error or 0.0) for e in errors)) / self.largest(name)

    def meets(self, shares: Mapping[str, float]) -> bool:
        """Return true if the errors of this level meet the requested accuracy of all scalars.

        A relative error times the margin 1.15 must not exceed the requested error. The margin is
        needed because the refinement stops at the first sufficient estimate. This criterion favours
        estimates that are too small.

        shares  requested relative error by name of the scalar
        """
        return SPARE * self.excess(shares) <= 1

    def excess(self, shares: Mapping[str, float]) -> float:
        """Return the largest ratio of reached to requested relative error.

        The ratio is infinite if an error is unknown or has not converged.

        shares  requested relative error by name of the scalar
        """
        errors = {name: self.reached_error(name) for name in shares}
        return max(np.inf if e is None else e / shares[name] for name, e in errors.items())

    def beyond_refinement(self, shares: Mapping[str, float]) -> str | None:
        """Return a message if the error of a scalar exceeds a request on any grid; else None.

        shares  requested relative error by name of the scalar
        """
        for name, share in shares.items():
            for error in self.errors(name):
                for part, cause in UNREFINED.items():
                    size = float(np.max(error.parts.get(part, 0.0))) / self.largest(name)
                    if size > share:
                        shown = shown_name(name, line=self.result.scene.indenter.is_line)
                        return f"{cause} leave an error of {size:.2g} in {shown} on any grid"
        return None

    def needed_factors(self, shares: Mapping[str, float]) -> Refinement:
        """Compute the refinement factors of the discretisation that a requested accuracy needs.

        There is one factor for each discretisation parameter, such as cells, increments and
        tolerance. A factor follows from the part of the error that the parameter causes, and from
        the convergence order of this part. Parameters that need no refinement are absent.

        shares  requested relative error by name of the scalar
        """
        factors: dict[Part, float] = {}
        for name, share in shares.items():
            # ½ is the least order of a cusp, whose error falls faster on most levels.
            least = min(step.convergence_order(name) for step in self.run.features)
            of_cells = max(EDGE, least)
            for error in self.errors(name):
                parts = {p: float(np.max(s)) / self.largest(name) for p, s in error.parts.items()}
                allowed = largest_allowed_part([*parts.values()], share / SPARE)
                wanted: dict[Part, float] = {
                    part: (size / allowed) ** (1 / ORDERS.get(part, of_cells))
                    for part, size in parts.items()
                    if part not in UNREFINED and size > allowed
                }
                if error.status is ErrorStatus.NOT_CONVERGED:
                    wanted[self.part] = max(wanted.get(self.part, 1.0), UNCONVERGED)
                factors |= {p: max(factor, factors.get(p, 1.0)) for p, factor in wanted.items()}
        return factors

    @property
    def part(self) -> Part:
        """Name of the error part due to the spatial discretisation of this solver.

        An error is the sum of parts by cause. The name is "cells" for the semi-analytical,
        "elements" for the finite-element and "quadrature" for the radial solver.
        """
        return next(iter(self.run.required))


@dataclass(frozen=True)
class Levels:
    """Solver of an adaptive refinement: solves its levels and compares them with the limits.

    A level is one discretisation of the scene. Each level is finer than the preceding one.

    solver     solver with the discretisation parameters that are refined
    stress_at  load step, from 1, at whose end the largest tensile stress of the body is computed;
               None without a requested accuracy of the stress
    watching   function from a discretisation to a context manager of its solve; the context yields
               a function that is called after each increment
    keeping    function from a discretisation to a context manager of its solve; the context yields
               a checkpoint store
    """

    solver: DiscretisedSolver
    stress_at: int | None = None
    watching: InContext = lambda _: nullcontext()
    keeping: InContext = lambda _: nullcontext()

    @classmethod
    def of_request(
        cls,
        solver: DiscretisedSolver,
        stress: bool,
        *hooks: InContext,
        step: int | None = None,
    ) -> Self:
        """Return the levels of a scene for a requested accuracy.

        solver  solver of the scene
        stress  true if the accuracy applies to the largest tensile stress in the body
        hooks   `watching` and `keeping`
        step    load step at whose end this stress is computed, from 1; None for the last
        """
        stress_at = (step or len(solver.scene.loading)) if stress else None
        return cls(solver, stress_at, *hooks)

    def solve_first_level(self) -> RefinementLevel:
        """Solve the first level: the coarsest discretisation whose cells resolve the contact.

        Raises the SolverError of the solve.
        """
        fineness = Fineness(
            self.solver.first_space(),
            self.solver.plan.increments,
            self.solver.discretisation.tolerance,
        )
        level: RefinementLevel = solve_coarsest(self.solver, fineness, self.solve_level)
        return level

    def solve_level(self, fineness: Fineness) -> RefinementLevel:
        """Solve the scene with one discretisation, and estimate the errors of its scalars.

        The errors follow from coarse solves of the scene. If `stress_at` is set, the largest
        tensile stress of the body is added to the scalars of that load step. Raises the SolverError
        of the solve.

        fineness  grid or mesh, increments and tolerance of the level
        """
        began, began_processor = time.perf_counter(), time.process_time()
        with self.keeping(fineness) as store, self.watching(fineness) as progress:
            result = self.solver.solve(fineness, progress, store)
        solved_processor = time.process_time()
        # A reference does not separate the parts of elements by section, overlap and harmonics.
        known = self.solver.part == "cells"
        run, coarse = compare_with_coarse_solves(self.solver, result, by_references=known)
        values, errors = list(run.values), list(run.errors())
        if self.stress_at is not None:
            at, stated = self.stress_at - 1, run.stated_errors(coarse)
            wanted = (f"{LARGEST_TENSION}@body",)
            for value, error in largest_stresses(result, stated, wanted, self.stress_at).values():
                values[at] = {**values[at], LARGEST_TENSION: np.array([abs(value)])}
                errors[at] = {
                    **errors[at],
                    LARGEST_TENSION: error or unknown_error("no error was estimated"),
                }
        return RefinementLevel(
            fineness=self.solver.fineness_of(result),
            result=result,
            values=values,
            stated=StatedErrors(tuple(errors), coarse, run.shear_errors),
            run=run,
            seconds=time.perf_counter() - began,
            solve_seconds=solved_processor - began_processor,
            error_seconds=time.process_time() - solved_processor,
        )

    def estimated_seconds(self, level: RefinementLevel, run: Work) -> float:
        """Estimate the CPU time of a solve and its error estimate [s] from that of a solved level.

        level  solved level, whose measured CPU time is scaled by the work of the solves
        run    numbers of unknowns and repetitions of the solve
        """
        coarse = self.solver.work(level.fineness)
        return estimated_run_seconds(level.solve_seconds, level.error_seconds, coarse, run)

    def settings(self, fineness: Fineness) -> AccuracySettings:
        """Return the record of a discretisation for the file summary.json.

        The record contains the number of cells, of elements over the contact radius or the factor
        of the default number of rings. It also contains the number of increments of each load step,
        and the tolerance.

        fineness  grid or mesh, increments and tolerance
        """
        return AccuracySettings(
            increments=fineness.increments,
            tolerance=fineness.tolerance,
            **self.solver.record_entry(fineness.space),
        )

    def last(self, first: RefinementLevel, shares: Mapping[str, float]) -> Fineness:
        """Extrapolate the discretisation that meets a request from the errors of the first level.

        Used to estimate time and memory, and to refuse a request that cannot be met. If the first
        level meets the requested accuracy, its discretisation is returned.

        first   solved first level of the refinement
        shares  requested relative error by name of the scalar
        """
        if first.meets(shares):
            return first.fineness
        needed = first.needed_factors(shares)
        return self.solver.refine_fineness(
            first.fineness, limit_factors(needed, first.part, FURTHEST)
        )

    def beyond_limit(self, fineness: Fineness) -> str | None:
        """Return a message if a discretisation is finer than the solver allows; else None.

        The solver limits the number of cells along a side, the elements over the contact radius, or
        the factor of the default number of rings.

        fineness  grid or mesh, increments and tolerance
        """
        ((name, size),) = self.solver.record_entry(fineness.space).items()
        if np.max(size) <= self.solver.most:
            return None
        return f"a level with {name} = {size} exceeds the limit {self.solver.most:g}"

    def memory(self, fineness: Fineness) -> int:
        """Estimate the peak memory of a level: of the solve, or of the stress in the body [byte].

        fineness  grid or mesh, increments and tolerance of the solve
        """
        run = self.solver.memory(fineness)
        return run if self.stress_at is None else max(run, self.solver.stress_memory(fineness))

    def beyond_memory(self, fineness: Fineness) -> str | None:
        """Return a message if a solve needs more than the available memory; else None.

        The refinement stops with this message.

        fineness  grid or mesh, increments and tolerance of the solve
        """
        ((name, size),) = self.solver.record_entry(fineness.space).items()
        needed, available = self.memory(fineness), available_bytes()
        if needed <= available:
            return None
        return (
            f"a level with {name} = {size} needs about {needed / 2**30:.1f} GiB, and "
            f"{available / 2**30:.1f} GiB are available"
        )


def largest_allowed_part(sizes: Sequence[float], limit: float) -> float:
    """Compute the size to which the parts of an error are to be reduced for a given sum.

    Parts below the result keep their size; the larger ones share the rest equally. The result is
    infinite if the sum of the parts does not exceed the limit.

    sizes  sizes of the parts
    limit  largest sum of the reduced parts
    """
    left = limit
    for count, size in zip(range(len(sizes), 0, -1), sorted(sizes), strict=True):
        if size * count > left:
            return left / count
        left -= size
    return np.inf


def limit_factors(by: Refinement, cells: Part, most: float = MAX_AT_ONCE) -> Refinement:
    """Limit the refinement factors of the discretisation parameters from one level to the next.

    If only cells and increments are refined, and by factors below `LEAST_AT_ONCE`, the cells are
    refined by this least factor, so that the next level differs sufficiently.

    by     required refinement factor of each parameter, by name
    cells  name of the parameter of the cells, elements or rings
    most   limit of the factors of cells and increments; other parameters have the limit most²
    """
    first = {cells, "increments"}
    found = {part: min(by[part], most if part in first else most**2) for part in by}
    if found.keys() <= first and max(found.values(), default=1.0) < LEAST_AT_ONCE:
        found[cells] = LEAST_AT_ONCE
    return found


@dataclass(frozen=True)
class Refined:
    """Outcome of the adaptive refinement of a scene for a requested accuracy.

    level     level that meets the request, else that with the smallest errors
    accuracy  requested and reached relative errors by name, and the reason if the request is not
              met
    """

    level: RefinementLevel
    accuracy: AccuracyReached


def refine(
    levels: Levels,
    request: AccuracyRequest,
    most_seconds: float = np.inf,
    estimated: Estimated | None = None,
) -> Refined:
    """Solve finer and finer discretisations (levels) of a scene until the errors meet a request.

    If a limit is reached, the errors do not decrease, or the solve of the next level fails, the
    level with the smallest errors is returned with the reason. Raises AccuracyOutOfReach for a
    request that cannot be met, and any SolverError of the first level.

    levels        scene and solver
    request       requested relative errors by name
    most_seconds  limit of the total time [s]; no level starts that is expected to exceed it
    estimated     function that is called after each level with its number, the requested errors and
                  the reached errors
    """
    names = SHOWN_NAMES if levels.solver.scene.indenter.is_line else {}
    level = levels.solve_first_level()
    shares, left_out, _ = targets_of(request, level, levels)
    spent = 0.0
    rounds = 0
    worse = 0
    stopped = None
    best = level
    while stopped is None:
        spent, rounds = spent + level.seconds, rounds + 1
        reached = {name: level.reached_error(name) for name in shares}
        if estimated is not None:
            estimated(rounds, rename_keys(shares, names), rename_keys(reached, names))
        better = level.excess(shares) <= best.excess(shares)
        best, worse = (level, 0) if better else (best, worse + 1)
        if level.meets(shares):
            break
        by = limit_factors(level.needed_factors(shares), level.part)
        following = levels.solver.refine_fineness(level.fineness, by)
        seconds = levels.estimated_seconds(level, levels.solver.work(following))
        shared = max(1.0, level.seconds / max(level.processor_seconds, 1e-3))
        stopped = (
            level.beyond_refinement(shares)
            or levels.beyond_limit(following)
            or levels.beyond_memory(following)
        )
        if rounds == MAX_ROUNDS:
            stopped = f"{rounds} rounds have not met it"
        elif worse == MAX_WORSE:
            stopped = f"{worse} rounds in succession have not reduced the error"
        elif stopped is None and spent + shared * seconds > most_seconds:
            stopped = (
                f"after {spent:.3g} s the next round would take about {shared * seconds:.2g} s, "
                f"beyond the {most_seconds:.3g} s of --most-seconds"
            )
        if stopped is None:
            try:
                level = levels.solve_level(following)
            except Exception as error:  # the solved level must not be lost
                kind = "" if isinstance(error, SolverError) else f"{type(error).__name__}: "
                stopped = f"the next round has no answer: {kind}{error}"
    accuracy = AccuracyReached(
        asked=rename_keys(shares, names),
        reached=rename_keys({name: best.reached_error(name) for name in shares}, names),
        met=stopped is None,
        settings=levels.settings(best.fineness),
        rounds=rounds,
        left_out=rename_keys(left_out, names),
        stopped=stopped,
    )
    return Refined(best, accuracy)


def targets_of(
    request: AccuracyRequest, level: RefinementLevel, levels: Levels
) -> tuple[dict[str, float], dict[str, str], Fineness]:
    """Determine the scalars to which an accuracy request applies, with their requested errors.

    The result of the first level determines the scalars. Scalars that it does not contain, that are
    infinite or that are zero throughout are excluded.

    Returns the requested relative errors by name, the reasons of the excluded scalars by name, and
    the discretisation of the last level, extrapolated from the errors of the first level.

    request  requested relative errors
    level    first level, with its result and error estimates
    levels   scene and solver, with the limits on cells and memory

    Raises AccuracyOutOfReach in three cases:

    - The request names an excluded scalar.
    - The extrapolated last level needs more than the available memory.
    - The extrapolated last level exceeds the solver's limit of cells, elements or rings, even if
      the error of the first level is overestimated by the factor `DOUBT`.
    """
    left_out = {name: why for name in request.shares() if (why := _why_left_out(name, level))}
    for name in request.named_quantities:
        if name in left_out:
            shown = shown_name(name, line=levels.solver.scene.indenter.is_line)
            raise AccuracyOutOfReach(f"{shown} can have no requested accuracy: {left_out[name]}")
    shares = {name: share for name, share in request.shares().items() if name not in left_out}
    last = levels.last(level, shares)
    coarsest = levels.last(level, {name: DOUBT * share for name, share in shares.items()})
    if too_large := levels.beyond_limit(coarsest) or levels.beyond_memory(last):
        solver = RADIAL if level.part == "quadrature" else ""
        advice = radial_advice(levels.solver.scene, solver, doubted=True)
        raise AccuracyOutOfReach(". ".join((f"no grid can meet the request: {too_large}", *advice)))
    return shares, left_out, last


def _why_left_out(name: str, level: RefinementLevel) -> str:
    """Return the reason against a request for an absent, infinite or zero scalar; else ""."""
    if not any(name in step for step in level.stated.steps):
        return "the results of this scene by this solver do not contain it"
    if name == PEAK and any(features.infinite for features in level.run.features):
        return "its exact value is infinite"
    natural = max(characteristic_size(name, step) for step in level.run.values)
    return "it is zero throughout" if level.largest(name) <= ROUND_OFF * natural else ""
