"""A scene solved ever finer: the rungs, what a ladder is, and how much finer the next rung is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from contact_errors.estimate import largest_so_far
from contact_errors.rules import Rule
from contact_errors.tension import Tension
from contact_errors.values import Values
from contact_scene import Scene
from contact_scene.accuracy import LARGEST_TENSION
from contact_scene.accuracy_reached import AccuracySettings
from contact_scene.stated_error import Amount, ErrorStatus, Part, StatedError, StatedErrors

F = TypeVar("F")

# Errors on the next rung are aimed at this part of the request, and have to be below one over
# `SPARE` of it: whoever stops at the first error below a bound prefers errors that are too small.
AIM = 0.8
SPARE = 1.15
# Of the request, at most so much for the increments.
HALF = 0.5
# Cells of the next rung over those of this: an error far away says little.
FIRST_GROWTH, LATER_GROWTH, LEAST_GROWTH = 8.0, 3.0, 1.15
# Increments over those of this: they cost in proportion, so that steps on the way are dearer than
# a few too many.
GROWTH_OF_INCREMENTS = 8.0
# Where a number has not converged nothing follows from its error.
UNCONVERGED_GROWTH = 2.0
SPACE: tuple[Part, ...] = ("cells", "elements")
# What neither lessens may take so much of the request, each.
REST: Mapping[Part, float] = MappingProxyType(
    {"tolerance": 0.05, "section": 0.1, "penalty": 0.1, "harmonics": 0.15}
)


@dataclass(frozen=True)
class Rung(Generic[F]):
    """A result on a ladder.

    fineness  how it was solved
    stated    the errors of its numbers
    values    its numbers
    rules     laws of their errors
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
        return (error for error, _ in self.ends(name))

    def ends(self, name: str) -> Sequence[tuple[StatedError, float]]:
        """Its error and its size at the ends of all steps that have it."""
        if name == LARGEST_TENSION:
            return [] if self.below is None else [(self.below.error, self.below.value)]
        return [
            (step[name], float(np.max(np.abs(values[name]))))
            for step, values in zip(self.stated.steps, self.values, strict=True)
            if name in step
        ]

    def reached(self, name: str) -> float | None:
        """The largest error of a number relative to its largest size; None where one is unknown or
        has not converged."""
        found = 0.0
        for error in self.errors(name):
            if error.error is None or error.status is ErrorStatus.NOT_CONVERGED:
                return None
            found = max(found, _size(error.error))
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
    increments  of the increments, where they matter
    less        what is to be left of the errors that neither lessens
    """

    cells: float
    increments: float
    less: Mapping[Part, float] = field(default_factory=dict)

    def bounded(self, most: float) -> Growth:
        """At most so many times the cells along a side, and a little finer at least."""
        cells = min(self.cells, most)
        increments = min(self.increments, GROWTH_OF_INCREMENTS)
        if max(cells, increments) < LEAST_GROWTH and not self.less:
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


def growth(rung: Rung[Any], shares: Mapping[str, float]) -> Growth:
    """How much finer a rung has to be for these errors, relative to the largest of each number."""
    cells = increments = 1.0
    less: dict[Part, float] = {}
    for name, share in shares.items():
        rule, largest = rung.rules[name], rung.largest(name)
        for error in rung.errors(name):
            if error.status is ErrorStatus.EXACT:
                continue
            if error.error is None or error.status is ErrorStatus.NOT_CONVERGED:
                cells = max(cells, UNCONVERGED_GROWTH)
                increments = max(increments, UNCONVERGED_GROWTH)
                continue
            parts = {part: _size(size) / largest for part, size in error.parts.items()}
            space = sum(parts.get(part, 0.0) for part in SPACE)
            path = parts.get("increments", 0.0)
            by_path, of_space = _path_alone(rule, path, space)
            rest = {part: parts[part] / (REST[part] * share) for part in REST if part in parts}
            for part, ratio in rest.items():
                if ratio > 1:
                    less[part] = min(less.get(part, 1.0), 1 / ratio)
            of_path = min(path, HALF * AIM * share)
            of_rest = sum(min(ratio, 1.0) * REST[part] * share for part, ratio in rest.items())
            left = AIM * share - of_path - of_rest
            cells = max(cells, (max(space, of_space) / left) ** (1 / rule.order))
            increments = max(increments, by_path / of_path if of_path else 1.0)
    return Growth(cells, increments, less)


def _path_alone(rule: Rule, path: float, space: float) -> tuple[float, float]:
    """The error by increments without, and at most with nothing but, the scatter by cells that it
    contains: more increments do not lessen that."""
    if rule.weight == 0:
        return path, 0.0
    per_space = rule.factor * (rule.weight / (rule.weight + 1)) ** 0.5
    scatter = min(path, rule.path_factor * rule.path_scatter * space / per_space)
    return (path**2 - scatter**2) ** 0.5, scatter


def _size(amount: Amount) -> float:
    return max(amount) if isinstance(amount, tuple) else amount
