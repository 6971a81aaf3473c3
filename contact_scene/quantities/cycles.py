"""Load cycles: where a history of loads returns to a load that it has had before."""

from collections.abc import Iterable
from dataclasses import dataclass

from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
    ScalarControl,
    VectorControl,
)

# Loads that differ by less, relative to the largest of their kind, are the same load.
DIGITS = 9

# Increments of a step within a cycle, by which the work of the cycle, a sum of trapezoids, agrees
# with the energy it dissipates to one per cent; where a motion is led, slip may begin at any part
# of the step. Measured on loops of .3 to .99 of the friction limit, and of shifts up to 15 times
# that of gross sliding: .08 to .8 and .6 per cent.
LED_BY_FORCE = 16
LED_BY_MOTION = 32

State = tuple[tuple[str, tuple[float, ...]], ...]


@dataclass(frozen=True)
class LoadCycle:
    """From the end of one loading step to the end of a later one, where all loads are the same.

    start  step at whose end the cycle begins, from 1
    end    step at whose end it closes
    """

    start: int
    end: int


def load_cycles(path: Iterable[LoadRamp]) -> tuple[LoadCycle, ...]:
    """The shortest cycle that each step closes, for every step that closes one.

    All controls must be the same, force or displacement alike, with the same values. A step that
    changes nothing holds a load and closes no cycle.
    """
    ramps = list(path)
    scales = _scales(ramps)
    last: dict[State, int] = {}
    cycles = []
    for ramp in ramps:
        state = _state(ramp, scales)
        start = last.get(state)
        if start is not None and start != ramp.step - 1:
            cycles.append(LoadCycle(start, ramp.step))
        last[state] = ramp.step
    return tuple(cycles)


def loop_increments(path: Iterable[LoadRamp]) -> tuple[int, ...]:
    """Increments that each step needs for the work of the cycles it is part of; 1 outside of them
    and where the sideways load rests."""
    ramps = list(path)
    within = {step for c in load_cycles(ramps) for step in range(c.start + 1, c.end + 1)}
    return tuple(_of_loop(ramp) if ramp.step in within else 1 for ramp in ramps)


def _of_loop(ramp: LoadRamp) -> int:
    moving = [c for c in (ramp.tangential, ramp.twisting) if c.start != c.end]
    by_motion = any(control.kind is ControlKind.DISPLACEMENT for control in moving)
    by_motion = by_motion or ramp.strains
    return LED_BY_MOTION if by_motion else LED_BY_FORCE if moving else 1


def _controls(ramp: LoadRamp) -> tuple[ScalarControl | VectorControl, ...]:
    return ramp.normal, ramp.tangential, ramp.twisting, ramp.tilting


def _values(control: ScalarControl | VectorControl) -> tuple[float, ...]:
    return control.end if isinstance(control.end, tuple) else (control.end,)


def _scales(ramps: list[LoadRamp]) -> list[dict[str, float]]:
    """The largest value of every coordinate, by force and by displacement."""
    scales: list[dict[str, float]] = [{} for _ in _controls(ramps[0])] if ramps else []
    for ramp in ramps:
        for scale, control in zip(scales, _controls(ramp), strict=True):
            size = max(map(abs, _values(control)))
            scale[control.kind.value] = max(scale.get(control.kind.value, 0.0), size)
    strains = [abs(value) for ramp in ramps if ramp.stretch for value in ramp.stretch[1]]
    return [*scales, {"strain": max(strains, default=0.0)}]


def _state(ramp: LoadRamp, scales: list[dict[str, float]]) -> State:
    """What two loads have in common that are the same."""
    state = []
    for scale, control in zip(scales, _controls(ramp), strict=False):
        size = scale[control.kind.value] or 1.0
        values = tuple(round(value / size, DIGITS) for value in _values(control))
        state.append((control.kind.value, values))
    strain = ramp.stretch[1] if ramp.stretch else ()
    largest = scales[-1]["strain"] or 1.0
    return *state, ("strain", tuple(round(value / largest, DIGITS) for value in strain))
