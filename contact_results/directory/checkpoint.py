"""Checkpoint files of a run in a hidden directory next to its results, to resume a killed run.

A checkpoint is a sequence of atomic files. Each file contains the increments since the preceding
file. The files are removed at the end of the run.
"""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from contact_results.directory.atomic_file import OutputRefused, atomic_file
from contact_results.directory.checkpoint_file import Unusable, pack, unpacked
from contact_results.directory.run_lock import acquire, release
from contact_results.directory.stop_signals import cleaned_up_when_stopped
from contact_scene.quantities.stored_fields import (
    FieldStore,
    stored_bytes,
)
from contact_scene.solver_errors import SolverError
from contact_scene.stepping.checkpoint import Checkpoint

SECONDS_BETWEEN = 5.0  # shortest time between two files [s]
SHARE = 0.05  # largest part of the run time spent on writing
MAX_BETWEEN = 3600.0  # longest time between two files [s]: a suspended machine measures hours
MAX_IN_PART = 16 << 20  # bytes of fields in a file, which limits the memory of a read


@dataclass(frozen=True)
class _Part:
    """Contents of one checkpoint file: the increments since the preceding file.

    before      number of increments in all preceding files
    increments  completed increments of the load history in this file
    standing    checkpoint after these increments, with an empty list of increments; None if further
                increments of this checkpoint follow in the next file
    """

    before: int
    increments: tuple[Any, ...]
    standing: Checkpoint | None


class CheckpointDirectory:
    """Directory with the checkpoint files of one solve.

    The class implements `CheckpointStore` of `contact_scene.stepping`.

    directory        hidden directory of the files, created at the first write
    identity         digest of the input and the code of the solve
    say              function called with messages for the user
    seconds_between  shortest time between two files [s]
    """

    def __init__(
        self,
        directory: Path,
        identity: str,
        say: Callable[[str], None],
        seconds_between: float,
    ) -> None:
        self._directory = directory
        self._identity = identity
        self._say = say
        self._pause = seconds_between
        self._seconds_between = seconds_between
        self._written = 0.0
        self._lock: int | None = None
        self._open = True
        self._read = False
        self._standing: Checkpoint | None = None
        self._parts = 0
        self._kept = 0
        self._extent: Any = None

    def last(self) -> Checkpoint | None:
        """Return the checkpoint that an earlier process stored for this solve, or None.

        The files are read at the first call only.
        """
        if not self._read:
            self._read, self._written = True, time.monotonic()
            if self._directory.is_dir() and self._locked():
                self._standing = self._standing_of_parts()
                self._settle()
        return self._standing

    def keep(self, standing: Checkpoint) -> None:
        """Store a checkpoint if enough time has passed since the last one was stored.

        A failed write disables further checkpoints of this solve, and the user gets a message.

        standing  state of the solve after an increment
        """
        self.last()
        began = time.monotonic()
        # A negative time follows from a clock that was set back.
        if not self._open or 0 <= began - self._written < self._pause:
            return
        try:
            self._directory.mkdir(mode=0o700, exist_ok=True)
            if not self._locked():
                return
            again = len(standing.increments) <= self._kept
            if (
                again or standing.extent != self._extent
            ):  # the solve restarted on a larger grid or mesh
                self._drop_from(0)
                self._kept = 0
            self._write(standing)
        except (OSError, OutputRefused) as error:
            self._say(f"cannot write a checkpoint into {self._directory}: {error}")
            self._open = False
            return
        self._written = time.monotonic()
        taken = max(0.0, self._written - began)
        self._pause = max(self._seconds_between, min(taken / SHARE, MAX_BETWEEN))

    def _write(self, standing: Checkpoint) -> None:
        """Write the increments since the last stored checkpoint to one or more files.

        A file has about MAX_IN_PART bytes of fields at most, but at least one increment.

        standing  state of the solve after the last of these increments
        """
        new = standing.increments[self._kept :]
        self._extent = standing.extent
        at_once = max(1, MAX_IN_PART // stored_bytes(new[0]))
        for first in range(0, len(new), at_once):
            some = new[first : first + at_once]
            whole = first + at_once >= len(new)
            part = _Part(self._kept, some, replace(standing, increments=()) if whole else None)
            with atomic_file(self._path(self._parts)) as temporary:
                pack(part, self._identity, temporary)
            self._parts += 1
            self._kept += len(some)

    def remove(self) -> None:
        """Remove the checkpoint directory with all files at the end of the run."""
        if self._directory.is_dir() and self._locked():
            shutil.rmtree(self._directory, ignore_errors=True)

    def how_to_go_on(self) -> str:
        """Return a message on the stored increments and how to resume, for a stopped process.

        The message is empty if no increment is stored.
        """
        if not (self._kept and self._parts):
            return ""
        return f"the same command goes on after increment {self._kept}, kept in {self._directory}"

    def close(self) -> None:
        """Release the lock of the checkpoint directory and disable further checkpoints."""
        release(self._lock)
        self._lock, self._open = None, False

    def _locked(self) -> bool:
        """Lock the checkpoint directory; return False if that is not possible.

        A failed attempt disables checkpoints, and the user gets a message.
        """
        if self._lock is None and self._open:
            self._lock = acquire(self._directory, wait=False)
            self._open = self._lock is not None
            if not self._open:
                self._say(f"{self._directory} cannot be locked: no checkpoint is read or written")
        return self._lock is not None

    def _standing_of_parts(self) -> Checkpoint | None:
        """Read the last complete checkpoint from the sequence of files; None if there is none.

        Reading ends at the first file that is damaged, belongs to another solve, or does not
        continue the preceding file.
        """
        standing: Checkpoint | None = None
        increments: list[Any] = []
        fields, number = FieldStore(), 0
        while (path := self._path(number)).exists():
            try:
                part = unpacked(path, self._identity)
                if not isinstance(part, _Part):
                    raise Unusable(f"{path} contains no checkpoint")
                if part.before != len(increments):
                    raise Unusable(f"{path} does not continue the preceding file")
            except Unusable as error:
                self._say(f"{error}; computed again")
                break
            increments.extend(map(fields.stored, part.increments))
            number += 1
            if part.standing is not None:
                standing = replace(part.standing, increments=tuple(increments))
                self._parts = number
        return standing

    def _settle(self) -> None:
        """Remove unusable checkpoint files, and report from which increment the solve resumes."""
        self._drop_from(self._parts)
        if self._standing is None:
            return
        self._kept, self._extent = len(self._standing.increments), self._standing.extent
        self._say(
            f"going on after increment {self._kept} of an interrupted run ({self._directory})"
        )

    def _drop_from(self, first: int) -> None:
        """Remove all checkpoint files from the number `first` on.

        Other files in the directory are removed as well.
        """
        kept = {self._path(number).name for number in range(first)}
        for name in os.listdir(self._directory) if self._directory.is_dir() else ():
            if name not in kept:
                (self._directory / name).unlink(missing_ok=True)
        self._parts = first

    def _path(self, number: int) -> Path:
        """Return the path of the checkpoint file with this number, from 0."""
        return self._directory / f"part-{number:06d}"


@contextmanager
def checkpointed(
    target: Path, identity: str, say: Callable[[str], None], name: str = "checkpoint"
) -> Iterator[CheckpointDirectory]:
    """Provide the checkpoint directory of a solve, and remove it after the `with` block.

    The directory remains if the process is killed or the block fails. After a SolverError it is
    removed, because a resumed solve would fail again.

    target    directory of the results
    identity  digest of the input and the code of the solve
    say       function called with messages for the user
    name      part of the directory name that distinguishes the solves of one run
    """
    target = Path(os.path.realpath(target))
    directory = (target if target.is_dir() else target.parent) / f".{target.name}.{name}"
    if not directory.exists():  # the target may have appeared just before the process was killed
        beside = target.parent / directory.name
        directory = beside if beside.exists() else directory
    checkpoint = CheckpointDirectory(directory, identity, say, SECONDS_BETWEEN)
    try:
        with cleaned_up_when_stopped(kept=checkpoint.how_to_go_on):
            yield checkpoint
        checkpoint.remove()
    except SolverError:
        checkpoint.remove()
        raise
    finally:
        checkpoint.close()
