"""File with the state of an unfinished command, to resume it after it was killed."""

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
    """File for one value.

    identity  digest of the input and the code that determine the value
    say       called with messages for the user
    """

    path: Path
    identity: str
    say: Callable[[str], None]

    def last(self) -> Any:
        """Return the value that an earlier process stored, or None."""
        if not self.path.exists():
            return None
        try:
            return unpacked(self.path, self.identity)
        except Unusable as error:
            self.say(f"{error}; computed again")
            return None

    def keep(self, value: Any) -> None:
        """Replace the stored value; report a failed write and continue."""
        try:
            with atomic_file(self.path) as temporary:
                pack(value, self.identity, temporary)
        except (OSError, OutputRefused) as error:
            self.say(f"cannot write {self.path}: {error}")

    def how_to_go_on(self) -> str:
        """Return a message on the stored value for a stopped process; empty if there is none."""
        return f"the same command goes on from {self.path}" if self.path.exists() else ""


@contextmanager
def kept_value(
    target: Path, identity: str, say: Callable[[str], None], name: str
) -> Iterator[KeptValue]:
    """Provide a file for one value next to `target`; remove it at the end of the block.

    The file remains if the process is killed or the block fails. After a SolverError it is removed,
    because a resumed command would fail again.
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
