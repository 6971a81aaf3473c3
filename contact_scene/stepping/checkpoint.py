"""Checkpoints of the solve of a load history, from which an interrupted solve continues.

A solve that continues from a checkpoint gives the same bits as an uninterrupted solve.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from contact_scene.quantities.stored_fields import FieldStore

S = TypeVar("S")


@dataclass(frozen=True)
class ResumePoint(Generic[S]):
    """Position in a load history at which an interrupted solve resumes, with the solver states.

    done   number of completed increments of all load steps
    state  state of the solver after the last of them; None without contact
    start  state of the solver at the start of the current load ramp; None without contact
    last   last reported increment, with displacements and energies counted from the last separation
           of the bodies; None without a separation or without contact since then
    """

    done: int
    state: S | None
    start: S | None
    last: Any = None

    def completed_in_step(self, before: int, count: int) -> int:
        """Return the number of increments of one load step that precede the resume point.

        A resumed solve skips these increments.

        before  number of increments of all earlier load steps
        count   number of increments of the load step
        """
        return min(max(self.done - before, 0), count)


@dataclass(frozen=True)
class Checkpoint:
    """Stored state of a solve after an increment, from which an interrupted solve resumes.

    increments  all increments reported so far
    point       resume point of the load history: position, and states of the solver
    extent      size of the grid or mesh
    settled     names of computations for all increments, such as a factorisation, whose work the
                counters of earlier increments contain already
    """

    increments: tuple[Any, ...]
    point: ResumePoint[Any]
    extent: Any
    settled: tuple[str, ...] = ()


class CheckpointStore(Protocol):
    """Interface of a storage for the checkpoints of one solve, outside of its process."""

    def last(self) -> Checkpoint | None:
        """Return the checkpoint of the solve that was stored last; None if there is none."""

    def keep(self, checkpoint: Checkpoint) -> None:
        """Store a checkpoint of the solve. Called after every increment; may skip calls.

        An interrupted solve resumes from the checkpoint that was stored last.

        checkpoint  increments so far, and states for the next increment
        """


def store_checkpoints(
    history: Iterable[tuple[Any, ResumePoint[Any]]],
    since: Checkpoint | None,
    store: CheckpointStore | None,
    progress: Callable[[Any], None] | None,
    extent: Any,
    settled: Iterable[str] = (),
) -> Iterator[Any]:
    """Yield the increments of a solve, and store a checkpoint after each for an interrupted run.

    The increments of the checkpoint from which the solve continues come first.

    history   new increments with their resume points (position and states for the next increment)
    since     checkpoint from which the solve continues; None for a new solve
    store     storage of the checkpoints; None to store none
    progress  function called with each increment
    extent    size of the grid or mesh, for the checkpoints
    settled   names of computations for all increments whose work the counters contain already; read
              after every increment
    """
    increments, fields = list[Any](), FieldStore()
    for increment in since.increments if since else ():
        increments.append(increment)
        if progress is not None:
            progress(increment)
        yield increment
    for increment, point in history:
        increments.append(fields.store(increment))
        if store is not None:
            store.keep(Checkpoint(tuple(increments), point, extent, tuple(sorted(settled))))
        if progress is not None:
            progress(increments[-1])
        yield increments[-1]
