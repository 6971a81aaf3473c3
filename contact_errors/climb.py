"""From the first rung to one whose errors meet a request, or as far as time and memory allow."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

from contact_errors.asked import asked_of, refuse_unreachable
from contact_errors.ladder import FIRST_GROWTH, LATER_GROWTH, Ladder, Rung, growth
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


def climb(
    ladder: Ladder[F],
    request: AccuracyRequest,
    most_seconds: float | None = None,
    estimated: Estimated | None = None,
) -> Climb[F]:
    """Solve ever finer until a request is met.

    most_seconds  no rung is begun that would exceed them all together
    Where a limit is in the way, or a finer rung has no answer, the best rung is returned with the
    reason. Raises AccuracyOutOfReach for what no grid can meet, and what the first rung raises.
    """
    rung = best = ladder.climbed(ladder.first())
    asked = asked_of(request, rung)
    refuse_unreachable(asked, rung, ladder.most_growth(rung.fineness))
    spent, rounds, stopped = rung.seconds, 1, None
    while True:
        if rung.shortfall(asked.shares) <= best.shortfall(asked.shares):
            best = rung
        if estimated is not None:
            reached = {name: rung.reached(name) for name in asked.shares}
            estimated(rounds, asked.shares, reached)
        if rung.meets(asked.shares):
            break
        if rounds == MOST_ROUNDS:
            stopped = f"{rounds} rounds have not met it"
            break
        most = FIRST_GROWTH if rounds == 1 else LATER_GROWTH
        finer = ladder.refined(rung.fineness, growth(rung, asked.shares).bounded(most))
        stopped = ladder.too_large(finer) or _too_long(ladder, finer, rung, spent, most_seconds)
        if stopped is None:
            try:
                rung = ladder.climbed(finer)
            except SolverError as error:
                stopped = f"the next round has no answer: {error}"
        if stopped is not None:
            break
        spent, rounds = spent + rung.seconds, rounds + 1
    accuracy = AccuracyReached(
        asked=dict(asked.shares),
        reached={name: best.reached(name) for name in asked.shares},
        met=best.meets(asked.shares),
        settings=ladder.settings(best.fineness),
        rounds=rounds,
        left_out=dict(asked.left_out),
        stopped=stopped,
    )
    return Climb(best, accuracy)


def _too_long(
    ladder: Ladder[F], finer: F, rung: Rung[F], spent: float, most_seconds: float | None
) -> str | None:
    if most_seconds is None:
        return None
    shared = max(1.0, rung.seconds / max(rung.processor_seconds, 1e-3))
    needed = shared * ladder.seconds(finer, rung)
    if spent + needed <= most_seconds:
        return None
    return (
        f"after {spent:.3g} s the next round would take about {needed:.2g} s, "
        f"beyond the {most_seconds:.3g} s of --most-seconds"
    )
