"""A scene solved ever finer: the rungs, and what a ladder is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from math import ceil
from typing import Any, Generic, NamedTuple, Protocol, TypeVar

import numpy as np

from contact_errors.by_step import ByStep
from contact_errors.estimate import largest_so_far
from contact_errors.rules import Rule
from contact_errors.tension import Tension
from contact_errors.values import Values
from contact_scene import Scene
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.accuracy_reached import AccuracySettings
from contact_scene.stated_error import Amount, ErrorStatus, Part, StatedError, StatedErrors

F = TypeVar("F")

# Errors have to be below one over this of the request: whoever stops at the first error below a
# bound prefers errors that are too small.
SPARE = 1.15
# Cells of the next rung over those of this: an error far away says little.
FIRST_GROWTH, LATER_GROWTH, LEAST_GROWTH = 8.0, 3.0, 1.15
# Increments over those of this: they cost in proportion, so that steps on the way are dearer than
# a few too many.
GROWTH_OF_INCREMENTS = 8.0
SPACE: tuple[Part, ...] = ("cells", "elements")


class End(NamedTuple):
    """A number at the end of a step, from 0: its error and its size."""

    step: int
    error: StatedError
    size: float


@dataclass(frozen=True)
class Rung(Generic[F]):
    """A result on a ladder.

    fineness  how it was solved
    stated    the errors of its numbers
    values    its numbers
    rules     laws of their errors
    by_step   whose increments leave them
    seconds   that it took with its companions
    processor_seconds
              of these, those that the machine worked for it
    below     the largest tension in the body, where it is wanted
    """

    fineness: F
    result: Any
    stated: StatedErrors
    values: Sequence[Values]
    rules: Mapping[str, Rule]
    by_step: ByStep
    seconds: float
    processor_seconds: float
    below: Tension | None = None

    def largest(self, name: str) -> float:
        """The largest size of a number in the history; 0 where it has none."""
        if name == LARGEST_TENSION and self.below is not None:
            return self.below.value
        return float(np.max(largest_so_far(self.values)[-1].get(name, 0.0)))

    def errors(self, name: str) -> Iterator[StatedError]:
        """Of a number at the ends of all steps that have it."""
        return (end.error for end in self.ends(name))

    def ends(self, name: str) -> Sequence[End]:
        """Of a number, for all steps that have it."""
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
        """The largest error of a number relative to its largest size; None where one is unknown or
        has not converged."""
        found = 0.0
        for error in self.errors(name):
            if error.error is None or error.status is ErrorStatus.NOT_CONVERGED:
                return None
            found = max(found, largest_of(error.error))
        return found / self.largest(name)

    def shortfall(self, shares: Mapping[str, float]) -> float:
        """The largest error over what was asked of it; infinite where one is not known."""
        reached = {name: self.reached(name) for name in shares}
        ratios = [np.inf if r is None else r / shares[name] for name, r in reached.items()]
        return float(max(ratios, default=0.0))

    def meets(self, shares: Mapping[str, float]) -> bool:
        """Whether all errors are below the request, with something to spare."""
        return SPARE * self.shortfall(shares) <= 1


@dataclass(frozen=True)
class Growth:
    """How much finer.

    cells       factor of the cells along a side, or of the elements over the radius
    increments  of the increments of steps, from 0; 1 of those that are not named
    less        what is to be left of the errors that neither lessens
    """

    cells: float
    increments: Mapping[int, float] = field(default_factory=dict)
    less: Mapping[Part, float] = field(default_factory=dict)

    def increments_of(self, counts: Sequence[int], matters: Sequence[bool]) -> tuple[int, ...]:
        """Of steps that have had so many; those whose path does not matter keep them."""
        return tuple(
            ceil(self.increments.get(step, 1.0) * count) if grows else count
            for step, (count, grows) in enumerate(zip(counts, matters, strict=True))
        )

    def covers(self, needed: Growth) -> bool:
        """Whether it is no less, of cells and of the increments of any step."""
        mine = self.increments
        enough = all(mine.get(step, 1.0) >= by for step, by in needed.increments.items())
        return enough and self.cells >= needed.cells

    def bounded(self, most: float) -> Growth:
        """At most so many times the cells along a side, and a little finer at least."""
        cells = min(self.cells, most)
        increments = {n: min(by, GROWTH_OF_INCREMENTS) for n, by in self.increments.items()}
        if max(cells, *increments.values(), 1.0) < LEAST_GROWTH and not self.less:
            cells = LEAST_GROWTH
        return Growth(cells, increments, self.less)


def unkept(fineness: object) -> AbstractContextManager[None]:
    """For who keeps nothing of a solve, or tells nobody of it."""
    return nullcontext()


class Ladder(Protocol[F]):
    """A scene that can be solved ever finer by one solver.

    F  how fine: what the solver takes
    """

    @property
    def scene(self) -> Scene: ...

    def first(self) -> F:
        """The coarsest that says anything."""

    def climbed(self, fineness: F) -> Rung[F]:
        """The scene solved, with its errors; raises a SolverError."""

    def refined(self, fineness: F, by: Growth) -> F:
        """Finer by so much, or a little more."""

    def seconds(self, fineness: F, like: Rung[F]) -> float:
        """How long the processor will work for a rung, by what another has taken."""

    def memory(self, fineness: F) -> int:
        """Largest memory that a rung holds at once [byte]."""

    def too_large(self, fineness: F) -> str | None:
        """Why it does not fit into the memory; None where it does."""

    def most_growth(self, fineness: F) -> float:
        """How many times as many cells along a side, or elements, would still fit."""

    def settings(self, fineness: F) -> AccuracySettings:
        """How fine, for the summary."""


def larger(*factors: Mapping[int, float]) -> dict[int, float]:
    """The larger one of every step."""
    steps = sorted(set().union(*factors))
    return {step: max(by.get(step, 1.0) for by in factors) for step in steps}


def largest_of(amount: Amount) -> float:
    """The error of a number, the larger one of a vector."""
    return float(max(amount) if isinstance(amount, tuple) else amount)
