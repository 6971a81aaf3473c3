"""What the indenter is led to along a loading step: targets at a fraction of its ramp."""

from typing import TypeVar

import numpy as np

from contact_scene import ControlKind, LoadRamp
from contact_scene.load_path import Control
from contact_scene.solver_errors import GrossSliding
from semi_analytical.increment import State
from semi_analytical.pressing import NormalTarget, Pair, Tilting
from semi_analytical.shearing import TangentialTarget, Torsion

Value = TypeVar("Value", float, Pair)


def normal_target(
    ramp: LoadRamp, start: State | None, fraction: float, tilts: bool
) -> NormalTarget:
    """Normal force or approach, and the tilt where the plan says so.

    start  the state at the start of the step; None before first touch
    """
    reached = (0.0, 0.0) if start is None else (start.normal_force, start.pressing.approach)
    force, approach = _led(ramp.normal, reached, fraction)
    return NormalTarget(force, approach, _tilting(ramp, start, fraction) if tilts else None)


def tangential_target(
    ramp: LoadRamp, start: State | None, fraction: float, twists: bool
) -> TangentialTarget:
    """Tangential force or shift, and the torsion where the plan says so."""
    sheared = start.sheared if start is not None else None
    reached: tuple[Pair, Pair] = ((0.0, 0.0), (0.0, 0.0))
    if sheared is not None and ramp.tangential.start is None:
        # Taking over from the other control: ramp from where that one has led.
        if sheared.shift is None:
            raise GrossSliding(
                "the step before reached the friction limit under force control, where the shift "
                "is undefined; end that step below the limit"
            )
        reached = _pair(sheared.force), _pair(sheared.shift)
    force, shift = _led(ramp.tangential, reached, fraction)
    return TangentialTarget(
        None if force is None else np.array(force),
        None if shift is None else np.array(shift),
        _torsion(ramp, start, fraction) if twists else None,
    )


def _tilting(ramp: LoadRamp, start: State | None, fraction: float) -> Tilting:
    reached: tuple[Pair, Pair] = ((0.0, 0.0), (0.0, 0.0))
    if start is not None:
        reached = start.moment or reached[0], start.pressing.tilt or reached[1]
    return Tilting(*_led(ramp.tilting, reached, fraction))


def _torsion(ramp: LoadRamp, start: State | None, fraction: float) -> Torsion:
    sheared = start.sheared if start is not None else None
    reached = (0.0, 0.0)
    if sheared is not None:
        reached = sheared.torque or 0.0, sheared.twist or 0.0
    return Torsion(*_led(ramp.twisting, reached, fraction))


def _led(
    control: Control[Value], reached: tuple[Value, Value], fraction: float
) -> tuple[Value | None, Value | None]:
    """Force and displacement at a fraction of the ramp, of which one is given.

    reached  force and displacement at the start of the step: where it takes over
    """
    by_force = control.kind is ControlKind.FORCE
    begin = control.start
    if begin is None:
        begin = reached[0] if by_force else reached[1]
    value = _between(begin, control.end, fraction)
    return (value, None) if by_force else (None, value)


def _between(begin: Value, end: Value, fraction: float) -> Value:
    match begin, end:
        case (float(), float()):
            return _ramp(begin, end, fraction)
        case _:
            return _ramp(begin[0], end[0], fraction), _ramp(begin[1], end[1], fraction)


def _ramp(begin: float, end: float, fraction: float) -> float:
    """Exactly `end` at the end and wherever nothing changes, so that equal loads are equal."""
    return end if fraction == 1 or begin == end else begin + (end - begin) * fraction


def _pair(vector: np.ndarray) -> Pair:
    x, y = map(float, vector)
    return x, y
