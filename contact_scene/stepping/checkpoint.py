"""Checkpoints of the solve of a load history.

A solve that continues from a checkpoint gives the same bits as an uninterrupted solve.
"""

from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

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
