"""What a stopped verification or study has kept."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from contact_results.directory.stop_signals import cleaned_up_when_stopped
from verification.running.case_store import CaseStore
from verification.running.study import StudyCase


@contextmanager
def told_when_stopped(
    cases: Sequence[StudyCase], store: CaseStore, *, fresh: bool = False
) -> Iterator[None]:
    """If a signal ends the process, say how many cases are kept and how to go on.

    store  where their records are
    fresh  whether the command takes nothing from earlier runs
    """

    def how_to_go_on() -> str:
        kept = sum(store.path(case).exists() for case in cases)
        again = "the same command without --fresh" if fresh else "the same command"
        return (
            f"{kept} of {len(cases)} cases are kept in {store.directory}; "
            f"{again} computes the others"
        )

    with cleaned_up_when_stopped(kept=how_to_go_on):
        yield
