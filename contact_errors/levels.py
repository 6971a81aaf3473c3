"""A result beside its companions: the errors of all its numbers, whatever it was solved on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from contact_errors import estimate
from contact_errors.estimate import Numbers
from contact_errors.prescribed import prescribed
from contact_errors.rules import Lengthscale, Rule
from contact_errors.values import Values, scale
from contact_scene import Scene
from contact_scene.stated_error import EXACT, Part, StatedError

# Fewer increments than these are doubled where others are halved: halves of them tell nothing.
FEW_INCREMENTS = 4


def recut(count: int) -> int:
    """The increments of a companion for those of a step whose path matters."""
    return 2 * count if count < FEW_INCREMENTS else count // 2


def path_changes(
    values: Sequence[Values],
    other: Sequence[Values],
    increments: Sequence[int],
    matters: Sequence[bool],
) -> tuple[Values, ...]:
    """What other increments tell of those of a run, at the end of every step: an error that falls
    as 1/n is the difference to half of them, and twice that to twice as many.

    increments  of every step of the run
    matters     whether they do
    """
    changes, factor = [], 1.0
    for change, count, matter in zip(
        estimate.differences(values, other), increments, matters, strict=True
    ):
        if matter and count < FEW_INCREMENTS:
            factor = 2.0
        changes.append({name: factor * size for name, size in change.items()})
    return tuple(changes)


class Ground(Protocol):
    """What a result was solved on: cells, or elements."""

    @property
    def part(self) -> Part:
        """What its spacing contributes to."""

    def carries(self, step: int) -> bool:
        """Whether the contact at the end of a step, from 0, is as wide as one of them."""

    def scatter(self, step: int, rule: Rule) -> Numbers | float:
        """The envelope of a rule with so many as there are on its length scale."""

    def resolved(self, step: int, name: str, rule: Rule, largest: Numbers) -> bool:
        """Whether differences between levels mean anything."""

    def beside(
        self, step: int, name: str, rule: Rule, largest: Numbers
    ) -> Mapping[Part, Numbers] | None:
        """What else is wrong in a number, to be added; None where it cannot be said."""


@dataclass(frozen=True)
class Levels:
    """A result beside its companions, step by step.

    rules      of the numbers that have an error, at the end of every step
    values     of the result
    change     |values - those on twice the spacing|
    ratio      of the spacings
    tolerance  of the solver
    matters    whether the state at the end depends on how finely the steps so far are cut
    by_path    what other increments tell; None where they do not matter or gave no result
    charged    what increments tell of themselves; None of a number of which nobody tells
    lost       of energies that add up over steps what each of these has lost
    """

    scene: Scene
    ground: Ground
    rules: Sequence[Mapping[str, Rule]]
    values: Sequence[Values]
    change: Sequence[Values]
    ratio: float
    tolerance: float
    matters: Sequence[bool]
    by_path: Sequence[Values] | None
    charged: Sequence[Mapping[str, float | None]]
    lost: Sequence[Mapping[str, Mapping[int, float]]]

    def errors(self) -> Iterator[Mapping[str, StatedError]]:
        """Of every step."""
        largest = estimate.largest_so_far(self.values)
        for step, ramp in enumerate(self.scene.load_path()):
            exact = prescribed(ramp)
            yield {
                name: EXACT if name in exact else self._error(step, name, largest[step][name])
                for name in self.values[step]
            }

    def _error(self, step: int, name: str, largest: Numbers) -> StatedError:
        """Of one number at the end of a step."""
        rule, change = self.rules[step].get(name), self.change[step].get(name)
        if rule is None or change is None or not self.ground.carries(step):
            return estimate.UNKNOWN
        beside = self.ground.beside(step, name, rule, largest)
        if beside is None:
            return estimate.UNKNOWN
        scatter = self._scatter(step, name, rule, largest)
        unsolved = estimate.unsolved(self.tolerance, largest, scale(name, self.values[step]))
        parts: dict[Part, Numbers] = {
            self.ground.part: estimate.by_cells(rule, change, self.ratio, scatter),
            "tolerance": unsolved,
        }
        apart = estimate.contradicts(change, largest, unsolved)
        if name in self.charged[step]:
            charged = self.charged[step][name]
            if charged is None:
                return estimate.UNKNOWN
            if charged or self.matters[step]:
                by_path = None if self.by_path is None else self.by_path[step].get(name)
                parts["increments"] = estimate.charged(
                    rule, np.full_like(largest, charged), by_path
                )
        elif self.matters[step]:
            if self.by_path is None or name not in self.by_path[step]:
                return estimate.UNKNOWN
            by_path = self.by_path[step][name]
            parts["increments"] = estimate.by_increments(rule, by_path, scatter)
            apart = apart or estimate.contradicts(by_path, largest, unsolved)
        for part, size in beside.items():
            parts[part] = parts.get(part, 0.0) + size
        return estimate.stated(parts, self.ground.resolved(step, name, rule, largest) and not apart)

    def _scatter(self, step: int, name: str, rule: Rule, largest: Numbers) -> Numbers:
        """By where borders lie in cells; what was lost in a step has the scatter of its end."""
        lost = self.lost[step].get(name)
        if lost is None:
            turned = rule.lengthscale in (Lengthscale.TURN, Lengthscale.TURN_WITHIN)
            size = scale(name, self.values[step]) if turned else largest
            return np.full_like(largest, size * self.ground.scatter(step, rule))
        ends = lost.items()
        found = sum(size * self.ground.scatter(end, rule) for end, size in ends)
        return np.full_like(largest, found)
