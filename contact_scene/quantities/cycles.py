"""Load cycles: sections of a load history between the ends of two load steps with equal loads."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import chain
from typing import Any

from contact_scene.stepping.load_path import (
    ControlKind,
    LoadRamp,
)

# Decimals to which equal loads agree, relative to the largest load of their kind.
DIGITS = 9

# Increments of a step within a cycle for which the work of the cycle, a trapezoidal sum, agrees
# with the dissipated energy to 1 %. A step with a prescribed displacement needs more, since slip
# may start at any point of it. Measured on loops at 0.3 to 0.99 of the friction limit, and with
# shifts up to 15 times that of gross sliding: 0.08 to 0.8 %, and 0.6 %.
INCREMENTS_BY_FORCE = 16
INCREMENTS_BY_DISPLACEMENT = 32

Kind = tuple[int, str]
State = tuple[tuple[Kind, tuple[float, ...]], ...]


@dataclass(frozen=True)
class LoadCycle:
    """Load cycle: section of a load history between the ends of two load steps with equal loads.

    start  number of the load step at whose end the cycle begins, from 1
    end    number of the load step at whose end the cycle closes
    """

    start: int
    end: int


def load_cycles(path: Iterable[LoadRamp]) -> tuple[LoadCycle, ...]:
    """Find the load cycles of a load history: for each load step, the shortest cycle it closes.

    A cycle is closed if the kinds and the values of all controls (prescribed forces and
    displacements) equal those at the end of an earlier load step. A load step of constant load
    closes none.

    path  load ramps of all load steps
    """
    ramps = list(path)
    scales = _load_scales(ramps)
    last: dict[State, int] = {}
    cycles = []
    for ramp in ramps:
        state = _rounded_loads(ramp, scales)
        start = last.get(state)
        if start is not None and start != ramp.step - 1:
            cycles.append(LoadCycle(start, ramp.step))
        last[state] = ramp.step
    return tuple(cycles)


def loop_increments(path: Iterable[LoadRamp]) -> tuple[int, ...]:
    """Return the number of increments of each load step that its load cycle needs.

    A load cycle is a section of the history that returns to equal loads. The work of a cycle is a
    trapezoidal sum over the increments, which needs this number to be accurate. The number is 1
    outside of cycles and in load steps with constant tangential load, torsion and bulk strain.

    path  load ramps of all load steps
    """
    ramps = list(path)
    within = {step for c in load_cycles(ramps) for step in range(c.start + 1, c.end + 1)}
    return tuple(_increments_of_ramp(ramp) if ramp.step in within else 1 for ramp in ramps)


def _increments_of_ramp(ramp: LoadRamp) -> int:
    moving = [c for c in (ramp.tangential, ramp.twisting) if c.start != c.end]
    by_motion = any(control.kind is ControlKind.DISPLACEMENT for control in moving)
    by_motion = by_motion or ramp.strains
    return INCREMENTS_BY_DISPLACEMENT if by_motion else INCREMENTS_BY_FORCE if moving else 1


def _end_loads(ramp: LoadRamp) -> Iterator[tuple[Kind, tuple[float, ...]]]:
    """Yield the loads at the end of a step by coordinate and kind (force or displacement),
    each with one or two values; the bulk strain is one load of three values or none."""
    controls: tuple[Any, ...] = (ramp.normal, ramp.tangential, ramp.twisting, ramp.tilting)
    for coordinate, control in enumerate(controls):
        end = control.end if isinstance(control.end, tuple) else (control.end,)
        yield (coordinate, control.kind.value), end
    yield (len(controls), "strain"), ramp.stretch[1] if ramp.stretch else ()


def _load_scales(ramps: list[LoadRamp]) -> dict[Kind, float]:
    """Compute the largest magnitude of each force and displacement over the load path,
    as the scale of a tolerance."""
    scales: dict[Kind, float] = {}
    for kind, values in chain.from_iterable(map(_end_loads, ramps)):
        scales[kind] = max(scales.get(kind, 0.0), *map(abs, values), 0.0)
    return scales


def _rounded_loads(ramp: LoadRamp, scales: Mapping[Kind, float]) -> State:
    """Return the loads at the end of a step relative to their scales,
    rounded to `DIGITS` decimals, so that equal loads compare equal."""
    return tuple(
        (kind, tuple(round(value / (scales[kind] or 1.0), DIGITS) for value in values))
        for kind, values in _end_loads(ramp)
    )
