"""Tests of stick and slip: the friction law holds in easy and hard load histories."""

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    INDENTERS,
    LIMIT,
    LOAD,
    MU,
    PRESS,
    RADIUS,
    A,
    bump,
    grid,
    push,
    scene,
    slide,
    steel,
)

from contact_scene import HeightMap
from contact_scene.quantities.summary import ContactStatus
from semi_analytical import GrossSliding, solve

TOLERANCE = 1e-8
CELLS = 32
SPACING = 3 * A / CELLS


def solved(*loading, cells=CELLS, **more):
    return solve(scene(*loading, **more), grid(cells), TOLERANCE)


def height_map(heights):
    return HeightMap(file=heights, spacing=SPACING, material=steel())


def rough():
    noise = np.random.default_rng(3).standard_normal((CELLS, CELLS))
    return height_map(bump(CELLS, SPACING) + 0.02 * APPROACH * noise)


def two_bumps():
    x = (np.arange(CELLS) - 0.5 * (CELLS - 1)) * SPACING
    one, other = ((x[:, None] - c) ** 2 + x**2 for c in (-0.7 * A, 0.7 * A))
    return height_map(np.minimum(one, other) / (2 * RADIUS))


def mapped(values):
    return {"map": values, "spacing": SPACING}


def mapped_friction():
    values = np.random.default_rng(4).uniform(0, 2 * MU, (CELLS, CELLS))
    values[values < 0.3 * MU] = 0
    return mapped(values)


ANGLES = np.linspace(0, 2 * np.pi, 5)
CIRCLE = [push(0.8 * np.cos(t), 0.8 * np.sin(t), increments=3) for t in ANGLES]
HISTORIES = {
    **{f"T = {x} of the limit": ((PRESS, push(x)), {}) for x in (0.99, 0.99999)},
    "tiny T": ((PRESS, push(1e-9), push(-1e-9)), {}),
    "contact of four cells": (({"normal_force": 1e-4 * LOAD}, push(0.9e-4)), {}),
    "ellipsoid across": (
        ({"normal_force": 0.3 * LOAD}, push(0.15, 0.15)),
        {"indenter": INDENTERS["ellipsoid"]},
    ),
    "T on a circle": ((PRESS, *CIRCLE), {}),
    "rough surface": ((PRESS, push(0.7), push(-0.3, 0.5, increments=4)), {"indenter": rough()}),
    "two contacts": (
        ({"normal_force": 0.1 * LOAD}, push(0.07), push(-0.07)),
        {"indenter": two_bumps()},
    ),
    "much friction": ((PRESS, push(45), push(-45)), {"friction": 5.0}),
    "mapped friction": ((PRESS, push(0.6), push(-0.6)), {"friction": mapped_friction()}),
    "W and T reversed together": (
        (PRESS, push(0.8), {"normal_force": 0.85 * LOAD, **push(-0.8, increments=6)}),
        {},
    ),
    "unloading and reloading": (
        (
            {**PRESS, **push(0.5, increments=4)},
            {"normal_force": 0.01 * LOAD, **push(0, increments=4)},
            {**PRESS, **push(0.5, increments=4)},
        ),
        {},
    ),
    "torque that turns": (
        (PRESS, {"torque": 0.3 * MU * LOAD * A}, {"torque": -0.2 * MU * LOAD * A}),
        {},
    ),
    "shift far beyond sliding and back": ((PRESS, slide(1e3), slide(0), slide(-1e3)), {}),
    "controls in turn": (
        ({"approach": APPROACH}, slide(0.5), push(0.3), {"normal_force": LOAD}, slide(-0.5)),
        {},
    ),
}


@pytest.mark.parametrize(("loading", "more"), HISTORIES.values(), ids=HISTORIES)
def test_every_increment_obeys_all_equations(loading, more):
    energy = 0.0
    for increment in solved(*loading, **more).increments:
        sizes = [size for size in vars(increment.residuals).values() if size is not None]
        assert -1e-15 < min(sizes) <= increment.residuals.worst <= TOLERANCE
        assert np.all(np.isfinite(increment.pressure))
        assert np.all(np.isfinite(increment.shear))
        assert increment.dissipated_energy >= energy
        assert increment.stick_area <= increment.contact_area
        assert increment.energy_imbalance < 1e-6
        energy = increment.dissipated_energy


# A map that varies, if only in its last digits: what it carries is known once it is solved.
NEARLY_ONE = 1 + 1e-12 * np.add.outer(np.arange(CELLS), np.arange(CELLS))


def test_unloading_through_the_limit_is_refused_where_it_happens():
    with pytest.raises(GrossSliding, match="step 3, increment") as caught:
        solved({"approach": APPROACH}, push(0.9), {"approach": 0.5 * APPROACH, "increments": 4})
    assert caught.value.last_state is not None


def test_a_history_cannot_go_on_from_the_limit():
    friction = mapped(MU * NEARLY_ONE)
    pressed = solve(scene(PRESS, push(0.5), friction=friction), grid(CELLS), TOLERANCE).steps[0]
    limit = MU * float(np.sum(pressed.pressure * NEARLY_ONE)) * grid(CELLS).cell_area
    with pytest.raises(GrossSliding, match="shift or twist is undefined"):
        solved(PRESS, {"tangential_force": (limit, 0.0)}, push(0.5), friction=friction)


def test_a_slide_that_turns_slides_again_once_shear_has_turned_too() -> None:
    """Meanwhile nothing sticks, and friction does less than it could along the new way."""
    turns = slide(100.5, 0.5), slide(100.5, 100)
    steps = solved(PRESS, slide(100), *turns).steps
    assert [step.status for step in steps[1:]] == [
        ContactStatus.GROSS_SLIDING,
        ContactStatus.NO_STICK_AREA_LEFT,
        ContactStatus.GROSS_SLIDING,
    ]


FINE = 1e-9


def increments(*loading, **more):
    return solve(scene(*loading, **more), grid(), FINE).increments


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
