"""Progress of the cases of a verification, a study or a sweep: one line per case."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager

from rich.console import Console

from contact_results.directory.stop_signals import cleaned_up_when_stopped
from verification.running.case_pool import CaseEnd, CaseStore, Observer
from verification.running.study import StudyCase


@contextmanager
def case_progress(work: Mapping[str, int], text: Callable[[CaseEnd], str]) -> Iterator[Observer]:
    """Yield a function to call at the end of every case.

    work  work of every case by name, for example its number of solves; the remaining time is
          estimated in proportion to it
    text  function that describes the end of a case
    """
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    started, left = time.monotonic(), dict(work)
    computed = 0  # work of this process, without cases of an earlier run

    def line(end: CaseEnd) -> None:
        nonlocal computed
        done = left.pop(end.case.name)
        computed += 0 if end.stored else done
        for warning in end.warnings:
            console.print(warning, markup=False)
        rest = ""
        if computed and left:
            seconds = (time.monotonic() - started) * sum(left.values()) / computed
            rest = f", about {seconds:.0f} s left"
        count = f"{len(work) - len(left)} of {len(work)}{rest}"
        console.print(f"{text(end)} ({count})", markup=False)

    yield line


def how_it_ended(end: CaseEnd) -> str:
    """Return the text of a case that is done, lost or already stored."""
    if end.lost is not None:
        return f"LOST           {end.case.name:24} {end.lost.reason}"
    return f"{'already there' if end.stored else 'done'}: {end.case.name}"


@contextmanager
def resume_hint(
    cases: tuple[StudyCase, ...], store: CaseStore, *, fresh: bool = False
) -> Iterator[None]:
    """On a stop signal, print the number of stored cases and how to resume.

    fresh  whether the command ignores stored cases of earlier runs
    """

    def how_to_go_on() -> str:
        stored = sum(store.path(case).exists() for case in cases)
        again = "the same command without --fresh" if fresh else "the same command"
        return (
            f"{stored} of {len(cases)} cases are kept in {store.directory}; "
            f"{again} computes the others"
        )

    with cleaned_up_when_stopped(kept=how_to_go_on):
        yield
