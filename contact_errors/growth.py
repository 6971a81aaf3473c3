"""How much finer the next rung has to be: cells by the number that needs most of them, and of every
step the fewest increments that will do beside these."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt
from types import MappingProxyType
from typing import Any

import numpy as np

from contact_errors.by_step import fewest
from contact_errors.ladder import SPACE, Growth, Rung, larger, largest_of
from contact_errors.rules import Rule
from contact_scene.stated_error import ErrorStatus, Part, StatedError

# Errors on the next rung are aimed at this part of the request.
AIM = 0.8
# Of that, the increments are sure of so much, whatever the cells leave.
HALF = 0.5
# Where a number has not converged nothing follows from its error.
UNCONVERGED_GROWTH = 2.0
# What neither lessens may take so much of the request, each.
REST: Mapping[Part, float] = MappingProxyType(
    {"tolerance": 0.05, "section": 0.1, "penalty": 0.1, "harmonics": 0.15}
)


@dataclass(frozen=True)
class _Left:
    """What is left to do about one error, relative to the largest size of its number.

    name     of the number
    step     at whose end it is, from 0
    order    in the cells along a side
    aim      for cells and increments together
    of_path  of this, what increments are sure of
    space    error by cells
    path     by increments, without what their companions scatter on cells
    scatter  that, at most
    rest     parts that neither lessens, over what they may take, where that is less
    """

    name: str
    step: int
    order: float
    aim: float
    of_path: float
    space: float
    path: float
    scatter: float
    rest: Mapping[Part, float]

    @property
    def cells(self) -> float:
        """How many times as many along a side leave increments what they are sure of."""
        return (max(self.space, self.scatter) / (self.aim - self.of_path)) ** (1 / self.order)

    def beside(self, cells: float) -> float:
        """What increments may leave alone beside so many times as many cells along a side."""
        scatter, space = (size * cells**-self.order for size in (self.scatter, self.space))
        return max(self.of_path, sqrt(max(0.0, (self.aim - space) ** 2 - scatter**2)))


def growth(rung: Rung[Any], shares: Mapping[str, float]) -> Growth:
    """How much finer a rung has to be for these errors, relative to the largest of each number."""
    lefts, unknown = _left(rung, shares), _unknown(rung, shares)
    cells = max([left.cells for left in lefts] + [UNCONVERGED_GROWTH if unknown else 1.0])
    doubled = range(1 + max((step for step, grows in unknown if grows), default=-1))
    increments = dict.fromkeys(doubled, UNCONVERGED_GROWTH)
    less: dict[Part, float] = {}
    for left in lefts:
        for part, ratio in left.rest.items():
            less[part] = min(less.get(part, 1.0), 1 / ratio)
        most = left.beside(cells)
        if left.path > most:
            shares_of = rung.by_step.shares(left.name, left.step).items()
            parts = {step: share * left.path for step, share in shares_of}
            increments = larger(increments, fewest(parts, rung.by_step.increments, most))
    return Growth(cells, increments, less)


def _left(rung: Rung[Any], shares: Mapping[str, float]) -> list[_Left]:
    """Of all errors that tell it."""
    found = []
    for name, share in shares.items():
        rule, largest = rung.rules[name], rung.largest(name)
        for step, error, _ in rung.ends(name):
            if error.status is not ErrorStatus.ESTIMATED:
                continue
            parts = {part: largest_of(size) / largest for part, size in error.parts.items()}
            space, path = sum(parts.get(part, 0.0) for part in SPACE), parts.get("increments", 0.0)
            alone, scatter = _path_alone(rule, path, space)
            rest = {part: parts[part] / (REST[part] * share) for part in REST if part in parts}
            of_rest = sum(min(ratio, 1.0) * REST[part] * share for part, ratio in rest.items())
            found.append(
                _Left(
                    name=name,
                    step=step,
                    order=rule.order,
                    aim=AIM * share - of_rest,
                    of_path=min(path, HALF * AIM * share),
                    space=space,
                    path=alone,
                    scatter=scatter,
                    rest={part: ratio for part, ratio in rest.items() if ratio > 1},
                )
            )
    return found


def _unknown(rung: Rung[Any], shares: Mapping[str, float]) -> list[tuple[int, bool]]:
    """Steps at whose end an error is not known, and whether its increments may be why."""
    return [
        (step, _by_path(error) > HALF * AIM * share * rung.largest(name))
        for name, share in shares.items()
        for step, error, _ in rung.ends(name)
        if error.status is ErrorStatus.NOT_CONVERGED
    ]


def _by_path(error: StatedError) -> float:
    return np.inf if error.error is None else largest_of(error.parts.get("increments", 0.0))


def _path_alone(rule: Rule, path: float, space: float) -> tuple[float, float]:
    """The error by increments without, and at most with nothing but, the scatter by cells that it
    contains: more increments do not lessen that."""
    if rule.weight == 0:
        return path, 0.0
    per_space = max(rule.factor * (rule.weight / (rule.weight + 1)) ** 0.5, rule.least)
    scatter = min(path, rule.path_factor * rule.path_scatter * space / per_space)
    return (path**2 - scatter**2) ** 0.5, scatter
