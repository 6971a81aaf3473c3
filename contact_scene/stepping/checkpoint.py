"""Where the solve of a load history stands, for whoever keeps it.

A solve that goes on from there gives the same bits as one that was never interrupted.
"""

from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

S = TypeVar("S")


@dataclass(frozen=True)
class ResumePoint(Generic[S]):
    """A place in a march through the increments of a load history.

    done   increments that lie behind, of all steps together
    state  after the last of them
    start  at the start of the ramp that it belongs to; None before first touch
    last   increment counted from the last separation of the bodies; None without one
    """

    done: int
    state: S | None
    start: S | None
    last: Any = None

    def within(self, before: int, count: int) -> int:
        """How many of a step's `count` increments lie behind, if `before` precede the step."""
        return min(max(self.done - before, 0), count)


@dataclass(frozen=True)
class Checkpoint:
    """A solve after an increment.

    increments  all that lie behind, as they are reported
    mark        where the march goes on
    extent      of the grid or mesh that was chosen to hold the contact
    settled     names of what was computed once for all increments and is in their counts
    """

    increments: tuple[Any, ...]
    mark: ResumePoint[Any]
    extent: Any
    settled: tuple[str, ...] = ()


class CheckpointStore(Protocol):
    """Keeps where one solve stands, outside of its process."""

    def last(self) -> Checkpoint | None:
        """What was kept; None if nothing was."""

    def keep(self, standing: Checkpoint) -> None:
        """Told after every increment; may let some of them pass."""
