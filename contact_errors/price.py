"""Cost of a requested accuracy, before the run: discretisation, CPU time and memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from contact_errors.accuracy_targets import refuse_absent, refuse_unreachable, targets_of
from contact_errors.adaptive_refinement import MOST_ROUNDS
from contact_errors.refinement import MOST_AT_ONCE, Levels, RefinementLevel
from contact_scene.accuracy import AccuracyRequest
from contact_scene.accuracy_reached import AccuracySettings

F = TypeVar("F")


@dataclass(frozen=True)
class Price:
    """Cost of one request.

    settings  discretisation of the last level
    rounds    number of levels
    seconds   CPU time of all levels
    memory    of the last level [byte]
    fits      whether so much memory is available
    """

    settings: AccuracySettings
    rounds: int
    seconds: float
    memory: int
    fits: bool


def price(levels: Levels[F], first: RefinementLevel[F], request: AccuracyRequest) -> Price:
    """Estimate the cost of a request from the first level; raises AccuracyOutOfReach."""
    refuse_absent(request, levels.scene)
    targets = targets_of(request, first)
    refuse_unreachable(targets, first, levels.most_growth(first.fineness))
    seconds, rounds, fineness = first.processor_seconds, 1, first.fineness
    needed = first.needed(targets.shares, believed=1.0)
    while not first.meets(targets.shares) and rounds < MOST_ROUNDS:
        reached = needed.bounded(MOST_AT_ONCE**rounds)
        fineness = levels.refined(first.fineness, reached)
        seconds += levels.seconds(fineness, first)
        rounds += 1
        if max(needed.cells / reached.cells, needed.increments / reached.increments) <= 1:
            break
    fits = levels.too_large(fineness) is None
    return Price(levels.settings(fineness), rounds, seconds, levels.memory(fineness), fits)
