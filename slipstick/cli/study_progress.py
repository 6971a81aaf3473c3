"""How far a study is: a bar on a terminal, one line per case in a log."""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from verification.running.case_pool import CaseEnd, Observer


@contextmanager
def study_progress(cases: int) -> Iterator[Observer]:
    """Give a function to call with every case that has ended."""
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    started = time.monotonic()
    ended = computed = 0

    def log(end: CaseEnd) -> None:
        nonlocal ended, computed
        ended += 1
        computed += not end.stored
        for warning in end.warnings:
            console.print(warning, markup=False)
        spent = time.monotonic() - started
        text = f"{ended}/{cases} {_how(end)} {end.case.name}, {spent:.0f} s"
        if computed and ended < cases:  # at the pace so far; stored cases took no time
            text += f", about {spent * (cases - ended) / computed:.0f} s left"
        console.print(text, markup=False)

    if not console.is_terminal:
        yield log
        return
    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
        TextColumn("left"), TimeRemainingColumn(),
    )  # fmt: skip
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("cases", total=cases)

        def advance(end: CaseEnd) -> None:
            bar.update(task, advance=1, description=end.case.name)
            for warning in end.warnings:
                console.print(warning, markup=False)
            if end.lost is not None:
                console.print(f"LOST {end.case.name}: {end.lost.reason}", markup=False)

        yield advance


def _how(end: CaseEnd) -> str:
    if end.lost is not None:
        return f"LOST ({end.lost.reason})"
    return "already there:" if end.stored else "done:"
