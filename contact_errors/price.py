"""What an accuracy costs, before it is paid: cells, increments, time and memory.

Two coarse rungs of a ladder tell it: the first how far the climb will jump, the second, which is
nearer, how far it has to go.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

from contact_errors.asked import asked_of, refuse_absent, refuse_unreachable
from contact_errors.growth import growth
from contact_errors.ladder import (
    FIRST_GROWTH,
    GROWTH_OF_INCREMENTS,
    LATER_GROWTH,
    Growth,
    Ladder,
    Rung,
    larger,
)
from contact_scene.accuracy import AccuracyRequest
from contact_scene.accuracy_reached import AccuracySettings

F = TypeVar("F")

# Cells of the second rung along a side over those of the first.
APART = 2.0


@dataclass(frozen=True)
class Price(Generic[F]):
    """Of one request.

    settings  how fine the last rung will be
    rounds    how many rungs there will be
    seconds   that the processor will work for all of them
    memory    of the last [byte]
    fits      whether there is so much
    """

    settings: AccuracySettings
    rounds: int
    seconds: float
    memory: int
    fits: bool


@dataclass(frozen=True)
class Prices(Generic[F]):
    """Two coarse rungs, by which all requests of a scene are priced."""

    ladder: Ladder[F]
    first: Rung[F]
    second: Rung[F]

    @classmethod
    def of(cls, ladder: Ladder[F]) -> Prices[F]:
        """Solves the rungs; raises a SolverError."""
        first = ladder.climbed(ladder.first())
        second = ladder.climbed(ladder.refined(first.fineness, Growth(APART)))
        return cls(ladder, first, second)

    def of_request(self, request: AccuracyRequest) -> Price[F]:
        """What a request costs; raises AccuracyOutOfReach."""
        ladder, first = self.ladder, self.first
        refuse_absent(request, ladder.scene)
        asked = asked_of(request, first)
        refuse_unreachable(asked, first, ladder.most_growth(first.fineness))
        seconds, rounds, fineness = first.processor_seconds, 1, first.fineness
        if not first.meets(asked.shares):
            for reached in _rungs(growth(first, asked.shares), self._needed(asked.shares)):
                fineness = ladder.refined(first.fineness, reached)
                like = self.second if reached.cells >= APART else first
                seconds += ladder.seconds(fineness, like)
                rounds += 1
        fits = ladder.too_large(fineness) is None
        return Price(ladder.settings(fineness), rounds, seconds, ladder.memory(fineness), fits)

    def _needed(self, shares: Mapping[str, float]) -> Growth:
        """Growth over the first rung by the errors of the second."""
        by = growth(self.second, shares)
        return Growth(APART * by.cells, by.increments, by.less)


def _rungs(by_first: Growth, needed: Growth) -> Iterator[Growth]:
    """Growths over the first rung of those that follow: the next goes where the first tells it; if
    that is too far, others as far as they have to, and none far above the one before."""
    reached = by_first.bounded(FIRST_GROWTH)
    yield reached
    if by_first.cells <= FIRST_GROWTH and by_first.increments == reached.increments:
        return
    while not reached.covers(needed):
        further = {
            step: min(by, GROWTH_OF_INCREMENTS * reached.increments.get(step, 1.0))
            for step, by in needed.increments.items()
        }
        reached = Growth(
            max(reached.cells, min(needed.cells, LATER_GROWTH * reached.cells)),
            larger(reached.increments, further),
            needed.less,
        )
        yield reached
