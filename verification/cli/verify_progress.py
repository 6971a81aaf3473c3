"""How far a verification is: a bar on a terminal, one line per case in a log."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from verification.report.page import SYMBOLS, WORDS

if TYPE_CHECKING:
    from semi_analytical import Result
    from verification.cases.case import Case, Run
    from verification.cases.outcome import CaseOutcome

Solve = Callable[["Run"], "Result"]


@dataclass
class VerifyProgress:
    """Told about every solve and every case."""

    console: Console
    advance: Callable[[str], None]

    def watching(self, case: Case, solve: Solve) -> Solve:
        """The same solve, with its beginning shown."""

        def watched(run: Run) -> Result:
            self.advance(f"{case.name}, {run.label}")
            return solve(run)

        return watched

    def finished(self, outcome: CaseOutcome, seconds: float) -> None:
        """One line for a case that is done."""
        status = outcome.status
        self.console.print(
            f"{SYMBOLS[status]} {WORDS[status]:12} {outcome.name:24} "
            f"{len(outcome.verdicts):3} verdicts, {len(outcome.runs):3} solves, {seconds:6.1f} s",
            markup=False,
        )


@contextmanager
def verify_progress(solves: int) -> Iterator[VerifyProgress]:
    """Progress over this many solves."""
    console = Console(stderr=True, highlight=False, soft_wrap=True)
    if not console.is_terminal:
        yield VerifyProgress(console, lambda description: None)
        return
    columns = (
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn()
    )  # fmt: skip
    with Progress(*columns, console=console, transient=True) as bar:
        task = bar.add_task("starting", total=solves, completed=-1)

        def advance(description: str) -> None:
            bar.update(task, advance=1, description=description)

        yield VerifyProgress(console, advance)
