"""The load history resolved: for every step, what each control does from start to end."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from enum import Enum
from math import hypot
from typing import Generic, TypeVar

from contact_scene.loading import LoadStep
from contact_scene.solver_errors import motion_undefined

Vector = tuple[float, float]
Value = TypeVar("Value", float, Vector)

# The sine of an angle below this is round-off of a load that goes straight.
STRAIGHT = 1e-9


class ControlKind(Enum):
    """What is prescribed: the force, or the displacement that goes with it."""

    FORCE = "force"
    DISPLACEMENT = "displacement"


@dataclass(frozen=True)
class Control(Generic[Value]):
    """A coordinate of the rigid motion, or its force, from start to end of a step, linearly.

    kind   whether start and end are forces [force], moments [force length] for rotations; or
           displacements [length], rotations [radian]
    start  None where the step takes over from the other kind: known only once solved
    """

    kind: ControlKind
    start: Value | None
    end: Value

    def led(
        self, fraction: float, reached: tuple[Value, Value | None]
    ) -> tuple[Value | None, Value | None]:
        """Force and displacement at a fraction of the step, of which one is given.

        Exactly `end` at the end and wherever nothing changes, so that equal loads are equal.

        reached  force and displacement of the state at the start of the step, where it takes over
                 from the other kind; no displacement where that is undefined
        raises   GrossSliding where it would have to be taken over
        """
        by_force = self.kind is ControlKind.FORCE
        begin = self.start
        if begin is None:
            begin = reached[0] if by_force else reached[1]
        if begin is None:
            raise motion_undefined()
        value = _between(begin, self.end, fraction)
        return (value, None) if by_force else (None, value)


def _between(begin: Value, end: Value, fraction: float) -> Value:
    match begin, end:
        case (float(), float()):
            return _ramped(begin, end, fraction)
        case _:
            return _ramped(begin[0], end[0], fraction), _ramped(begin[1], end[1], fraction)


def _ramped(begin: float, end: float, fraction: float) -> float:
    return end if fraction == 1 or begin == end else begin + (end - begin) * fraction


ScalarControl = Control[float]
VectorControl = Control[Vector]


@dataclass(frozen=True)
class LoadRamp:
    """One loading step with nothing left implicit.

    step        number of the step, counted from 1
    normal      normal force or approach
    tangential  tangential force or shift, (x, y)
    twisting    torque or twist
    tilting     moment (Mx, My) or tilt (x, y)
    increments  as asked for in the scene, or None
    """

    step: int
    normal: ScalarControl
    tangential: VectorControl
    twisting: ScalarControl
    tilting: VectorControl
    increments: int | None


# The bodies just touch. Until a step names it, a coordinate is free to shift but not to rotate.
_AT_REST = LoadRamp(
    step=0,
    normal=ScalarControl(ControlKind.FORCE, 0.0, 0.0),
    tangential=VectorControl(ControlKind.FORCE, (0.0, 0.0), (0.0, 0.0)),
    twisting=ScalarControl(ControlKind.DISPLACEMENT, 0.0, 0.0),
    tilting=VectorControl(ControlKind.DISPLACEMENT, (0.0, 0.0), (0.0, 0.0)),
    increments=None,
)


def load_path(loading: Iterable[LoadStep]) -> tuple[LoadRamp, ...]:
    """Resolve steps: what a step does not name is held under its last control.

    Before the first step the bodies just touch: no load and no motion. The first step must name a
    normal load.
    """
    ramps: list[LoadRamp] = []
    last = _AT_REST
    for number, step in enumerate(loading, start=1):
        if last is _AT_REST and not step.names_normal:
            raise ValueError("the first step names no normal load")
        last = LoadRamp(
            number,
            _next(step.normal_force, step.approach, last.normal, last is _AT_REST),
            _next(step.tangential_force, step.tangential_shift, last.tangential, last is _AT_REST),
            _next(step.torque, step.twist, last.twisting, last is _AT_REST),
            _next(step.moment, step.tilt, last.tilting, last is _AT_REST),
            step.increments,
        )
        ramps.append(last)
    return tuple(ramps)


def along_one_line(ramps: Sequence[LoadRamp]) -> bool:
    """Whether all tangential loads are on one line, round-off apart, or are none."""
    ends = [ramp.tangential.end for ramp in ramps]
    longest = max(ends, key=lambda end: hypot(*end))
    return all(
        abs(longest[0] * end[1] - longest[1] * end[0]) <= STRAIGHT * hypot(*longest) * hypot(*end)
        for end in ends
    )


def _next(
    force: Value | None, displacement: Value | None, last: Control[Value], at_rest: bool
) -> Control[Value]:
    """What a step does with one coordinate, of which it names at most one control.

    at_rest  force and displacement are both zero so far, whichever of them was controlled
    """
    named = displacement if force is None else force
    if named is None:
        return Control(last.kind, last.end, last.end)
    kind = ControlKind.DISPLACEMENT if force is None else ControlKind.FORCE
    return Control(kind, last.end if last.kind is kind or at_rest else None, named)
