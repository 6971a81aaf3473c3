"""March through a load history: steps are cut into increments, and these in halves where needed."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.bulk_strain import with_strain
from contact_scene.quantities.separation import (
    continued,
    position,
    separated,
    since_touch,
    virgin,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.scene import Scene
from contact_scene.solver_errors import NotConverged, NothingTouches, SolverError
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    ResumePoint,
)
from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
)

MAX_HALVINGS = 4

Field = NDArray[np.float64]

S = TypeVar("S")
Told = TypeVar("Told")


@dataclass(frozen=True)
class Place:
    """Where in the history an increment stands: step and increment counted from 1."""

    step: int
    index: int
    increments_in_step: int


@dataclass(frozen=True)
class Reached(Generic[S]):
    """The end of an increment.

    before    state at its start; None before first touch
    halvings  how often it was cut in two to converge
    spent     what the solver has spent on it
    """

    place: Place
    before: S | None
    state: S
    halvings: int
    spent: float


class Solver(Protocol[S, Told]):
    """What solves the increments of a history, and reports them.

    most_spent  an increment that has taken more without converging is not cut any further
    """

    @property
    def most_spent(self) -> float: ...

    def spent(self) -> float:
        """Counted so far, in a unit of its own."""

    def advance(self, ramp: LoadRamp, start: S | None, before: S | None, fraction: float) -> S:
        """The state at a fraction of a ramp, from the state before; `start` is that of the ramp.

        raises  NotConverged, and what halves do not help against
        """

    def report(self, reached: Reached[S], last: Told | None) -> Told:
        """The increment as it is reported, after the last one that was."""

    def undeformed_gap(self, last: Told, tilt: Any) -> Field:
        """Return the gap without tractions at the approach 0, where an increment has its gap."""


def resumable_increments(
    scene: Scene, counts: Sequence[int], solver: Solver[S, Told], since: Checkpoint | None
) -> Iterator[tuple[Told, ResumePoint[S]]]:
    """Increments of the scene's load path, each with the mark from which the march can go on.

    counts  how many increments each loading step takes
    since   where the same march stood before, to go on from there
    raises  what the solver raises, with the last converged increment as `last_state`

    An increment within a step that touches nothing at its approach, before first touch or before
    separation, is the empty contact. Those before the first contact of all are returned together
    with it, as it determines the shapes of their arrays.
    """

    def empty(last: Told, ramp: LoadRamp, end: float, approach: float | None, place: Place) -> Told:
        """Return the empty contact at a fraction of a ramp."""
        gap = solver.undeformed_gap(last, position(last, ramp, end)["tilt"])
        return with_strain(separated(last, ramp, end, gap, vars(place), approach), ramp.strain(end))

    mark: ResumePoint[S] | None = since.mark if since else None
    told: Sequence[Any] = since.increments if since else ()
    last: Told | None = told[-1] if told else None
    apart = next((i for i in reversed(told) if i.status is ContactStatus.SEPARATED), None)
    state, done, here = mark.state if mark else None, 0, mark.last if mark else None
    for ramp, count in zip(scene.load_path(), counts, strict=True):
        behind = mark.within(done, count) if mark else 0
        start = mark.start if mark and 0 < behind < count else state
        done += behind
        ends = [0.0, *fractions(scene, ramp, count)]
        led = since_touch(ramp, apart) if apart else ramp
        untouched: list[tuple[float, float | None, Place]] = []
        for index in range(behind + 1, len(ends)):
            place, end = Place(ramp.step, index, count), ends[index]
            done += 1
            before, way = state, _Way(solver, led, start, solver.spent())
            falls = ramp.normal.end == 0
            approach, touches = None, not (falls and (start is None or index == count))
            reached: Reached[S] | None = None
            try:
                if touches:
                    found, halvings = way.reach(before, ends[index - 1], end, MAX_HALVINGS)
                    spent = solver.spent() - way.begun
                    reached = Reached(place, before, found, halvings, spent)
            except SolverError as error:
                fails = not isinstance(error, NothingTouches) or index == count
                if fails or not (falls or before is None):
                    error.where = f"step {ramp.step}, increment {index} of {count}"
                    error.last_state = last
                    raise
                approach = ramp.normal.led(end, (0.0, 0.0))[1]
            if reached is not None:
                state = reached.state
                report = solver.report(reached, here if apart else last)
                here = with_strain(report, ramp.strain(end))
                for earlier, approach, at in untouched:
                    last = apart = empty(apart or virgin(here), ramp, earlier, approach, at)
                    yield apart, ResumePoint(done - index + at.index, None, start)
                untouched.clear()
                last = continued(apart, here) if apart else here
                yield last, ResumePoint(done, state, start, here if apart else None)
            elif last is None:
                untouched.append((end, approach, place))
            else:
                last = apart = empty(last, ramp, end, approach, place)
                state = here = None
                yield last, ResumePoint(done, state, start)


def fractions(scene: Scene, ramp: LoadRamp, count: int) -> list[float]:
    """Where in the ramp the increments end: uniform in contact radius while the normal load
    grows from zero or falls to it, uniform in load otherwise."""
    exponent = None
    falls = ramp.normal.end == 0
    if ramp.normal.start == 0 or falls:
        exponent = scene.indenter.gap_exponent
        if exponent is not None and ramp.normal.kind is ControlKind.FORCE:
            exponent += 1
    radii = [(k / count) ** (exponent or 1) for k in range(count + 1)]
    return [1 - radius for radius in radii[-2::-1]] if falls else radii[1:]


@dataclass(frozen=True)
class _Way(Generic[S]):
    """Along one ramp, from the state at its start; `begun` with so much spent."""

    solver: Solver[S, Any]
    ramp: LoadRamp
    start: S | None
    begun: float

    def reach(self, state: S | None, begin: float, end: float, halvings_left: int) -> tuple[S, int]:
        """The state at fraction `end`, in two halves where one increment does not converge, and
        the number of halvings that took."""
        try:
            return self.solver.advance(self.ramp, self.start, state, end), 0
        except NotConverged:
            too_much = self.begun + self.solver.most_spent
            if halvings_left == 0 or self.solver.spent() > too_much:
                raise
        middle = 0.5 * (begin + end)
        try:
            half, first = self.reach(state, begin, middle, halvings_left - 1)
        except NothingTouches:
            if state is not None:
                raise
            half, first = None, 0  # the empty contact
        whole, second = self.reach(half, middle, end, halvings_left - 1)
        return whole, 1 + first + second
