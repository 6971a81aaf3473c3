"""Torsion: closed forms, reversal, reciprocity, and the limit of friction."""

import numpy as np
import pytest
from contact_scenes import (
    MU,
    PRESS,
    RIGID_BALL,
    push,
)
from rotations import GRID, SLIDING, end, lean, twist

from contact_scene.summary import ContactStatus
from semi_analytical import (
    GrossSliding,
)


def test_reciprocity_of_force_and_torque():
    """A contact beside the origin that sticks: what a force turns, a torque shifts."""
    beside = {**PRESS, **lean(0.0, 0.4), "torque": 0.0}
    pushed = end(beside, push(0.1), friction=50.0)
    turned = end(beside, twist(0.1), friction=50.0)
    by_force = pushed.twist / pushed.tangential_force[0]
    by_torque = turned.tangential_shift[0] / turned.torque
    assert abs(by_force) > 0
    assert by_force == pytest.approx(by_torque, rel=1e-6)


def test_torque_beyond_friction_is_refused_with_its_limit():
    with pytest.raises(GrossSliding, match="prescribe twist") as caught:
        end(PRESS, twist(1.3))
    limit = float(str(caught.value).split("friction limit ")[1].split(" N m")[0])
    assert limit == pytest.approx(SLIDING, rel=2e-2)
    assert caught.value.where == "step 2, increment 1 of 1"


def test_force_and_torque_that_friction_carries_alone_may_be_too_much_together():
    end(PRESS, push(0.8))
    end(PRESS, twist(0.8))
    with pytest.raises(GrossSliding, match=r"together reach the friction limit, which is 0\.\d+"):
        end(PRESS, {**push(0.8), **twist(0.8), "increments": 1})


@pytest.mark.parametrize("bodies", [{}, {"indenter": RIGID_BALL}], ids=["alike", "unlike"])
def test_a_twist_without_end_slides_at_the_limit(bodies):
    state = end({**PRESS, "increments": 1}, {"twist": 0.5, "increments": 1}, **bodies)
    x, y = GRID.coordinates()
    limit = MU * np.sum(state.pressure * np.hypot(x, y)) * GRID.cell_area
    assert state.torque == pytest.approx(limit, rel=1e-3)
    assert state.status in (ContactStatus.GROSS_SLIDING, ContactStatus.NO_STICK_AREA_LEFT)
    assert state.stick_area == 0


def test_without_friction_coefficient_no_torque_is_carried():
    with pytest.raises(GrossSliding, match="without friction"):
        end(PRESS, twist(0.1), friction=0.0)
    turned = end(PRESS, {"twist": 0.1}, friction=0.0)
    assert turned.torque == 0
    assert turned.twist == 0.1
