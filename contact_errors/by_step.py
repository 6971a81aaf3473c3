"""Whose increments leave an error: every loading step by its own, and the fewest that will do.

What the increments of a step leave open the steps after it carry on, and may be the first to show.
So companions are cut otherwise from a step on: what one of them changes against that which is cut
otherwise from the next step on is the doing of the step. Where loads turn, steps leave errors of
either sign in one number, and what all of them change together may be nothing by chance.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from math import sqrt

import numpy as np

from contact_errors.levels import path_changes, recut
from contact_errors.values import Values
from contact_scene import Scene
from contact_scene.load_path import along_one_line

# The first steps of a history are told apart, by a companion each; those after them repeat what
# they do, and are taken together.
MOST_APART = 4
# Steps whose doings cancel leave less together than each alone; below one over this of it what is
# left together may be chance.
MOST_CANCELLED = 4.0


@dataclass(frozen=True)
class ByStep:
    """What the increments of each step do to the numbers at the ends of all.

    increments  of every step
    matters     whether they do
    companions  numbers of one that is cut so, and of one that is cut otherwise wherever it matters;
                None where one gave no result: all increments are held to be alike then
    solved      numbers of a companion with increments that it is told, None without a result
    """

    increments: tuple[int, ...]
    matters: tuple[bool, ...]
    companions: tuple[Sequence[Values], Sequence[Values]] | None = None
    solved: Callable[[Sequence[int]], Sequence[Values] | None] = lambda _: None

    def shares(self, name: str, end: int) -> Mapping[int, float]:
        """Of the error by increments of a number at the end of a step, from 0, what each step has
        left: at least 1 together, more where that cancels."""
        left = [(row, _size(change[end], name)) for row, change in self._apart]
        alone = sum(size for _, size in left)
        if alone == 0 or self.together is None:
            return self._alike(self._steps, end)
        together = max(_size(self.together[end], name), alone / MOST_CANCELLED)
        return {
            step: part * size / min(alone, together)
            for row, size in left
            for step, part in self._alike(row, end).items()
        }

    def recut_from(self, first: int) -> list[int]:
        """Other increments from a step on wherever they matter."""
        return [
            recut(count) if matters and step >= first else count
            for step, (count, matters) in enumerate(zip(self.increments, self.matters, strict=True))
        ]

    @cached_property
    def together(self) -> Sequence[Values] | None:
        """What other increments of all steps tell of their numbers, at every end."""
        if self.companions is None:
            return None
        return path_changes(*self.companions, self.increments, self.matters)

    @cached_property
    def by_squares(self) -> Sequence[Values] | None:
        """The same where steps may undo what others did: at least the root of the sum of the
        squares of what each has left."""
        if self.together is None:
            return None
        return tuple(
            {
                name: np.maximum(
                    size, np.sqrt(sum(alone[end][name] ** 2 for _, alone in self._apart))
                )
                for name, size in change.items()
            }
            for end, change in enumerate(self.together)
        )

    @property
    def _steps(self) -> list[int]:
        """Whose increments matter."""
        return [step for step, matters in enumerate(self.matters) if matters]

    def _alike(self, row: Sequence[int], end: int) -> Mapping[int, float]:
        """Shares of the steps of a row up to an end, every increment as any other."""
        known = {step: self.increments[step] for step in row if step <= end}
        return {step: count / sum(known.values()) for step, count in known.items()}

    @cached_property
    def _apart(self) -> Sequence[tuple[Sequence[int], Sequence[Values]]]:
        """What they tell of steps that are told apart; nothing where there are not two."""
        steps = self._steps
        first, rest = steps[: MOST_APART - 1], steps[MOST_APART - 1 :]
        rows = [[step] for step in first] + ([rest] if rest else [])
        if len(rows) < 2 or self.companions is None:
            return ()
        as_cut, recut_everywhere = self.companions
        levels = [recut_everywhere]
        for row in rows[1:]:
            later = self.solved(self.recut_from(row[0]))
            if later is None:
                return ()
            levels.append(later)
        levels.append(as_cut)
        return [
            (row, path_changes(here, there, self.increments, self._only(row)))
            for row, (there, here) in zip(rows, pairwise(levels), strict=True)
        ]

    def _only(self, row: Sequence[int]) -> list[bool]:
        return [step in row for step in range(len(self.matters))]


def undone(scene: Scene) -> bool:
    """Whether steps may undo what others did: a push that turns, or one with torsion beside it."""
    ramps = scene.load_path()
    pushed = any(any(ramp.tangential.end) for ramp in ramps)
    twisted = any(ramp.twisting.end for ramp in ramps)
    return pushed and (twisted or not along_one_line(ramps))


def fewest(
    left: Mapping[int, float], increments: Sequence[int], most: float
) -> Mapping[int, float]:
    """Factors of the increments of steps with which the fewest of them all together leave no more
    than an error, where what a step leaves falls as one over its own.

    left        that each step leaves, as it is cut
    increments  of every step
    most        that they may leave all together
    """
    if sum(left.values()) <= most:
        return {}
    grown = {step for step, size in left.items() if size > 0}
    while True:
        open_ = most - sum(size for step, size in left.items() if step not in grown)
        per = sum(sqrt(left[step] * increments[step]) for step in grown) / open_
        factors = {step: per * sqrt(left[step] / increments[step]) for step in grown}
        enough = {step for step, factor in factors.items() if factor < 1}
        if not enough:
            return factors
        grown -= enough


def _size(change: Values, name: str) -> float:
    return float(np.max(change.get(name, 0.0)))
