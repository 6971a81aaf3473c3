"""Checkpoints of the solve of a load history.

A solve that continues from a checkpoint gives the same bits as an uninterrupted solve.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from contact_scene.quantities.stored_fields import FieldStore

S = TypeVar("S")


@dataclass(frozen=True)
class ResumePoint(Generic[S]):
    """Resume point of a load history.

    done   number of completed increments of all steps
    state  state after the last of them; None without contact
    start  state at the start of the current ramp; None without contact
    last   last increment, counted from the last separation of the bodies; None without one
    """

    done: int
    state: S | None
    start: S | None
    last: Any = None

    def within(self, before: int, count: int) -> int:
        """Return the number of completed increments of one load step.

        before  number of increments of all earlier steps
        count   number of increments of the step
        """
        return min(max(self.done - before, 0), count)


@dataclass(frozen=True)
class Checkpoint:
    """State of a solve after an increment.

    increments  reported increments so far
    point       resume point
    extent      size of the grid or mesh
    settled     names of computations for all increments that are in the counters already
    """

    increments: tuple[Any, ...]
    point: ResumePoint[Any]
    extent: Any
    settled: tuple[str, ...] = ()


class CheckpointStore(Protocol):
    """Storage of the checkpoints of one solve, outside of its process."""

    def last(self) -> Checkpoint | None:
        """Return the last stored checkpoint; None if there is none."""

    def keep(self, checkpoint: Checkpoint) -> None:
        """Store a checkpoint. Called after every increment; an implementation may skip calls."""


def with_checkpoints(
    history: Iterable[tuple[Any, ResumePoint[Any]]],
    since: Checkpoint | None,
    store: CheckpointStore | None,
    progress: Callable[[Any], None] | None,
    extent: Any,
    settled: Iterable[str] = (),
) -> Iterator[Any]:
    """Yield the increments of a checkpoint, then new ones, after each of which one is stored.

    history   new increments with their resume points, see `resumable_increments`
    since     checkpoint from which the solve continues
    progress  called with each increment
    extent    size of the grid or mesh
    settled   names for the checkpoint, read after every increment
    """
    increments, fields = list[Any](), FieldStore()
    for increment in since.increments if since else ():
        increments.append(increment)
        if progress is not None:
            progress(increment)
        yield increment
    for increment, point in history:
        increments.append(fields.stored(increment))
        if store is not None:
            store.keep(Checkpoint(tuple(increments), point, extent, tuple(sorted(settled))))
        if progress is not None:
            progress(increments[-1])
        yield increments[-1]
