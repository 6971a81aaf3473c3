"""The load history resolved: for every step, what each control does from start to end."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from math import hypot
from typing import Generic, TypeVar

from contact_scene.bulk_strain import UNSTRAINED, Strain, strain_under
from contact_scene.loading import LoadStep
from contact_scene.material import Material
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
    stretch     bulk strain of the lower body at start and end; None where no step names one
    """

    step: int
    normal: ScalarControl
    tangential: VectorControl
    twisting: ScalarControl
    tilting: VectorControl
    increments: int | None
    stretch: tuple[Strain, Strain] | None = None

    def strain(self, fraction: float) -> Strain | None:
        """Bulk strain at a fraction of the step; None where no step names one."""
        if self.stretch is None:
            return None
        xx, yy, xy = (_ramped(*ends, fraction) for ends in zip(*self.stretch, strict=True))
        return xx, yy, xy

    @property
    def strains(self) -> bool:
        """Whether the bulk strain changes."""
        return self.stretch is not None and self.stretch[0] != self.stretch[1]


# The bodies just touch. Until a step names it, a coordinate is free to shift but not to rotate.
_AT_REST = LoadRamp(
    step=0,
    normal=ScalarControl(ControlKind.FORCE, 0.0, 0.0),
    tangential=VectorControl(ControlKind.FORCE, (0.0, 0.0), (0.0, 0.0)),
    twisting=ScalarControl(ControlKind.DISPLACEMENT, 0.0, 0.0),
    tilting=VectorControl(ControlKind.DISPLACEMENT, (0.0, 0.0), (0.0, 0.0)),
    increments=None,
)


def load_path(loading: Sequence[LoadStep], base: Material | None = None) -> tuple[LoadRamp, ...]:
    """Resolve steps: what a step does not name is held under its last control.

    Before the first step the bodies just touch: no load and no motion. The first step must name a
    normal load.

    base  material of the substrate, for bulk stresses; without it these are not resolved
    """
    ramps: list[LoadRamp] = []
    last = _AT_REST
    strains = (step.bulk_strain or (base and step.bulk_stress) or () for step in loading)
    if any(map(any, strains)):
        last = replace(last, stretch=(UNSTRAINED, UNSTRAINED))
    at_rest = last
    for number, step in enumerate(loading, start=1):
        if last is at_rest and not step.names_normal:
            raise ValueError("the first step names no normal load")
        last = LoadRamp(
            number,
            _next(step.normal_force, step.approach, last.normal, last is at_rest),
            _next(step.tangential_force, step.tangential_shift, last.tangential, last is at_rest),
            _next(step.torque, step.twist, last.twisting, last is at_rest),
            _next(step.moment, step.tilt, last.tilting, last is at_rest),
            step.increments,
            _stretched(step, last, base),
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


def _stretched(
    step: LoadStep, last: LoadRamp, base: Material | None
) -> tuple[Strain, Strain] | None:
    """Bulk strain at start and end of a step."""
    if last.stretch is None:
        return None
    end = last.stretch[1]
    if step.bulk_strain is not None:
        end = step.bulk_strain
    elif step.bulk_stress is not None and base is not None:
        end = strain_under(step.bulk_stress, base)
    return last.stretch[1], end


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
