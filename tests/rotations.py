"""Loads that tilt and twist the indenters of `contact_scenes`."""

import numpy as np
from contact_scenes import INDENTERS, LIMIT, LOAD, RADIUS, A, grid, scene

from semi_analytical import solve

TOLERANCE = 1e-9
GRID = grid(32, 2.0)
SLIDING = 3 * np.pi / 16 * LIMIT * A  # the torque at which a Hertz contact slips all over
PUNCH = INDENTERS["flat punch"]


def end(*loading, on=GRID, **more):
    """The state after all loading steps."""
    return solve(scene(*loading, **more), on, TOLERANCE).steps[-1]


def lean(x, y=0.0):
    """The moment of the full load acting at parts of the contact radius from the origin."""
    return {"moment": (y * A * LOAD, x * A * LOAD)}


def roll(x, y=0.0):
    """The tilt by which a ball rolls so far."""
    return {"tilt": (y * A / RADIUS, x * A / RADIUS)}


def twist(part, **more):
    """A torque in parts of that at which all slips."""
    return {"torque": part * SLIDING, **more}


def close(one, other, size):
    """Equal to a size."""
    np.testing.assert_allclose(one, other, rtol=0, atol=size)
