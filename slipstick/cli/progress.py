"""Texts of progress and outcome, of solves and of the cases of a verification, study or sweep."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np
import typer

from contact_results.directory.stop_signals import cleaned_up_when_stopped
from contact_scene.discretised import Progress
from contact_scene.quantities.increment import ReportedIncrement
from contact_scene.quantities.stated_error import AccuracyReached, StatedErrors
from slipstick.cli.terminal import print_message

if TYPE_CHECKING:
    from contact_results.surface import Result
    from verification.running.case_pool import CaseEnd, CaseStore, Workers
    from verification.running.study import StudyCase

SECONDS_BETWEEN_LINES = 10.0
CLEAR = "\r\x1b[K"  # control characters that clear the line of the cursor


@contextmanager
def solve_progress(increments: Sequence[int]) -> Iterator[Progress]:
    """Show the progress of a solve on stderr.

    A terminal shows one line that every increment replaces. A log file receives a line at the end
    of every load step, and after 10 s without a line. Yields the function that the solver calls
    after every increment.

    increments  number of increments of every load step
    """
    started = last_line = time.monotonic()

    with terminal_line() as show:

        def observe(increment: ReportedIncrement) -> None:
            nonlocal last_line
            now = time.monotonic()
            text = (
                f"step {increment.step}/{len(increments)}, "
                f"increment {increment.index}/{increment.increments_in_step}, "
                f"residual {increment.worst_residual:.1e}, {now - started:.1f} s"
            )
            step_ends = increment.index == increment.increments_in_step
            if show is not None:
                show(text)
            elif step_ends or now - last_line >= SECONDS_BETWEEN_LINES:
                last_line = now
                print_message(text)

        yield observe


@contextmanager
def terminal_line() -> Iterator[Callable[[str], None] | None]:
    """Yield a function that replaces one line of a terminal on stderr; None without a terminal.

    The line is cleared at the end.
    """
    if not sys.stderr.isatty():
        yield None
        return
    try:
        yield lambda text: typer.echo(f"{CLEAR}{text}", nl=False, err=True)
    finally:
        typer.echo(CLEAR, nl=False, err=True)


@contextmanager
def show_coarse_solves() -> Iterator[None]:
    """Show a line in a terminal during the coarse solves of an error estimate."""
    with terminal_line() as show:
        if show is not None:
            show("coarse solves for the error estimates")
        yield


def print_level(
    number: int, requested: Mapping[str, float], reached: Mapping[str, float | None]
) -> None:
    """Print requested and reached error of one scalar after a refinement level.

    The scalar is that with the largest ratio of reached to requested error.

    number              number of the level, from 1
    requested, reached  relative errors by name; None for an error that has not converged
    """

    def ratio(name: str) -> float:
        size = reached[name]
        return float("inf") if size is None else size / requested[name]

    if requested:
        worst = max(requested, key=ratio)
        text = _request_text(requested[worst], reached[worst])
        print_message(f"round {number}: {worst} {text}")


def solve_lines(result: Result, seconds: float) -> Iterator[tuple[str, str]]:
    """Yield two lines about a finished solve: tolerance with residual, and increments with time.

    result   result of the solve
    seconds  elapsed time [s]
    """
    worst = np.max([increment.worst_residual for increment in result.increments])
    yield "tolerance", f"{result.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def error_lines(stated: StatedErrors, seconds: float | None) -> Iterator[tuple[str, str]]:
    """Yield lines about the coarse solves of an error estimate, their time and their failures.

    stated   error estimates with the records of the coarse solves
    seconds  elapsed time of the coarse solves [s]; None if it was not measured
    """
    made = "; ".join(dict.fromkeys(solve.differs for solve in stated.coarse_solves))
    taken = "" if seconds is None else f", in {seconds:.2f} s"
    way = f"by coarse solves ({made})" if made else "by an independent method"
    yield "errors", f"{way}{taken}"
    for solve in stated.coarse_solves:
        if solve.refused:
            yield "", f"coarse solve with {solve.differs} failed: {solve.refused}"


def accuracy_lines(accuracy: AccuracyReached) -> Iterator[tuple[str, str]]:
    """Yield lines about the requested and the reached error of each scalar of a run.

    The last lines state scalars that the request does not apply to, and the outcome.

    accuracy  outcome of a run with a requested accuracy
    """
    for name, share in accuracy.asked.items():
        outcome = _request_text(share, accuracy.reached[name])
        yield ("accuracy" if name == next(iter(accuracy.asked)) else ""), f"{name} {outcome}"
    for why in dict.fromkeys(accuracy.left_out.values()):
        names = ", ".join(name for name, reason in accuracy.left_out.items() if reason == why)
        yield "", f"{names} not bound: {why}"
    rounds = f"{accuracy.rounds} round{'s' if accuracy.rounds != 1 else ''}"
    yield "", f"met in {rounds}" if accuracy.met else f"not met in {rounds}: {accuracy.stopped}"


def _request_text(requested: float, reached: float | None) -> str:
    found = "not converged" if reached is None else f"reached {100 * reached:.2g} %"
    return f"requested {100 * requested:.3g} %, {found}"


def run_with_progress(
    cases: Sequence[StudyCase],
    store: CaseStore,
    workers: int | Workers,
    text: Callable[[CaseEnd], str],
    work: Mapping[str, int] | None = None,
    *,
    fresh: bool = False,
) -> Sequence[CaseEnd]:
    """Compute cases of a verification, study or sweep, and print a line at the end of each case.

    After a stop signal, a command that resumes the computation is printed.

    store    records of the finished cases
    workers  number of processes, or workers of a cluster
    text     function that describes the end of a case
    work     work of every case by name, for example its number of solves, to which the remaining
             time is proportional. Default: 1 each
    fresh    true to ignore stored cases of earlier runs
    """
    from verification.running.case_pool import run_cases

    started = time.monotonic()
    left = dict(work or {case.name: 1 for case in cases})
    computed = 0  # work of this process, without cases of an earlier run

    def observe(end: CaseEnd) -> None:
        nonlocal computed
        done = left.pop(end.case.name)
        computed += 0 if end.stored else done
        rest = ""
        if computed and left:
            seconds = (time.monotonic() - started) * sum(left.values()) / computed
            rest = f", about {seconds:.0f} s left"
        count = f"{len(cases) - len(left)} of {len(cases)}{rest}"
        print_message(f"{text(end)} ({count})")

    def how_to_resume() -> str:
        stored = sum(store.path(case).exists() for case in cases)
        again = "the same command without --fresh" if fresh else "the same command"
        return (
            f"{stored} of {len(cases)} cases are stored in {store.directory}; "
            f"{again} computes the others"
        )

    with cleaned_up_when_stopped(kept=how_to_resume):
        return run_cases(cases, store, workers, observe, fresh=fresh, warn=print_message)


def outcome_text(end: CaseEnd) -> str:
    """Return the outcome of a case as text: computed, already stored, or lost with its worker."""
    if end.lost is not None:
        return f"LOST           {end.case.name:24} {end.lost.reason}"
    return f"{'already there' if end.stored else 'done'}: {end.case.name}"
