"""From the first rung to one whose errors meet a request, or as far as time and memory allow."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from contact_errors.asked import Asked, asked_of, refuse_absent, refuse_unreachable
from contact_errors.growth import growth
from contact_errors.ladder import FIRST_GROWTH, LATER_GROWTH, Ladder, Rung
from contact_scene.accuracy import AccuracyRequest
from contact_scene.accuracy_reached import AccuracyReached
from contact_scene.solver_errors import SolverError

F = TypeVar("F")
# Told after every rung: how many there were, what is asked of each quantity and what it has.
Estimated = Callable[[int, Mapping[str, float], Mapping[str, float | None]], None]

MOST_ROUNDS = 7


@dataclass(frozen=True)
class Climb(Generic[F]):
    """The best rung, and how near it is to what was asked."""

    rung: Rung[F]
    accuracy: AccuracyReached


@dataclass(frozen=True)
class Way(Generic[F]):
    """Where a climb stands between two rounds: all that the next one takes from those before.

    asked      what is bound
    rounds     that lie behind
    spent      seconds that they took
    best       fineness of the best rung
    shortfall  its largest error over what was asked of it
    next       fineness of the rung to come
    needed     seconds that it is expected to take; None where nobody limits them
    """

    asked: Asked
    rounds: int
    spent: float
    best: F
    shortfall: float
    next: F
    needed: float | None

    def after(self, rung: Rung[F], ladder: Ladder[F], timed: bool) -> Way[F]:
        """Where it stands after a rung.

        timed  whether it is to be known how long the next one takes
        """
        began, shares, rounds = time.perf_counter(), self.asked.shares, self.rounds + 1
        most = FIRST_GROWTH if rounds == 1 else LATER_GROWTH
        shortfall = rung.shortfall(shares)
        better = shortfall <= self.shortfall
        finer = rung.fineness
        if not rung.meets(shares):
            finer = ladder.refined(rung.fineness, growth(rung, shares).bounded(most))
        shared = max(1.0, rung.seconds / max(rung.processor_seconds, 1e-3))
        return Way(
            asked=self.asked,
            rounds=rounds,
            spent=self.spent + rung.seconds + time.perf_counter() - began,
            best=rung.fineness if better else self.best,
            shortfall=shortfall if better else self.shortfall,
            next=finer,
            needed=shared * ladder.seconds(finer, rung) if timed else None,
        )


def climb(
    ladder: Ladder[F],
    request: AccuracyRequest,
    most_seconds: float | None = None,
    estimated: Estimated | None = None,
    begun: Way[F] | None = None,
    between: Callable[[Way[F]], None] | None = None,
) -> Climb[F]:
    """Solve ever finer until a request is met.

    most_seconds  no rung is begun that would exceed them all together
    begun         where it goes on, as `between` was told; from the first rung if absent
    between       told before every round but the first
    Where a limit is in the way, or a finer rung has no answer, the best rung is returned with the
    reason. Raises AccuracyOutOfReach for what no grid can meet, and what the first rung raises.
    """
    way, stopped, met = begun, None, False
    best: Rung[F] | None = None
    while way is None or not met:
        if way is None:
            refuse_absent(request, ladder.scene)
            rung = ladder.climbed(ladder.first())
            asked = asked_of(request, rung)
            refuse_unreachable(asked, rung, ladder.most_growth(rung.fineness))
            way = Way(asked, 0, 0.0, rung.fineness, np.inf, rung.fineness, None)
        else:
            stopped = _stopped(way, ladder, most_seconds)
            if stopped is not None:
                break
            if between is not None:
                between(way)
            try:
                rung = ladder.climbed(way.next)
            except SolverError as error:
                stopped = f"the next round has no answer: {error}"
                break
        shares = way.asked.shares
        met, way = rung.meets(shares), way.after(rung, ladder, most_seconds is not None)
        if way.best is rung.fineness:
            best = rung
        if estimated is not None:
            estimated(way.rounds, shares, {name: rung.reached(name) for name in shares})
    if best is None:  # it lies behind what was begun, and nothing came nearer
        best = ladder.climbed(way.best)
    accuracy = AccuracyReached(
        asked=dict(way.asked.shares),
        reached={name: best.reached(name) for name in way.asked.shares},
        met=met,
        settings=ladder.settings(best.fineness),
        rounds=way.rounds,
        left_out=dict(way.asked.left_out),
        stopped=stopped,
    )
    return Climb(best, accuracy)


def _stopped(way: Way[F], ladder: Ladder[F], most_seconds: float | None) -> str | None:
    """Why the next rung is not begun; None where nothing is in the way."""
    if way.rounds == MOST_ROUNDS:
        return f"{way.rounds} rounds have not met it"
    if too_large := ladder.too_large(way.next):
        return too_large
    needed = way.needed or 0.0
    if most_seconds is None or way.spent + needed <= most_seconds:
        return None
    return (
        f"after {way.spent:.3g} s the next round would take about {needed:.2g} s, "
        f"beyond the {most_seconds:.3g} s of --most-seconds"
    )
