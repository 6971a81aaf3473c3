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
from dataclasses import replace
from itertools import count, takewhile
from pathlib import Path
from typing import Any

from contact_results.directory.atomic_file import OutputRefused, atomic_file
from contact_results.directory.checkpoint_file import (
    Unusable,
    read_checkpoint_file,
    write_checkpoint_file,
)
from contact_results.directory.stop_signals import cleaned_up_when_stopped
from contact_scene.quantities.stored_fields import FieldStore
from contact_scene.solver_errors import SolverError
from contact_scene.stepping.checkpoint import Checkpoint

SECONDS_BETWEEN = 5.0  # shortest time between two files [s]
SHARE = 0.05  # largest part of the run time spent on writing
MAX_BETWEEN = 3600.0  # longest time between two files [s]: a suspended machine measures hours


class CheckpointDirectory:
    """Directory with the checkpoint files of one solve.

    The class implements `CheckpointStore` of `contact_scene.stepping`. A file contains the number
    of increments in all preceding files, and a checkpoint with the increments since then.

    directory  hidden directory of the files, created at the first write
    identity   digest of the input and the code of the solve
    say        function called with messages for the user
    """

    def __init__(self, directory: Path, identity: str, say: Callable[[str], None]) -> None:
        self._directory, self._identity, self._say = directory, identity, say
        self._pause = SECONDS_BETWEEN
        self._written = 0.0
        self._open, self._read = True, False
        self._standing: Checkpoint | None = None
        self._ends: list[int] = []  # number of increments up to the end of each file
        self._extent: Any = None

    def last(self) -> Checkpoint | None:
        """Return the checkpoint that an earlier process stored for this solve, or None.

        The files are read at the first call only. A link to a directory, which another user may
        have created, disables checkpoints.
        """
        if not self._read:
            self._read, self._written = True, time.monotonic()
            self._open = not self._directory.is_symlink()
            if not self._open:
                self._say(f"{self._directory} is a link: no checkpoint is read or written")
            elif self._directory.is_dir():
                self._standing = self._read_parts()
                self._drop_from(len(self._ends))
        return self._standing

    def keep(self, standing: Checkpoint) -> None:
        """Store a checkpoint if enough time has passed since the last one was stored.

        The pause is such that writing takes at most the part SHARE of the run time, but at least
        SECONDS_BETWEEN and at most MAX_BETWEEN. A failed write disables further checkpoints of this
        solve, and the user gets a message.

        standing  state of the solve after an increment
        """
        self.last()
        began = time.monotonic()
        # A negative time follows from a clock that was set back.
        if not self._open or 0 <= began - self._written < self._pause:
            return
        try:
            self._directory.mkdir(mode=0o700, exist_ok=True)
            before = max(self._ends, default=0)
            again = len(standing.increments) <= before
            if again or standing.extent != self._extent:  # restarted on a larger grid or mesh
                self._drop_from(0)
                before = 0
            path = self._part_path(len(self._ends))
            new = replace(standing, increments=standing.increments[before:])
            self._ends.append(len(standing.increments))  # first: a signal may follow the write
            with atomic_file(path) as temporary:
                write_checkpoint_file((before, new), self._identity, temporary)
        except (OSError, OutputRefused) as error:
            self._say(f"cannot write a checkpoint into {self._directory}: {error}")
            self._open = False
            return
        self._extent, self._written = standing.extent, time.monotonic()
        taken = max(0.0, self._written - began)
        self._pause = max(SECONDS_BETWEEN, min(taken / SHARE, MAX_BETWEEN))

    def remove(self) -> None:
        """Remove the checkpoint directory with all files at the end of the run."""
        shutil.rmtree(self._directory, ignore_errors=True)

    def how_to_go_on(self) -> str:
        """Return a message on the stored increments and how to resume, for a stopped process.

        The message is empty if no increment is stored.
        """
        if not (kept := self._kept()):
            return ""
        return f"the same command goes on after increment {kept}, kept in {self._directory}"

    def _kept(self) -> int:
        """Return the number of increments in the files, up to the first that is missing."""
        files = takewhile(Path.exists, map(self._part_path, count()))
        return max((end for end, _ in zip(self._ends, files, strict=False)), default=0)

    def _read_parts(self) -> Checkpoint | None:
        """Read the last checkpoint from the sequence of files; None if there is none.

        Reading ends at the first file that is damaged, belongs to another solve, or does not
        continue the preceding file.
        """
        standing: Checkpoint | None = None
        increments: list[Any] = []
        fields = FieldStore()
        while (path := self._part_path(len(self._ends))).exists():
            try:
                match read_checkpoint_file(path, self._identity):
                    case (int(before), Checkpoint() as part) if before == len(increments):
                        increments.extend(map(fields.store, part.increments))
                    case _:
                        raise Unusable(f"{path} contains no checkpoint that continues the last one")
            except Unusable as error:
                self._say(f"{error}; computed again")
                break
            standing = replace(part, increments=tuple(increments))
            self._ends.append(len(increments))
            self._extent = part.extent
        if standing is not None:
            self._say(
                f"going on after increment {self._kept()} of an interrupted run ({self._directory})"
            )
        return standing

    def _drop_from(self, first: int) -> None:
        """Remove the checkpoint files from the number `first` on, and all other files."""
        kept = {self._part_path(number).name for number in range(first)}
        for name in os.listdir(self._directory) if self._directory.is_dir() else ():
            if name not in kept:
                (self._directory / name).unlink(missing_ok=True)
        del self._ends[first:]

    def _part_path(self, number: int) -> Path:
        return self._directory / f"part-{number:06d}"


@contextmanager
def provide_checkpoints(
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
    checkpoint = CheckpointDirectory(directory, identity, say)
    try:
        with cleaned_up_when_stopped(kept=checkpoint.how_to_go_on):
            yield checkpoint
        checkpoint.remove()
    except SolverError:
        checkpoint.remove()
        raise
