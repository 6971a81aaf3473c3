"""Refinement levels of a scene, and the refinement that a requested accuracy needs.

A parameter is refined by (part / allowed)^(1/(0.6 p)), at most 4 times at once. Each part of an
error is allowed an equal share of the request. Where a number has not converged the cells are
doubled, and so are increments if their part is too large.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from math import ceil
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

import numpy as np

from contact_errors.error_formula import BELIEVED, SolvedRun, largest_so_far
from contact_errors.stress_errors import TensileStress
from contact_errors.values import Values
from contact_scene import Scene
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.accuracy_reached import AccuracySettings
from contact_scene.increment_error import with_error
from contact_scene.stated_error import Amount, ErrorStatus, Part, StatedError, StatedErrors

F = TypeVar("F")

# Errors have to be below 1/1.15 of the request: a stop at the first error below a bound selects
# errors that are too small.
SPARE = 1.15
# Largest and smallest refinement of the cells at once, and that of a number not converged.
MOST_AT_ONCE, LEAST_AT_ONCE, UNCONVERGED = 4.0, 1.15, 2.0
SPACE: tuple[Part, ...] = ("cells", "elements")
# Order of the error in the parameters other than the cells.
ORDERS: Mapping[Part, float] = {
    "increments": 1.0, "section": 2.0, "penalty": 1.0, "harmonics": 2.0, "tolerance": 1.0
}  # fmt: skip


class End(NamedTuple):
    """A number at the end of a load step, from 0, with its error."""

    step: int
    error: StatedError
    size: float


@dataclass(frozen=True)
class RefinementLevel(Generic[F]):
    """A result with its error estimates.

    fineness  discretisation of the solve
    run       the result with its coarse solves
    seconds, processor_seconds
              of the solve with its coarse solves
    below     largest tensile stress in the body, where requested
    """

    fineness: F
    result: Any
    stated: StatedErrors
    run: SolvedRun
    seconds: float
    processor_seconds: float
    below: TensileStress | None = None

    @property
    def values(self) -> Sequence[Values]:
        """Numbers at the ends of the steps."""
        return self.run.values

    @property
    def infinite(self) -> bool:
        """Whether the exact peak pressure is infinite."""
        return any(features.infinite for features in self.run.features)

    def order(self, name: str) -> float:
        """Convergence order of a number in the cells."""
        if name == LARGEST_TENSION and self.below is not None:
            return self.below.order
        return self.run.order(name)

    def largest(self, name: str) -> float:
        """Largest size of a number in the history; 0 for an absent number."""
        if name == LARGEST_TENSION and self.below is not None:
            return self.below.value
        return float(np.max(largest_so_far(self.values)[-1].get(name, 0.0)))

    def ends(self, name: str) -> Sequence[End]:
        """A number at the ends of all steps that have it."""
        steps = self.stated.steps
        if name == LARGEST_TENSION:
            below = self.below
            return [] if below is None else [End(len(steps) - 1, below.error, below.value)]
        return [
            End(number, step[name], float(np.max(np.abs(values[name]))))
            for number, (step, values) in enumerate(zip(steps, self.values, strict=True))
            if name in step
        ]

    def reached(self, name: str) -> float | None:
        """Largest error of a number relative to its largest size; None unless all converged."""
        errors = [end.error for end in self.ends(name)]
        if any(e.error is None or e.status is ErrorStatus.NOT_CONVERGED for e in errors):
            return None
        largest = max((largest_of(e.error or 0.0) for e in errors), default=0.0)
        return largest / self.largest(name)

    def shortfall(self, shares: Mapping[str, float]) -> float:
        """Largest error over its request; infinite where an error is unknown."""
        reached = {name: self.reached(name) for name in shares}
        ratios = [np.inf if r is None else r / shares[name] for name, r in reached.items()]
        return float(max(ratios, default=0.0))

    def meets(self, shares: Mapping[str, float]) -> bool:
        """Whether all errors meet the request with the margin of `SPARE`."""
        return SPARE * self.shortfall(shares) <= 1

    def needed(self, shares: Mapping[str, float], believed: float = BELIEVED) -> Refinement:
        """Refinement of every parameter that meets a request.

        believed  fraction of the convergence orders: 1 for the most likely refinement
        """
        factors: dict[Part, float] = {}
        for name, share in shares.items():
            for _, error, _ in self.ends(name):
                if error.status is ErrorStatus.EXACT:
                    continue
                parts = {
                    p: largest_of(size) / self.largest(name) for p, size in error.parts.items()
                }
                allowed = share / SPARE / max(1, sum(size > 0 for size in parts.values()))
                for part, size in parts.items():
                    order = self.order(name) if part in SPACE else ORDERS.get(part)
                    if order is not None and size > allowed:
                        factor = (size / allowed) ** (1 / (believed * order))
                        factors[part] = max(factors.get(part, 1.0), factor)
                if error.status is ErrorStatus.NOT_CONVERGED:
                    space = next((part for part in SPACE if part in parts), SPACE[0])
                    factors[space] = max(factors.get(space, 1.0), UNCONVERGED)
        cells = max(factors.pop(part, 1.0) for part in SPACE)
        return Refinement(cells, factors.pop("increments", 1.0), factors)


@dataclass(frozen=True)
class Refinement:
    """Refinement factors.

    cells       of the cells along a side, or of the elements over the radius
    increments  of the increments of all steps with an increment error
    others      of the remaining parameters, by the part of the error
    """

    cells: float = 1.0
    increments: float = 1.0
    others: Mapping[Part, float] = field(default_factory=dict)

    def increments_of(self, scene: Scene, counts: Sequence[int]) -> tuple[int, ...]:
        """Refined increments; steps without an increment error keep theirs."""
        return tuple(
            ceil(self.increments * count - 1e-9) if matters else count
            for count, matters in zip(counts, with_error(scene), strict=True)
        )

    def bounded(self, most: float = MOST_AT_ONCE) -> Refinement:
        """Limit all factors; some parameter is refined in any case."""
        cells, increments = min(self.cells, most), min(self.increments, most)
        others = {part: min(factor, most**2) for part, factor in self.others.items()}
        if max(cells, increments) < LEAST_AT_ONCE and not others:
            cells = LEAST_AT_ONCE
        return Refinement(cells, increments, others)


def no_context(fineness: object) -> AbstractContextManager[None]:
    """Context of a solve without checkpoint or progress."""
    return nullcontext()


Keeping = Callable[[Any], AbstractContextManager[Any]]


class Levels(Protocol[F]):
    """Refinement levels of a scene by one solver; F is its discretisation."""

    @property
    def scene(self) -> Scene: ...

    def first(self) -> F:
        """Discretisation of the coarsest level."""

    def solved(self, fineness: F) -> RefinementLevel[F]:
        """Solve a level with its errors; raises a SolverError."""

    def refined(self, fineness: F, by: Refinement) -> F:
        """Discretisation refined by at least these factors."""

    def seconds(self, fineness: F, like: RefinementLevel[F]) -> float:
        """CPU time of a level, from that of another."""

    def memory(self, fineness: F) -> int:
        """Largest memory of a level [byte]."""

    def too_large(self, fineness: F) -> str | None:
        """Reason why a level does not fit into the memory; None for one that fits."""

    def most_growth(self, fineness: F) -> float:
        """Largest refinement factor of the cells or elements that fits."""

    def settings(self, fineness: F) -> AccuracySettings:
        """Discretisation for the summary."""


def largest_of(amount: Amount) -> float:
    """Error of a number; the larger one of a vector."""
    return float(max(amount)) if isinstance(amount, tuple) else float(amount)
