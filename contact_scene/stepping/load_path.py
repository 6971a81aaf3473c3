"""Load history of a scene as load ramps: linear changes of all controls in each load step."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from math import hypot
from typing import Any, Generic, TypeVar

from contact_scene.bulk_strain import UNSTRAINED, Strain, strain_under
from contact_scene.loading import LoadStep
from contact_scene.material import Material
from contact_scene.quantities.increment import STIFFNESSES
from contact_scene.solver_errors import motion_undefined

Vector = tuple[float, float]
Value = TypeVar("Value", float, Vector)

# Sine of an angle that is round-off of a straight load path.
STRAIGHT = 1e-9


class ControlKind(Enum):
    """Kind of the prescribed quantity of a coordinate of the indenter: force or displacement."""

    FORCE = "force"
    DISPLACEMENT = "displacement"


@dataclass(frozen=True)
class Control(Generic[Value]):
    """Prescribed force or displacement of one coordinate of the indenter, linear in a load step.

    The force may be a moment or torque, the displacement a rotation.

    kind        kind of start and end: forces [force] or, for rotations, moments [force length];
                displacements [length] or rotations [radian]
    start, end  values at the start and at the end of the load step. The start is None if the
                preceding control is of the other kind; its value is a result of the preceding load
                step
    """

    kind: ControlKind
    start: Value | None
    end: Value

    def prescribed(
        self, fraction: float, reached: tuple[Value, Value | None]
    ) -> tuple[Value | None, Value | None]:
        """Compute the prescribed force or displacement of the indenter within a load step.

        At the end of the step, and for a constant control, the value is exactly `end`, so that
        equal loads of different steps are equal bit for bit.

        fraction  fraction of the load step, from 0 to 1
        reached   force and displacement at the start of the step, used if `start` is None; the
                  displacement is None if undefined
        returns   force and displacement; the one that is not prescribed is None

        Raises GrossSliding if the ramp starts from an undefined displacement.
        """
        by_force = self.kind is ControlKind.FORCE
        begin = self.start
        if begin is None:
            begin = reached[0] if by_force else reached[1]
        if begin is None:
            raise motion_undefined()
        value = _interpolate_ramp(begin, self.end, fraction)
        return (value, None) if by_force else (None, value)


def _interpolate_ramp(begin: Any, end: Any, fraction: float) -> Any:
    """Interpolate a value, or each component of a tuple; the value at the end is exact."""
    if isinstance(end, tuple):
        return tuple(_interpolate_ramp(*ends, fraction) for ends in zip(begin, end, strict=True))
    return end if fraction == 1 or begin == end else begin + (end - begin) * fraction


ScalarControl = Control[float]
VectorControl = Control[Vector]


@dataclass(frozen=True)
class LoadRamp:
    """Load step of a scene, resolved into the linear changes of all loads of the indenter.

    Each coordinate of the indenter has a control: a prescribed force or displacement, with values
    at the start and at the end of the step.

    step        number of the load step, counted from 1
    normal      normal force or approach
    tangential  tangential force or shift, (x, y)
    twisting    torque or twist
    tilting     moment (Mx, My) or tilt (x, y)
    increments  number of increments in the scene; None if the solver chooses
    stretch     bulk strain of the lower body at start and end; None without a bulk strain in the
                history
    """

    step: int
    normal: ScalarControl
    tangential: VectorControl
    twisting: ScalarControl
    tilting: VectorControl
    increments: int | None
    stretch: tuple[Strain, Strain] | None = None

    def strain(self, fraction: float) -> Strain | None:
        """Interpolate the bulk strain of the lower body at a fraction of the load step.

        The result (εxx, εyy, εxy) is None without a bulk strain in the history.

        fraction  fraction of the load step, from 0 to 1
        """
        strain: Strain | None = self.stretch and _interpolate_ramp(*self.stretch, fraction)
        return strain

    @property
    def strains(self) -> bool:
        """True if the bulk strain of the lower body changes in the load step.

        The bulk strain is a uniform strain parallel to the surface.
        """
        return self.stretch is not None and self.stretch[0] != self.stretch[1]


# First contact without load. Shifts are free and rotations are fixed until a step prescribes them.
_AT_REST = LoadRamp(
    step=0,
    normal=ScalarControl(ControlKind.FORCE, 0.0, 0.0),
    tangential=VectorControl(ControlKind.FORCE, (0.0, 0.0), (0.0, 0.0)),
    twisting=ScalarControl(ControlKind.DISPLACEMENT, 0.0, 0.0),
    tilting=VectorControl(ControlKind.DISPLACEMENT, (0.0, 0.0), (0.0, 0.0)),
    increments=None,
)


def load_path(
    loading: Sequence[LoadStep], base: Material | None = None, *, line: bool = False
) -> tuple[LoadRamp, ...]:
    """Resolve the load steps of a scene into load ramps: linear changes of all loads.

    Each coordinate of the indenter has a prescribed force or displacement in each ramp. A
    coordinate that a load step does not prescribe keeps its last value. The history starts from
    first contact without load.

    loading  load steps in order; the first must prescribe a normal load
    base     material of the substrate, for bulk stresses; without a material, bulk stresses are
             ignored
    line     True for a line contact, in which the bulk strain is plane

    Raises ValueError if the first load step prescribes no normal load.
    """
    ramps: list[LoadRamp] = []
    last = _AT_REST
    strains = (step.bulk_strain or (base and step.bulk_stress) or () for step in loading)
    if any(map(any, strains)):
        last = replace(last, stretch=(UNSTRAINED, UNSTRAINED))
    at_rest = last
    for number, step in enumerate(loading, start=1):
        if last is at_rest and not step.prescribes_normal:
            raise ValueError("the first step names no normal load")
        last = LoadRamp(
            number,
            _next_control(step.normal_force, step.approach, last.normal, last is at_rest),
            _next_control(
                step.tangential_force, step.tangential_shift, last.tangential, last is at_rest
            ),
            _next_control(step.torque, step.twist, last.twisting, last is at_rest),
            _next_control(step.moment, step.tilt, last.tilting, last is at_rest),
            step.increments,
            _bulk_strain_of_step(step, last, base, line=line),
        )
        ramps.append(last)
    return tuple(ramps)


def first_direction(ramps: Sequence[LoadRamp]) -> tuple[float, float]:
    """Return the direction of the first nonzero tangential force or shift of a load history.

    The direction is a unit vector (x, y). It is (1, 0) without a tangential load.

    ramps  load ramps of the history, one for each load step
    """
    for ramp in ramps:
        x, y = ramp.tangential.end
        if x or y:
            return x / hypot(x, y), y / hypot(x, y)
    return 1.0, 0.0


def load_changes(ramps: Sequence[LoadRamp], step: int) -> tuple[Vector, dict[str, bool]]:
    """Return the direction in which the tangential load changes in a load step, and its changes.

    The direction is a unit vector (x, y). In a step of constant tangential load it is that of the
    last step before that changes it, or else of the first after; without such a step it is zero.
    The changes are, for the name of each contact stiffness, True if the step changes the load.

    ramps  load ramps of the history, one for each load step
    step   number of the load step, from 1
    """
    direction = 0.0, 0.0
    for ramp in ramps:
        (x, y), (x_0, y_0) = ramp.tangential.end, ramp.tangential.start or (0.0, 0.0)
        size = hypot(x - x_0, y - y_0)
        if size and (ramp.step <= step or direction == (0.0, 0.0)):
            direction = (x - x_0) / size, (y - y_0) / size
    now = ramps[step - 1]
    controls = now.normal, now.tangential, now.twisting
    changes = [control.start != control.end for control in controls]
    return direction, dict(zip(STIFFNESSES, changes, strict=True))


def along_one_line(ramps: Sequence[LoadRamp]) -> bool:
    """Determine if the tangential loads at the ends of all load steps lie on one line.

    The loads are tangential forces or shifts (x, y). A value of 0 lies on every line, and
    deviations of round-off are allowed.

    ramps  load ramps of the history, one for each load step
    """
    ends = [ramp.tangential.end for ramp in ramps]
    longest = max(ends, key=lambda end: hypot(*end))
    return all(
        abs(longest[0] * end[1] - longest[1] * end[0]) <= STRAIGHT * hypot(*longest) * hypot(*end)
        for end in ends
    )


def _bulk_strain_of_step(
    step: LoadStep, last: LoadRamp, base: Material | None, *, line: bool
) -> tuple[Strain, Strain] | None:
    """Determine the strains (εxx, εyy, εxy) at start and end, given directly or by a stress,
    or else those of the preceding step; None without a bulk strain in the history."""
    if last.stretch is None:
        return None
    start = last.stretch[1]
    by_stress = (
        strain_under(step.bulk_stress, base, line=line) if step.bulk_stress and base else None
    )
    return start, step.bulk_strain or by_stress or start


def _next_control(
    force: Value | None, displacement: Value | None, last: Control[Value], at_rest: bool
) -> Control[Value]:
    """Determine the control of a coordinate, which keeps the last value of its control without a
    new one. The ramp starts from 0 if force and displacement are both zero so far (`at_rest`)."""
    named = displacement if force is None else force
    if named is None:
        return Control(last.kind, last.end, last.end)
    kind = ControlKind.DISPLACEMENT if force is None else ControlKind.FORCE
    return Control(kind, last.end if last.kind is kind or at_rest else None, named)
