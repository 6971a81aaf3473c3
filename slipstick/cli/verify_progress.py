"""How far a verification is: a line per case, and on a terminal a bar."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from verification.cases.judged_case import JudgedCase
from verification.judging.status_words import SYMBOLS, WORDS
from verification.running.case_pool import CaseEnd, Observer


@dataclass
class _Tally:
    """What has ended of what there is.

    solves  of every case, by name: the measure of its work
    """

    solves: Mapping[str, int]
    started: float = field(default_factory=time.monotonic)
    ended: int = 0
    computed: int = 0
    left: int = 0

    def __post_init__(self) -> None:
        self.left = sum(self.solves.values())

    def add(self, end: CaseEnd) -> None:
        """A case has ended; one of an earlier run took no time."""
        self.ended += 1
        self.left -= self.solves[end.case.name]
        if not end.stored:
            self.computed += self.solves[end.case.name]

    @property
    def seconds_left(self) -> float | None:
        """At the pace so far, per solve; None before anything has been computed."""
        if not self.computed:
            return None
        return (time.monotonic() - self.started) * self.left / self.computed


@contextmanager
def verify_progress(solves: Mapping[str, int]) -> Iterator[Observer]:
    """Give a function to call with every case that has ended.

    solves  how many solves every case has, by name
    """
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    tally = _Tally({name: max(1, count) for name, count in solves.items()})

    def line(end: CaseEnd, *, time_left: bool) -> None:
        tally.add(end)
        for warning in end.warnings:
            console.print(warning, markup=False)
        left = tally.seconds_left if time_left and tally.left else None
        rest = "" if left is None else f", about {left:.0f} s left"
        console.print(f"{_what(end)} ({tally.ended} of {len(tally.solves)}{rest})", markup=False)

    if not console.is_terminal:
        yield lambda end: line(end, time_left=True)
        return
    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn(),
        TextColumn("left"), TimeRemainingColumn(),
    )  # fmt: skip
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("solves", total=tally.left)

        def advance(end: CaseEnd) -> None:
            line(end, time_left=False)
            if end.stored:  # not a part of the pace that the time left follows from
                bar.update(task, total=tally.computed + tally.left)
            else:
                bar.update(task, completed=tally.computed)

        yield advance


def _what(end: CaseEnd) -> str:
    """The case and how it ended."""
    if not isinstance(end.record, JudgedCase):
        reason = end.lost.reason if end.lost else "it has no record"
        return f"LOST           {end.case.name:24} {reason}"
    outcome, seconds = end.record.outcome, f"{end.record.seconds:6.1f} s"
    took = "already there" if end.stored else seconds
    return (
        f"{SYMBOLS[outcome.status]} {WORDS[outcome.status]:12} {outcome.name:24} "
        f"{len(outcome.verdicts):3} verdicts, {len(outcome.runs):3} solves, {took}"
    )
