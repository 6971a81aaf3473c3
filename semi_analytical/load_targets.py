"""What the indenter is led to along a loading step: targets at a fraction of its ramp."""

import numpy as np

from contact_scene import LoadRamp
from semi_analytical.increment import State
from semi_analytical.pressing import NormalTarget, Pair, Tilting
from semi_analytical.shearing import TangentialTarget, Torsion


def normal_target(
    ramp: LoadRamp, start: State | None, fraction: float, tilts: bool
) -> NormalTarget:
    """Normal force or approach, and the tilt where the plan says so.

    start  the state at the start of the step; None before first touch
    """
    reached = (0.0, 0.0) if start is None else (start.normal_force, start.pressing.approach)
    force, approach = ramp.normal.led(fraction, reached)
    return NormalTarget(force, approach, _tilting(ramp, start, fraction) if tilts else None)


def tangential_target(
    ramp: LoadRamp, start: State | None, fraction: float, twists: bool
) -> TangentialTarget:
    """Tangential force or shift, and the torsion where the plan says so."""
    sheared = start.sheared if start is not None else None
    reached: tuple[Pair, Pair | None] = ((0.0, 0.0), (0.0, 0.0))
    if sheared is not None:
        reached = _pair(sheared.force), None if sheared.shift is None else _pair(sheared.shift)
    force, shift = ramp.tangential.led(fraction, reached)
    return TangentialTarget(
        None if force is None else np.array(force),
        None if shift is None else np.array(shift),
        _torsion(ramp, start, fraction) if twists else None,
    )


def _tilting(ramp: LoadRamp, start: State | None, fraction: float) -> Tilting:
    reached: tuple[Pair, Pair] = ((0.0, 0.0), (0.0, 0.0))
    if start is not None:
        reached = start.moment or reached[0], start.pressing.tilt or reached[1]
    return Tilting(*ramp.tilting.led(fraction, reached))


def _torsion(ramp: LoadRamp, start: State | None, fraction: float) -> Torsion:
    sheared = start.sheared if start is not None else None
    reached = (0.0, 0.0)
    if sheared is not None:
        reached = sheared.torque or 0.0, sheared.twist or 0.0
    return Torsion(*ramp.twisting.led(fraction, reached))


def _pair(vector: np.ndarray) -> Pair:
    x, y = map(float, vector)
    return x, y
