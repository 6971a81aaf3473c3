"""Texts on convergence, errors and accuracy of a run."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from contact_scene.quantities.stated_error import StatedErrors

if TYPE_CHECKING:
    from contact_results.surface import Result
    from contact_scene.quantities.stated_error import AccuracyReached


def solved_in(result: Result, seconds: float) -> Iterator[tuple[str, str]]:
    """Yield the tolerance with the largest residual, and the increments with the time."""
    worst = np.max([increment.worst_residual for increment in result.increments])
    yield "tolerance", f"{result.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def how_stated(stated: StatedErrors, seconds: float | None) -> Iterator[tuple[str, str]]:
    """Yield the lines that describe the error estimate: coarse solves, their time, failures."""
    made = "; ".join(dict.fromkeys(solve.differs for solve in stated.coarse_solves))
    taken = "" if seconds is None else f", in {seconds:.2f} s"
    yield "errors", f"by coarse solves ({made}){taken}"
    for solve in stated.coarse_solves:
        if solve.refused:
            yield "", f"coarse solve with {solve.differs} failed: {solve.refused}"


def how_accurate(accuracy: AccuracyReached) -> Iterator[tuple[str, str]]:
    """Yield the requested and reached accuracy by quantity."""
    for name, share in accuracy.asked.items():
        outcome = against(share, accuracy.reached[name])
        yield ("accuracy" if name == next(iter(accuracy.asked)) else ""), f"{name} {outcome}"
    for why in dict.fromkeys(accuracy.left_out.values()):
        names = ", ".join(name for name, reason in accuracy.left_out.items() if reason == why)
        yield "", f"{names} not bound: {why}"
    rounds = f"{accuracy.rounds} round{'s' if accuracy.rounds != 1 else ''}"
    yield "", f"met in {rounds}" if accuracy.met else f"not met in {rounds}: {accuracy.stopped}"


def against(asked: float, reached: float | None) -> str:
    """Return the text of a requested and a reached error."""
    found = "not converged" if reached is None else f"reached {100 * reached:.2g} %"
    return f"asked {100 * asked:.3g} %, {found}"
