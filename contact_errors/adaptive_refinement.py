"""Refine until the stated errors meet a requested accuracy, or a limit on time or memory."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from contact_errors.accuracy_targets import (
    Targets,
    refuse_absent,
    refuse_unreachable,
    targets_of,
)
from contact_errors.refinement import Levels, RefinementLevel
from contact_scene.accuracy import AccuracyRequest
from contact_scene.accuracy_reached import AccuracyReached
from contact_scene.solver_errors import SolverError

F = TypeVar("F")
# Called after each level: its number, the requested and the reached errors.
Estimated = Callable[[int, Mapping[str, float], Mapping[str, float | None]], None]

MOST_ROUNDS = 7


@dataclass(frozen=True)
class Refined(Generic[F]):
    """The best level, and its accuracy compared with the request."""

    level: RefinementLevel[F]
    accuracy: AccuracyReached


@dataclass(frozen=True)
class Progress(Generic[F]):
    """State of a refinement between two levels, sufficient to resume it.

    targets    numbers that are bound
    rounds     levels solved so far
    spent      their seconds
    best       discretisation of the best level
    shortfall  its largest error over its request
    next       discretisation of the next level
    needed     expected seconds of the next level; None without a limit on time
    """

    targets: Targets
    rounds: int
    spent: float
    best: F
    shortfall: float
    next: F
    needed: float | None

    def after(self, level: RefinementLevel[F], levels: Levels[F], timed: bool) -> Progress[F]:
        """State after a level; `timed` requests the expected seconds of the next one."""
        began, shares = time.perf_counter(), self.targets.shares
        shortfall = level.shortfall(shares)
        better = shortfall <= self.shortfall
        finer = level.fineness
        if not level.meets(shares):
            finer = levels.refined(level.fineness, level.needed(shares).bounded())
        shared = max(1.0, level.seconds / max(level.processor_seconds, 1e-3))
        return Progress(
            targets=self.targets,
            rounds=self.rounds + 1,
            spent=self.spent + level.seconds + time.perf_counter() - began,
            best=level.fineness if better else self.best,
            shortfall=shortfall if better else self.shortfall,
            next=finer,
            needed=shared * levels.seconds(finer, level) if timed else None,
        )


def refine(
    levels: Levels[F],
    request: AccuracyRequest,
    most_seconds: float | None = None,
    estimated: Estimated | None = None,
    begun: Progress[F] | None = None,
    between: Callable[[Progress[F]], None] | None = None,
) -> Refined[F]:
    """Solve ever finer levels until a request is met.

    most_seconds  no level is begun that would exceed the sum of the seconds
    begun         state to resume from, as passed to `between`
    between       called before each level but the first

    If a limit is reached, or a finer level has no result, the best level is returned with the
    reason. Raises AccuracyOutOfReach for a request beyond reach, and the errors of the first level.
    """
    state, stopped, met = begun, None, False
    best: RefinementLevel[F] | None = None
    while state is None or not met:
        if state is None:
            refuse_absent(request, levels.scene)
            level = levels.solved(levels.first())
            targets = targets_of(request, level)
            refuse_unreachable(targets, level, levels.most_growth(level.fineness))
            state = Progress(targets, 0, 0.0, level.fineness, np.inf, level.fineness, None)
        else:
            stopped = _stopped(state, levels, most_seconds)
            if stopped is not None:
                break
            if between is not None:
                between(state)
            try:
                level = levels.solved(state.next)
            except SolverError as error:
                stopped = f"the next round has no answer: {error}"
                break
        shares = state.targets.shares
        met, state = level.meets(shares), state.after(level, levels, most_seconds is not None)
        if state.best is level.fineness:
            best = level
        if estimated is not None:
            estimated(state.rounds, shares, {name: level.reached(name) for name in shares})
    if best is None:  # solved before the resume point
        best = levels.solved(state.best)
    accuracy = AccuracyReached(
        asked=dict(state.targets.shares),
        reached={name: best.reached(name) for name in state.targets.shares},
        met=met,
        settings=levels.settings(best.fineness),
        rounds=state.rounds,
        left_out=dict(state.targets.left_out),
        stopped=stopped,
    )
    return Refined(best, accuracy)


def _stopped(state: Progress[F], levels: Levels[F], most_seconds: float | None) -> str | None:
    """Reason why the next level is not begun; None without one."""
    if state.rounds == MOST_ROUNDS:
        return f"{state.rounds} rounds have not met it"
    if too_large := levels.too_large(state.next):
        return too_large
    needed = state.needed or 0.0
    if most_seconds is None or state.spent + needed <= most_seconds:
        return None
    return (
        f"after {state.spent:.3g} s the next round would take about {needed:.2g} s, "
        f"beyond the {most_seconds:.3g} s of --most-seconds"
    )
