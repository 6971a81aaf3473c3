"""Progress of a solve: a bar on a terminal, lines in a log."""

import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from contact_scene.quantities.increment import ReportedIncrement
from slipstick.solvers.solver import Progress as Observer

SECONDS_BETWEEN_LINES = 10.0


@contextmanager
def solve_progress(increments: Sequence[int]) -> Iterator[Observer]:
    """Yield a function to call after every increment.

    increments  number of increments of every load step
    """
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    if not console.is_terminal:
        yield _Log(console, len(increments))
        return
    columns = (
        TextColumn("{task.description}, increment"),
        MofNCompleteColumn(),
        BarColumn(),
        TextColumn("residual {task.fields[residual]}"),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=console, transient=True) as bar:
        steps = len(increments)
        task = bar.add_task(f"step 1/{steps}", total=sum(increments), residual="–")

        def observe(increment: ReportedIncrement) -> None:
            step = f"step {increment.step}/{steps}"
            residual = f"{increment.worst_residual:.1e}"
            bar.update(task, advance=1, description=step, residual=residual)

        yield observe


def coarse_solves_shown() -> AbstractContextManager[object]:
    """Show a status line during the coarse solves of the error estimate."""
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    return console.status("coarse solves for the error estimates")


def tell_round(
    number: int, asked: Mapping[str, float], reached: Mapping[str, float | None]
) -> None:
    """Print, after a refinement, the quantity with the largest ratio of error to request."""
    from slipstick.cli.outcome_text import against

    console = Console(stderr=True, highlight=False, soft_wrap=True)

    def shortfall(name: str) -> float:
        size = reached[name]
        return float("inf") if size is None else size / asked[name]

    if asked:
        worst = max(asked, key=shortfall)
        console.print(f"round {number}: {worst} {against(asked[worst], reached[worst])}")


class _Log:
    """Log with one line at the end of every load step, and every 10 s."""

    def __init__(self, console: Console, steps: int) -> None:
        self.console = console
        self.steps = steps
        self.started = self.last_line = time.monotonic()

    def __call__(self, increment: ReportedIncrement) -> None:
        now = time.monotonic()
        step_ends = increment.index == increment.increments_in_step
        if not step_ends and now - self.last_line < SECONDS_BETWEEN_LINES:
            return
        self.last_line = now
        self.console.print(
            f"step {increment.step}/{self.steps}, "
            f"increment {increment.index}/{increment.increments_in_step}, "
            f"residual {increment.worst_residual:.1e}, {now - self.started:.1f} s"
        )
