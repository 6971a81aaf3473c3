"""Tests of load histories on cells: from the limit, turns of a slide, and errors."""

import numpy as np
import pytest
from contact_scenes import (
    MU,
    PRESS,
    A,
    grid,
    push,
    scene,
    slide,
)

from contact_scene.quantities.summary import ContactStatus
from semi_analytical import GrossSliding, NotConverged, solve
from semi_analytical.increments import stick_slip

TOLERANCE = 1e-8
CELLS = 32
SPACING = 3 * A / CELLS


def solved(*loading, cells=CELLS, **more):
    return solve(scene(*loading, **more), grid(cells), TOLERANCE)


# A map that varies, if only in its last digits: what it carries is known once it is solved.
NEARLY_ONE = 1 + 1e-12 * np.add.outer(np.arange(CELLS), np.arange(CELLS))


def test_a_history_cannot_go_on_from_the_limit():
    friction = {"map": MU * NEARLY_ONE, "spacing": SPACING}
    pressed = solve(scene(PRESS, push(0.5), friction=friction), grid(CELLS), TOLERANCE).steps[0]
    limit = MU * float(np.sum(pressed.pressure * NEARLY_ONE)) * grid(CELLS).cell_area
    with pytest.raises(GrossSliding, match="shift or twist is undefined"):
        solved(PRESS, {"tangential_force": (limit, 0.0)}, push(0.5), friction=friction)


def test_a_slide_that_turns_slides_again_once_shear_has_turned_too():
    """Meanwhile nothing sticks, and friction does less than it could along the new way."""
    turns = slide(100.5, 0.5), slide(100.5, 100)
    steps = solved(PRESS, slide(100), *turns).steps
    assert [step.status for step in steps[1:]] == [
        ContactStatus.GROSS_SLIDING,
        ContactStatus.NO_STICK_AREA_LEFT,
        ContactStatus.GROSS_SLIDING,
    ]


def test_not_converged_says_where_and_carries_the_last_good_state(monkeypatch):
    def fail(*_, **__):
        raise NotConverged("the shear", 7, 1e-3, TOLERANCE)

    seen = []
    monkeypatch.setattr(stick_slip, "shear", fail)
    with pytest.raises(NotConverged, match=r"step 2, increment 1 of 2.*1\.00e-03.*7") as caught:
        solve(scene(PRESS, push(0.5, increments=2)), grid(), TOLERANCE, seen.append)
    error = caught.value
    assert (error.iterations, error.residual, error.tolerance) == (7, 1e-3, TOLERANCE)
    np.testing.assert_array_equal(error.last_state.pressure, seen[-1].pressure)
