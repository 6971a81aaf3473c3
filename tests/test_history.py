"""The load history: what is held, what is taken over, and where increments end."""

import numpy as np
import pytest
from contact_scenes import APPROACH, INDENTERS, LIMIT, LOAD, PRESS, A, grid, push, scene, slide

from semi_analytical import solve

TOLERANCE = 1e-9


def increments(*loading, **more):
    return solve(scene(*loading, **more), grid(), TOLERANCE).increments


def test_steps_and_increments_are_counted_from_one():
    found = [
        (i.step, i.index, i.increments_in_step)
        for i in increments(PRESS, push(0.4, increments=2), push(0.1))
    ]
    assert found == [(1, 1, 1), (2, 1, 2), (2, 2, 2), (3, 1, 1)]


def test_progress_sees_every_increment_in_order():
    seen = []
    result = solve(scene(PRESS, push(0.4, increments=3)), grid(), TOLERANCE, seen.append)
    assert tuple(seen) == result.increments


@pytest.mark.parametrize(
    ("shape", "exponent"),
    [("paraboloid", 3), ("sphere", 3), ("ellipsoid", 3), ("cone", 2), ("flat punch", 1)],
)
def test_first_loading_is_uniform_in_contact_radius(shape, exponent):
    pressing = {"normal_force": 0.3 * LOAD, "increments": 4}
    found = [i.normal_force for i in increments(pressing, indenter=INDENTERS[shape], friction=None)]
    expected = 0.3 * LOAD * (np.arange(1, 5) / 4) ** exponent
    np.testing.assert_allclose(found, expected, rtol=1e-14)


def test_later_steps_are_uniform_in_load():
    found = increments(PRESS, {"normal_force": 400.0, "increments": 3}, friction=None)
    np.testing.assert_allclose([i.normal_force for i in found], [1000, 800, 600, 400])
    found = increments(PRESS, push(0.4, 0.2, increments=2))
    np.testing.assert_allclose(
        [i.tangential_force for i in found[1:]], [(0.2 * LIMIT, 0.1 * LIMIT), (0.4 * LIMIT, 20)]
    )


def test_what_a_step_does_not_name_is_held():
    ends = increments(PRESS, push(0.3), {"normal_force": 0.8 * LOAD, "increments": 2}, slide(0.5))
    np.testing.assert_allclose(ends[3].tangential_force, (0.3 * LIMIT, 0))
    assert ends[-1].normal_force == 0.8 * LOAD


def test_an_approach_is_held_as_an_approach():
    ends = increments({"approach": APPROACH}, push(0.3))
    assert ends[1].approach == ends[0].approach == APPROACH
    assert ends[1].residuals.normal_equilibrium is None


@pytest.mark.parametrize(
    ("loading", "name"),
    [
        (({"approach": APPROACH}, {"normal_force": 0.5 * LOAD, "increments": 2}), "normal_force"),
        ((PRESS, push(0.5), slide(0.2, increments=2)), "tangential_shift"),
        ((PRESS, slide(0.5), push(-0.2, increments=2)), "tangential_force"),
    ],
)
def test_a_control_takes_over_from_where_another_has_led(loading, name):
    *_, start, middle, end = (getattr(i, name) for i in increments(*loading))
    scale = np.max(np.abs(start))
    np.testing.assert_allclose(middle, 0.5 * np.add(start, end), atol=1e-9 * scale)


def test_force_and_shift_control_reach_the_same_states():
    forced = increments(PRESS, push(0.7), push(-0.5))
    shifts = [{"tangential_shift": tuple(i.tangential_shift)} for i in forced[1:]]
    moved = increments(PRESS, *shifts)
    assert len(moved) == 3
    for one, other in zip(forced, moved, strict=True):
        np.testing.assert_allclose(other.tangential_force, one.tangential_force, atol=1e-6 * LIMIT)
        assert other.dissipated_energy == pytest.approx(one.dissipated_energy, rel=1e-6)


def test_load_and_approach_control_reach_the_same_states():
    forced = increments(PRESS, {"normal_force": 0.3 * LOAD}, friction=None)
    moved = increments(*({"approach": i.approach} for i in forced), friction=None)
    assert len(moved) == 2
    for one, other in zip(forced, moved, strict=True):
        assert other.normal_force == pytest.approx(one.normal_force, rel=1e-7)


def test_contact_that_is_left_and_found_again_has_no_shear_left_over():
    """Cells outside the contact carry nothing; coming back they remember where they met."""
    ends = increments(
        {**PRESS, **push(0.5, increments=3)},
        {"normal_force": 0.1 * LOAD, **push(0, increments=3)},
        {**PRESS, "increments": 3},
    )
    for increment in ends:
        assert np.all(increment.shear[:, ~increment.in_contact] == 0)
    assert np.abs(np.sum(ends[-1].shear)) * 9 * A**2 / 32**2 < 1e-9 * LIMIT
