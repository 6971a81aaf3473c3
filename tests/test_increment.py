"""Tests of single increments: effects that are off cost nothing, and the path so far."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import (
    LOAD,
    PRESS,
    RIGID_BALL,
    grid,
    push,
    scene,
)

from semi_analytical import SurfaceGrid, plan, solve
from semi_analytical.increments.increment_history import (
    PreviousIncrement,
    further,
    further_fields,
    further_motion,
)
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.operator.operator import DisplacementOperator

TOLERANCE = 1e-8
PRODUCTS = "normal", "tangential", "normal_by_shear", "tangential_by_pressure", "together"


@pytest.fixture
def calls(monkeypatch):
    """Names of the products, in the order in which they are called."""
    made = []

    def spy(name):
        plain = getattr(DisplacementOperator, name)

        def counted(self, field):
            made.append(name)
            return plain(self, field)

        monkeypatch.setattr(DisplacementOperator, name, counted)

    for name in PRODUCTS:
        spy(name)
    return made


@pytest.mark.parametrize(
    ("loading", "more"),
    [
        ((PRESS,), {"friction": None}),
        ((PRESS,), {"friction": None, "indenter": RIGID_BALL}),
        ((PRESS, {"normal_force": 0.5 * LOAD}), {}),
        ((PRESS, push(0)), {}),
    ],
    ids=["frictionless", "frictionless and dissimilar", "only pressed", "no push"],
)
def test_without_a_push_shear_costs_nothing(loading, more, calls):
    for increment in solve(scene(*loading, **more), grid(), TOLERANCE).increments:
        assert increment.shear is None
        assert increment.slip is None
        assert increment.in_stick is None
        assert increment.dissipated_energy is None
        assert increment.residuals.slip_direction is None
    assert set(calls) == {"normal"}


def test_pressure_is_not_solved_again_where_the_normal_load_is_held(calls):
    def after(increment):
        if increment.step == 1:
            calls.clear()

    solve(scene(PRESS, push(0.5), push(-0.5)), grid(), TOLERANCE, after)
    assert set(calls) == {"tangential"}


def test_convolutions_count_what_was_convolved(calls):
    result = solve(scene(PRESS, push(0.5)), grid(), TOLERANCE)
    for increment, kind, price in [
        (result.increments[0], "normal", 1),
        (result.increments[1], "tangential", 2),
    ]:
        assert increment.convolutions == price * calls.count(kind)


def test_areas_within_a_load_step_change_nothing_at_its_end():
    described = scene(PRESS, push(0.7, increments=3), push(-0.7, increments=3))
    whole, last = (
        solve(described, grid(), TOLERANCE, plan=replace(plan(described), areas=areas))
        for areas in ("all", "last")
    )
    for one, other in zip(whole.increments, last.increments, strict=True):
        ends = one.index == one.increments_in_step
        assert (one.stick_area == other.stick_area) is ends
        assert other.stick_area <= other.contact_area
        np.testing.assert_array_equal(one.slip, other.slip)


@pytest.mark.parametrize(
    ("cells", "window"),
    [((1, 8), (1.0, 1.0)), ((8, 8), (0.0, 1.0)), ((8, 8), (1.0, np.nan)), ((8, 8), (1.0, np.inf))],
)
def test_impossible_grid_is_refused(cells, window):
    with pytest.raises(ValueError, match=r"use (at least 2|two positive)"):
        SurfaceGrid(cells, window)


NOTHING = np.zeros((2, 1, 1))
FIRST = PreviousIncrement(
    target=NormalTarget(force=1.0),
    pressure=NOTHING[0] + 6,
    shear=NOTHING + 1,
    displacement=NOTHING + 10,
    force=np.array([0.1, 0.2]),
    shift=np.array([1.0, 2.0]),
    torque=1e-3,
    twist=1e-6,
)
SECOND = replace(
    FIRST,
    pressure=NOTHING[0] + 7,
    shear=NOTHING + 3,
    displacement=NOTHING + 50,
    force=np.array([0.3, 0.5]),
    shift=np.array([3.0, 5.0]),
    torque=2e-3,
    twist=3e-6,
)
WAY = np.array([0.2, 0.3])


@pytest.mark.parametrize("part", [0.01, 0.5, 1.0, 2.0])
def test_where_the_load_goes_straight_on_the_shear_goes_as_much_further(part):
    for target in (
        TangentialTarget(force=SECOND.force + part * WAY),
        TangentialTarget(shift=SECOND.shift + 10 * part * WAY),
        TangentialTarget(force=SECOND.force + part * WAY, torque=2e-3 + part * 1e-3),
        TangentialTarget(shift=SECOND.shift + 10 * part * WAY, twist=3e-6 + part * 2e-6),
    ):
        assert further(SECOND, FIRST, target) == pytest.approx(part, rel=1e-12)
        ahead = further_fields(SECOND, FIRST, target)
        motion = further_motion(SECOND, FIRST, target)
        twist = [3e-6 + part * 2e-6] if target.torque else []
        np.testing.assert_allclose(motion, [3 + part * 2, 5 + part * 3, *twist])
        np.testing.assert_allclose(ahead.pressure, 7 + part)
        np.testing.assert_allclose(ahead.shear, 3 + 2 * part)
        np.testing.assert_allclose(ahead.displacement, 50 + 40 * part)


@pytest.mark.parametrize("way", [-WAY, 2.1 * WAY, 0 * WAY, WAY @ [[1, 0.01], [0, 1]]])
def test_where_the_load_turns_rests_or_leaps_the_shear_stays(way):
    target = TangentialTarget(force=SECOND.force + way)
    assert further(SECOND, FIRST, target) == 0
    straight = TangentialTarget(force=SECOND.force + WAY, torque=2e-3 + 2e-3 * way[0] / WAY[0])
    assert further(SECOND, FIRST, straight) == 0
    assert further_fields(SECOND, FIRST, target) is SECOND


def products(described, cells):
    """Of two convolutions each, in every increment but the first, which presses."""
    increments = solve(described, grid(cells), TOLERANCE).increments
    assert all(increment.halvings == 0 for increment in increments)
    return np.array([0.5 * increment.convolutions for increment in increments[1:]])


def test_a_loop_takes_few_products_on_any_cells():
    """Nested grids, the inverse on stick and the diagonal on slip took 41 and 80."""
    loop = scene(PRESS, push(0.9, increments=9), push(-0.9, increments=18))
    few, many = (np.mean(products(loop, cells)) for cells in (32, 128))
    assert few < 17
    assert many < 1.3**2 * few
