"""Tests of tilt and twist: missed loads and a punch that tips over are refused."""

import numpy as np
import pytest
from contact_scenes import (
    INDENTERS,
    LIMIT,
    LOAD,
    PRESS,
    A,
    grid,
    scene,
)

from contact_scene.solver_errors import NotConverged
from semi_analytical import (
    ContactNotResolved,
    solve,
)
from semi_analytical.increments import stick_slip

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


def twist(part, **more):
    """A torque in parts of that at which all slips."""
    return {"torque": part * SLIDING, **more}


@pytest.mark.parametrize("part", [0.99, 1.01])
def test_a_torque_that_is_missed_on_either_side_is_not_accepted(part, monkeypatch):
    reported = stick_slip.torque_of
    monkeypatch.setattr(stick_slip, "torque_of", lambda *given: part * reported(*given))
    with pytest.raises(NotConverged):
        end(PRESS, twist(0.3))


def test_a_force_on_the_rim_of_a_punch_tips_it_over():
    with pytest.raises(ContactNotResolved, match="tips over"):
        end({**PRESS, **lean(0.999)}, friction=None, indenter=PUNCH, on=grid(32, 1.1))
