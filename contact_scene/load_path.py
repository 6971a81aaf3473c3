"""The load history resolved: for every step, what each control does from start to end."""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from contact_scene.loading import LoadStep

Vector = tuple[float, float]


class ControlKind(Enum):
    """What is prescribed: the force, or the displacement that goes with it."""

    FORCE = "force"
    DISPLACEMENT = "displacement"


@dataclass(frozen=True)
class NormalControl:
    """Normal force [force] or approach [length] from start to end of a step, linearly.

    start is None where the step takes over from the other kind: known only once solved.
    """

    kind: ControlKind
    start: float | None
    end: float


@dataclass(frozen=True)
class TangentialControl:
    """Tangential force [force] or shift [length], (x, y), from start to end of a step, linearly.

    start is None where the step takes over from the other kind: known only once solved.
    """

    kind: ControlKind
    start: Vector | None
    end: Vector


@dataclass(frozen=True)
class LoadRamp:
    """One loading step with nothing left implicit.

    step        number of the step, counted from 1
    increments  as asked for in the scene, or None
    """

    step: int
    normal: NormalControl
    tangential: TangentialControl
    increments: int | None


def load_path(loading: Iterable[LoadStep]) -> tuple[LoadRamp, ...]:
    """Resolve steps: what a step does not name is held under its last control.

    Before the first step the bodies just touch: no force, no approach, no shift. The first step
    must name a normal load.
    """
    ramps: list[LoadRamp] = []
    normal: NormalControl | None = None
    tangential: TangentialControl | None = None
    for number, step in enumerate(loading, start=1):
        normal = _next_normal(step, normal)
        tangential = _next_tangential(step, tangential)
        ramps.append(LoadRamp(number, normal, tangential, step.increments))
    return tuple(ramps)


def _next_normal(step: LoadStep, last: NormalControl | None) -> NormalControl:
    if step.normal_force is not None:
        kind, end = ControlKind.FORCE, step.normal_force
    elif step.approach is not None:
        kind, end = ControlKind.DISPLACEMENT, step.approach
    elif last is not None:
        return NormalControl(last.kind, last.end, last.end)
    else:
        raise ValueError("the first step names no normal load")
    if last is None:
        return NormalControl(kind, 0.0, end)
    return NormalControl(kind, last.end if last.kind is kind else None, end)


def _next_tangential(step: LoadStep, last: TangentialControl | None) -> TangentialControl:
    if step.tangential_force is not None:
        kind, end = ControlKind.FORCE, step.tangential_force
    elif step.tangential_shift is not None:
        kind, end = ControlKind.DISPLACEMENT, step.tangential_shift
    elif last is not None:
        return TangentialControl(last.kind, last.end, last.end)
    else:
        return TangentialControl(ControlKind.FORCE, (0.0, 0.0), (0.0, 0.0))
    if last is None:
        return TangentialControl(kind, (0.0, 0.0), end)
    return TangentialControl(kind, last.end if last.kind is kind else None, end)
