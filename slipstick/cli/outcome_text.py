"""The key results of a run in the units of a person."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from contact_scene.quantities.stated_error import (
    StatedError,
    StatedErrors,
)

if TYPE_CHECKING:
    from contact_results.surface import Result
    from contact_scene.quantities.stated_error import AccuracyReached

FIRST, LAST = 10, 10  # of a long history, the steps that are shown
NEGLIGIBLE = 1e-9  # of the largest value of a vector: round-off, shown as nothing

Errors = Mapping[str, StatedError]
Shown = TypeVar("Shown")


def solved_in(result: Result, seconds: float) -> Iterator[tuple[str, str]]:
    """How well it was solved, and how long that took."""
    worst = np.max([increment.worst_residual for increment in result.increments])
    yield "tolerance", f"{result.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def how_stated(stated: StatedErrors, seconds: float | None) -> Iterator[tuple[str, str]]:
    """Where the errors come from; in how many seconds, if they were measured apart."""
    made = " and ".join(dict.fromkeys(solve.differs for solve in stated.coarse_solves))
    yield "errors", f"from {made}" + ("" if seconds is None else f", in {seconds:.2f} s")
    for solve in stated.coarse_solves:
        if solve.refused:
            yield "", f"no answer with {solve.differs}: {solve.refused}"


def how_accurate(accuracy: AccuracyReached) -> Iterator[tuple[str, str]]:
    """What was asked for, and what was reached."""
    for name, share in accuracy.asked.items():
        outcome = against(share, accuracy.reached[name])
        yield ("accuracy" if name == next(iter(accuracy.asked)) else ""), f"{name} {outcome}"
    for why in dict.fromkeys(accuracy.left_out.values()):
        names = ", ".join(name for name, said in accuracy.left_out.items() if said == why)
        yield "", f"{names} not bound: {why}"
    rounds = f"{accuracy.rounds} round{'s' if accuracy.rounds != 1 else ''}"
    yield "", f"met in {rounds}" if accuracy.met else f"not met in {rounds}: {accuracy.stopped}"


def against(asked: float, reached: float | None) -> str:
    """An error beside the one that was asked for."""
    found = "not converged" if reached is None else f"reached {100 * reached:.2g} %"
    return f"asked {100 * asked:.3g} %, {found}"
