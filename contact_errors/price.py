"""Cost of a requested accuracy: cells, increments, time and memory, from the first rung alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

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


@dataclass(frozen=True)
class Price:
    """Cost of one request.

    settings  cells or elements, and increments of the last rung
    rounds    number of rungs
    seconds   CPU time of all of them
    memory    of the last [byte]
    fits      whether so much memory is available
    """

    settings: AccuracySettings
    rounds: int
    seconds: float
    memory: int
    fits: bool


def price(ladder: Ladder[F], first: Rung[F], request: AccuracyRequest) -> Price:
    """Estimate the cost of a request from the first rung; raises AccuracyOutOfReach."""
    refuse_absent(request, ladder.scene)
    asked = asked_of(request, first)
    refuse_unreachable(asked, first, ladder.most_growth(first.fineness))
    seconds, rounds, fineness = first.processor_seconds, 1, first.fineness
    if not first.meets(asked.shares):
        needed = growth(first, asked.shares)
        reached = needed.bounded(FIRST_GROWTH)
        while True:
            fineness = ladder.refined(first.fineness, reached)
            seconds += ladder.seconds(fineness, first)
            rounds += 1
            if reached.covers(needed):
                break
            reached = _further(reached, needed)
    fits = ladder.too_large(fineness) is None
    return Price(ladder.settings(fineness), rounds, seconds, ladder.memory(fineness), fits)


def _further(reached: Growth, needed: Growth) -> Growth:
    """Return the growth of the next rung over the first."""
    increments = {
        step: min(by, GROWTH_OF_INCREMENTS * reached.increments.get(step, 1.0))
        for step, by in needed.increments.items()
    }
    cells = max(reached.cells, min(needed.cells, LATER_GROWTH * reached.cells))
    return Growth(cells, larger(reached.increments, increments), needed.less)
