"""A value that a run keeps beside its results while it lasts: a killed run takes it up again."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.checkpoint_file import Unusable, pack, unpacked
from contact_results.directory.refusal import OutputRefused
from contact_results.directory.stop_signals import cleaned_up_when_stopped
from contact_scene.solver_errors import SolverError


@dataclass(frozen=True)
class KeptValue:
    """A file for one value.

    identity  digest of all that decides the value
    say       told what a person should know
    """

    path: Path
    identity: str
    say: Callable[[str], None]

    def last(self) -> Any:
        """What an earlier process has kept of the same; None if nothing."""
        if not self.path.exists():
            return None
        try:
            return unpacked(self.path, self.identity)
        except Unusable as error:
            self.say(f"{error}; computed again")
            return None

    def keep(self, value: Any) -> None:
        """In the place of what was kept before; a disk that is full costs only that."""
        try:
            with atomic_file(self.path) as temporary:
                pack(value, self.identity, temporary)
        except (OSError, OutputRefused) as error:
            self.say(f"{self.path} could not be written: {error}")

    def how_to_go_on(self) -> str:
        """What a process that is stopped now leaves to the next one; empty if nothing."""
        return f"the same command goes on from {self.path}" if self.path.exists() else ""


@contextmanager
def kept_value(
    target: Path, identity: str, say: Callable[[str], None], name: str
) -> Iterator[KeptValue]:
    """A value beside the results in `target`; gone when the block is done.

    It stays where the process is killed, or where the results cannot be written. A solver that
    gives up would give up again, so then it goes as well.
    """
    target = Path(os.path.realpath(target))
    kept = KeptValue(target.parent / f".{target.name}.{name}", identity, say)
    with cleaned_up_when_stopped(kept=kept.how_to_go_on):
        try:
            yield kept
        except SolverError:
            kept.path.unlink(missing_ok=True)
            raise
    kept.path.unlink(missing_ok=True)
