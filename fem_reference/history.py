"""March through a load history: state, increment, state; a method solves the increments."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Generic, Protocol, TypeVar

from contact_scene import LoadRamp, Scene
from contact_scene.load_path import ScalarControl
from contact_scene.march import Place, Reached, marked_increments
from contact_scene.standing import Mark, Standing
from fem_reference.energy import accounted
from fem_reference.fields import Increment
from fem_reference.loads import Loads, NormalTarget, TangentialTarget, TwistTarget
from fem_reference.plan import Path, Plan


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
    return marked_increments(scene, plan.increments, _Solver(scene, method, plan, tolerance), since)


@dataclass(frozen=True)
class _Solver(Generic[S]):
    """A method as the march sees it: it counts nothing, and halves as often as it may."""

    scene: Scene
    method: Method[S]
    plan: Plan
    tolerance: float
    most_spent: float = 0.0

    def spent(self) -> float:
        """Nothing."""
        return 0.0

    def advance(self, ramp: LoadRamp, start: S | None, before: S | None, fraction: float) -> S:
        """The state at a fraction of the ramp."""
        path = self.plan.path
        loads = Loads(
            _normal(ramp, start, fraction),
            self._tangential(ramp, start, fraction)
            if path in (Path.SHEARING, Path.HARMONICS)
            else None,
            _twisting(ramp, start, fraction) if path is Path.TWISTING else None,
        )
        return self.method.advance(before, loads, self.tolerance)

    def report(self, reached: Reached[S], last: Increment | None) -> Increment:
        """As the method reports it, with the account of energy carried on."""
        increment = self.method.increment(reached.state, reached.place)
        increment = replace(increment, halvings=reached.halvings)
        return accounted(self.scene, self.plan, last, increment)

    def _tangential(self, ramp: LoadRamp, start: S | None, fraction: float) -> TangentialTarget:
        control = ramp.tangential
        x, y = self.plan.direction
        along = ScalarControl(
            control.kind,
            None if control.start is None else control.start[0] * x + control.start[1] * y,
            control.end[0] * x + control.end[1] * y,
        )
        reached = (start.tangential_force, start.tangential_shift) if start else (0.0, 0.0)
        return TangentialTarget(*along.led(fraction, reached))


def _normal(ramp: LoadRamp, start: State | None, fraction: float) -> NormalTarget:
    reached = (start.normal_force, start.approach) if start else (0.0, 0.0)
    return NormalTarget(*ramp.normal.led(fraction, reached))


def _twisting(ramp: LoadRamp, start: State | None, fraction: float) -> TwistTarget:
    reached = (start.torque, start.twist) if start else (0.0, 0.0)
    return TwistTarget(*ramp.twisting.led(fraction, reached))
