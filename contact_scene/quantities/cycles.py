"""Load cycles: parts of a load history between steps that end with equal loads."""

from collections.abc import Iterable
from dataclasses import dataclass

from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
    ScalarControl,
    VectorControl,
)

# Decimals of loads, relative to the largest of their kind, that equal loads have in common.
DIGITS = 9

# Increments of a step within a cycle for which the work of the cycle, a trapezoidal sum, agrees
# with the dissipated energy to 1 %. A step with a prescribed displacement needs more, since slip
# may start at any point of it. Measured on loops at 0.3 to 0.99 of the friction limit, and with
# shifts up to 15 times that of gross sliding: 0.08 to 0.8 %, and 0.6 %.
LED_BY_FORCE = 16
LED_BY_MOTION = 32

State = tuple[tuple[str, tuple[float, ...]], ...]


@dataclass(frozen=True)
class LoadCycle:
    """Load cycle between the ends of two load steps with equal loads.

    start  number of the step at whose end the cycle begins, from 1
    end    number of the step at whose end the cycle closes
    """

    start: int
    end: int


def load_cycles(path: Iterable[LoadRamp]) -> tuple[LoadCycle, ...]:
    """Find the shortest cycle of every step that closes one.

    The kinds and the values of all controls must be equal. A step of constant load closes none.
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
    """Return the number of increments of each step for the work of its cycles.

    The number is 1 outside of cycles and in steps with constant tangential load.
    """
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
    """Compute the largest value of every coordinate, separately of forces and displacements."""
    scales: list[dict[str, float]] = [{} for _ in _controls(ramps[0])] if ramps else []
    for ramp in ramps:
        for scale, control in zip(scales, _controls(ramp), strict=True):
            size = max(map(abs, _values(control)))
            scale[control.kind.value] = max(scale.get(control.kind.value, 0.0), size)
    strains = [abs(value) for ramp in ramps if ramp.stretch for value in ramp.stretch[1]]
    return [*scales, {"strain": max(strains, default=0.0)}]


def _state(ramp: LoadRamp, scales: list[dict[str, float]]) -> State:
    """Return the kinds and rounded relative values of all controls at the end of a ramp."""
    state = []
    for scale, control in zip(scales, _controls(ramp), strict=False):
        size = scale[control.kind.value] or 1.0
        values = tuple(round(value / size, DIGITS) for value in _values(control))
        state.append((control.kind.value, values))
    strain = ramp.stretch[1] if ramp.stretch else ()
    largest = scales[-1]["strain"] or 1.0
    return *state, ("strain", tuple(round(value / largest, DIGITS) for value in strain))
