"""Tests of the energy balance: input work is stored or dissipated in every increment."""

import contact_scenes
import coupled_scenes
import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    LOAD,
    PRESS,
    grid,
    paraboloid,
    push,
    slide,
)
from coupled_scenes import bulk, coated
from hypothesis import given, settings
from hypothesis import strategies as st

from contact_scene import (
    RIGID,
    Body,
)
from semi_analytical import NotConverged, history, solve
from semi_analytical.increments.energy import Energy
from semi_analytical.increments.increment import solve_increment

TOLERANCE = 1e-8
# Balance of the first law asked for; the equations are solved to the tolerance above.
CLOSES = 1e-6
GRID = grid(20, 1.6)
PARTS = st.integers(1, 20).map(lambda n: n / 20)
SHIFTS = st.integers(-40, 40).map(lambda n: n / 10)
TURNS = st.integers(-10, 10).map(lambda n: n * 1e-4)
STEPS = st.one_of(
    st.builds(lambda w: {"normal_force": w * LOAD}, PARTS),
    st.builds(lambda d: {"approach": d * APPROACH}, PARTS),
    st.builds(slide, SHIFTS, SHIFTS),
    st.builds(lambda w, s: {"normal_force": w * LOAD, **slide(s)}, PARTS, SHIFTS),
    st.builds(lambda turn: {"twist": turn}, TURNS),
    st.builds(lambda x, y: {"tilt": (x, y)}, TURNS, TURNS),
)
HISTORIES = st.lists(
    st.builds(lambda step, n: {**step, "increments": n}, STEPS, st.integers(1, 2)),
    min_size=1,
    max_size=3,
).map(lambda steps: [{**PRESS, "increments": 1}, *steps])
BODIES = {
    "alike": lambda loading: contact_scenes.scene(*loading),
    "coated": lambda loading: coupled_scenes.scene(*loading, body=coated()),
    "nu = 0": lambda loading: coupled_scenes.scene(*loading, body=bulk(0.0)),
    "indenter coupled, friction strong": lambda loading: coupled_scenes.scene(
        *loading, body=Body(material=RIGID), indenter=paraboloid(), friction=0.6
    ),
}


def assert_first_law(increments, cell_area):
    for increment in increments:
        assert increment.energy_imbalance <= CLOSES
        assert increment.elastic_energy > 0
        if increment.shear is None:
            continue
        assert np.all(increment.dissipation_increment >= 0)
        assert np.all(increment.slip_distance >= np.hypot(*increment.slip) * (1 - 1e-12))
        lost = float(np.sum(increment.dissipation)) * cell_area
        assert lost == pytest.approx(increment.dissipated_energy, rel=1e-11, abs=1e-25)


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
@settings(max_examples=5)
@given(history=HISTORIES)
def test_work_is_stored_or_dissipated_over_any_history(body, history):
    result = solve(body(history), GRID, TOLERANCE)
    assert_first_law(result.increments, GRID.cell_area)


def unresolved(*loading, **more):
    described = contact_scenes.scene(*loading, **more)
    steps = solve(described, grid(32), 1e-9).steps
    return np.diff([0.0, *(step.unresolved_work for step in steps)])


REFINED = {
    "pressing": lambda n: unresolved({**PRESS, "increments": n}, friction=None)[0],
    "unloading": lambda n: unresolved(
        PRESS, {"normal_force": 0.3 * LOAD, "increments": n}, friction=None
    )[1],
    "pushing": lambda n: unresolved(PRESS, push(0.9, increments=n))[1],
    "reversal": lambda n: unresolved(PRESS, push(0.9), push(-0.9, increments=2 * n))[2],
}


@pytest.mark.parametrize("work", REFINED.values(), ids=REFINED)
def test_what_increments_leave_open_vanishes_with_their_square(work):
    coarse, fine = work(4), work(12)
    order = np.log(coarse / fine) / np.log(3)
    assert order == pytest.approx(2.0, abs=0.2)


def test_what_is_missing_is_relative_to_the_largest_energy():
    now = Energy(elastic=1.0, input_work=2.5, dissipated=0.5, unresolved=0.25, largest=3.0)
    assert now.imbalance(Energy()) == pytest.approx(0.25)
    assert now.imbalance(now) == 0


def test_an_increment_in_two_halves_adds_up_both(monkeypatch):
    """The halves are not reported, their work and their dissipation are."""
    loading = (PRESS, push(0.6, increments=1))
    halves = (PRESS, push(0.6, increments=2))
    expected = solve(contact_scenes.scene(*halves), GRID, TOLERANCE).increments[-1]
    refused = []

    def solve_or_refuse(model, before, normal, tangential, tolerance):
        if before is not None and not refused:
            refused.append(True)
            raise NotConverged("the shear", 1, 1.0, tolerance)
        return solve_increment(model, before, normal, tangential, tolerance)

    monkeypatch.setattr(history, "solve_increment", solve_or_refuse)
    end = solve(contact_scenes.scene(*loading), GRID, TOLERANCE).increments[-1]
    assert end.halvings == 1
    assert end.energy_imbalance <= CLOSES
    for name in ("elastic_energy", "input_work", "dissipated_energy", "unresolved_work"):
        assert getattr(end, name) == pytest.approx(getattr(expected, name), rel=1e-9)
    np.testing.assert_allclose(end.dissipation, expected.dissipation, atol=1e-9)
    np.testing.assert_array_equal(end.dissipation_increment, end.dissipation)


@pytest.mark.parametrize("then", [{}, {"normal_force": 0.4 * LOAD}], ids=["loaded", "unloaded"])
def test_what_finite_increments_leave_uncertain_covers_what_they_miss(then):
    def end(count):
        steps = coupled_scenes.press(increments=count), {**then, "increments": count}
        described = coupled_scenes.scene(*steps[: 1 + bool(then)], body=bulk(), friction=0.3)
        return solve(described, grid(24), 1e-7).increments[-1]

    few, many = end(6), end(20)
    missed = abs(few.dissipated_energy - many.dissipated_energy)
    assert 0.05 * few.dissipation_uncertainty < missed < few.dissipation_uncertainty
    assert many.dissipation_uncertainty < 0.3 * few.dissipation_uncertainty
