"""One increment costs what its physics costs: effects that are off are never computed."""

import numpy as np
import pytest
from contact_scenes import LOAD, PRESS, RIGID_BALL, A, grid, push, scene

from semi_analytical import SurfaceGrid, solve
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


def test_shear_costs_nothing_until_the_first_push(calls):
    seen = []
    solve(scene(PRESS, push(0.5)), grid(), TOLERANCE, lambda _: seen.append(set(calls)))
    assert seen[0] == {"normal"}


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


def test_fields_are_reported_on_the_whole_window():
    increment = solve(scene(PRESS, push(0.5)), SurfaceGrid((48, 40), (4 * A, 3 * A)), TOLERANCE)
    end = increment.steps[-1]
    assert end.pressure.shape == end.gap.shape == end.in_contact.shape == (48, 40)
    assert end.shear.shape == end.slip.shape == (2, 48, 40)
    assert np.all(end.gap[~end.in_contact] > -1e-8 * end.approach)
