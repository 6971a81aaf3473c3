"""March through a load history: state, increment, state; a method solves the increments."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Generic, Protocol, TypeVar

from contact_scene import ControlKind, LoadRamp, Scene
from contact_scene.load_path import ScalarControl
from contact_scene.solver_errors import GrossSliding, NotConverged, SolverError
from contact_scene.standing import Mark, Standing
from fem_reference.energy import accounted
from fem_reference.fields import Increment
from fem_reference.loads import Loads, NormalTarget, Place, TangentialTarget, TwistTarget
from fem_reference.plan import Path, Plan

MOST_HALVINGS = 4


class State(Protocol):
    """What the frame reads off the state of a method; zero where a path has no such motion.

    A shift or twist is None where it is undefined: at the friction limit under force control.
    """

    @property
    def normal_force(self) -> float: ...
    @property
    def approach(self) -> float: ...
    @property
    def tangential_force(self) -> float: ...
    @property
    def tangential_shift(self) -> float | None: ...
    @property
    def torque(self) -> float: ...
    @property
    def twist(self) -> float | None: ...


S = TypeVar("S", bound=State)


class Method(Protocol[S]):
    """A way of solving increments."""

    def advance(self, before: S | None, loads: Loads, tolerance: float) -> S:
        """The state at the end of an increment; raises NotConverged, GrossSliding."""

    def increment(self, state: S, place: Place) -> Increment:
        """The state as it is reported."""


def march(scene: Scene, plan: Plan, method: Method[S], tolerance: float) -> Iterator[Increment]:
    """Increments of the scene's load path, one after the other; raises what `marked` raises."""
    return (increment for increment, _ in marked(scene, plan, method, tolerance))


def marked(
    scene: Scene,
    plan: Plan,
    method: Method[S],
    tolerance: float,
    since: Standing | None = None,
) -> Iterator[tuple[Increment, Mark[S]]]:
    """Increments of the scene's load path, each with the mark from which the march can go on.

    since   where the same march stood before, to go on from there
    raises  NotConverged and GrossSliding, with the last converged increment as `last_state`
    """
    mark: Mark[S] | None = since.mark if since else None
    state = mark.state if mark else None
    last: Increment | None = since.increments[-1] if since else None
    done = 0
    for ramp, count in zip(scene.load_path(), plan.increments, strict=True):
        behind = mark.within(done, count) if mark else 0
        start = mark.start if mark and 0 < behind < count else state
        path = _Path(method, plan, ramp, start, tolerance)
        fractions = [0.0, *_fractions(scene, ramp, count)]
        done += behind
        begin = fractions[behind]
        for index, end in enumerate(fractions[behind + 1 :], start=behind + 1):
            try:
                state, halvings = path.reach(state, begin, end, MOST_HALVINGS)
            except SolverError as error:
                error.where = f"step {ramp.step}, increment {index} of {count}"
                error.last_state = last
                raise
            place = Place(ramp.step, index, count)
            told = replace(method.increment(state, place), halvings=halvings)
            last = accounted(scene, plan, last, told)
            begin, done = end, done + 1
            yield last, Mark(done, state, start)


@dataclass(frozen=True)
class _Path(Generic[S]):
    """The loads along one ramp, from the state at its start."""

    method: Method[S]
    plan: Plan
    ramp: LoadRamp
    start: S | None
    tolerance: float

    def reach(self, state: S | None, begin: float, end: float, halvings_left: int) -> tuple[S, int]:
        """The state at fraction `end`, in two halves where one increment does not converge, and
        the number of halvings that took."""
        try:
            return self.method.advance(state, self._loads(end), self.tolerance), 0
        except NotConverged:
            if halvings_left == 0:
                raise
        middle = 0.5 * (begin + end)
        half, first = self.reach(state, begin, middle, halvings_left - 1)
        whole, second = self.reach(half, middle, end, halvings_left - 1)
        return whole, 1 + first + second

    def _loads(self, fraction: float) -> Loads:
        path = self.plan.path
        return Loads(
            self._normal(fraction),
            self._tangential(fraction) if path in (Path.SHEARING, Path.HARMONICS) else None,
            self._twisting(fraction) if path is Path.TWISTING else None,
        )

    def _normal(self, fraction: float) -> NormalTarget:
        control = self.ramp.normal
        if control.kind is ControlKind.FORCE:
            reached = self.start.normal_force if self.start else 0.0
            return NormalTarget(force=_at(control, reached, fraction))
        reached = self.start.approach if self.start else 0.0
        return NormalTarget(approach=_at(control, reached, fraction))

    def _tangential(self, fraction: float) -> TangentialTarget:
        control = self.ramp.tangential
        x, y = self.plan.direction
        along = ScalarControl(
            control.kind,
            None if control.start is None else control.start[0] * x + control.start[1] * y,
            control.end[0] * x + control.end[1] * y,
        )
        if control.kind is ControlKind.FORCE:
            reached = self.start.tangential_force if self.start else 0.0
            return TangentialTarget(force=_at(along, reached, fraction))
        shift = self.start.tangential_shift if self.start else 0.0
        return TangentialTarget(shift=_at(along, _defined(along, shift, "shift"), fraction))

    def _twisting(self, fraction: float) -> TwistTarget:
        control = self.ramp.twisting
        if control.kind is ControlKind.FORCE:
            reached = self.start.torque if self.start else 0.0
            return TwistTarget(torque=_at(control, reached, fraction))
        twist = self.start.twist if self.start else 0.0
        return TwistTarget(twist=_at(control, _defined(control, twist, "twist"), fraction))


def _defined(control: ScalarControl, reached: float | None, name: str) -> float:
    if reached is None:
        raise GrossSliding(
            f"the step before reached the friction limit under force control, where the {name} is "
            f"undefined; end that step below the limit"
        )
    return reached


def _at(control: ScalarControl, reached: float, fraction: float) -> float:
    """Between start and end; exactly `end` at the end and wherever nothing changes.

    reached  by the state at the start, where the control takes over from another
    """
    begin = reached if control.start is None else control.start
    if fraction == 1 or begin == control.end:
        return control.end
    return begin + (control.end - begin) * fraction


def _fractions(scene: Scene, ramp: LoadRamp, count: int) -> list[float]:
    """Where in the ramp the increments end: uniform in contact radius while the normal load
    grows from zero, uniform in load otherwise."""
    exponent = None
    if ramp.normal.start == 0:
        exponent = scene.indenter.gap_exponent
        if exponent is not None and ramp.normal.kind is ControlKind.FORCE:
            exponent += 1
    return [(k / count) ** (exponent or 1) for k in range(1, count + 1)]
