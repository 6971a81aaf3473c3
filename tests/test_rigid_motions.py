"""Tilt and twist: laws of the solver that hold whatever the loads of the rotations are."""

import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    LOAD,
    MU,
    PRESS,
    RADIUS,
    RIGID_BALL,
    A,
    paraboloid,
    push,
    scene,
)
from rotations import GRID, PUNCH, TOLERANCE, close, end, lean, roll, twist

from contact_scene import Ellipsoid
from semi_analytical import (
    plan,
)


def test_reported_moments_are_those_of_the_tractions():
    state = end({**PRESS, **lean(0.3, 0.2)}, {**push(0.3), **twist(0.2), "increments": 2})
    x, y = GRID.coordinates()
    cell = GRID.cell_area
    q_x, q_y = state.shear
    moments = np.array([np.sum(state.pressure * y), np.sum(state.pressure * x)]) * cell
    np.testing.assert_allclose(state.moment, moments, rtol=1e-9)
    assert state.torque == pytest.approx(np.sum(q_y * x - q_x * y) * cell, rel=1e-6)
    assert state.residuals.moment_equilibrium < TOLERANCE
    assert state.residuals.torque_equilibrium < TOLERANCE


ELLIPSOID = Ellipsoid(radii=(RADIUS, 2 * RADIUS), material=paraboloid().material)


@pytest.mark.parametrize(
    "indenter", [paraboloid(), ELLIPSOID, PUNCH], ids=["ball", "ellipsoid", "punch"]
)
def test_forces_are_the_derivatives_of_the_energy(indenter):
    """Work-conjugacy: W, M_x and M_y against differences of the elastic energy."""
    at = np.array([APPROACH, 0.1 * A / RADIUS, 0.15 * A / RADIUS])
    if indenter is PUNCH:
        at[1:] *= 0.3

    def state(motion):
        step = {"approach": float(motion[0]), "tilt": tuple(map(float, motion[1:]))}
        return end(step, friction=None, indenter=indenter)

    forces = state(at)
    found = []
    for axis in range(3):
        d = np.zeros(3)
        d[axis] = 1e-3 * at[axis]
        energies = [state(at + sign * d).elastic_energy for sign in (1, -1)]
        found.append((energies[0] - energies[1]) / (2 * d[axis]))
    np.testing.assert_allclose(
        [forces.normal_force, *forces.moment], found, rtol=1e-4, atol=1e-6 * LOAD * A
    )


@pytest.mark.parametrize("bodies", [{}, {"indenter": RIGID_BALL}], ids=["alike", "unlike"])
def test_turning_the_loads_by_a_right_angle_turns_the_state(bodies):
    """x -> y, y -> -x: forces and moment arms turn alike, the torque stays."""
    one = end(
        {**PRESS, **lean(0.3, 0.1), "increments": 2},
        {**push(0.3, 0.1), **twist(0.3), "increments": 2},
        **bodies,
    )
    other = end(
        {**PRESS, **lean(-0.1, 0.3), "increments": 2},
        {**push(-0.1, 0.3), **twist(0.3), "increments": 2},
        **bodies,
    )
    peak = one.peak_pressure

    def turned(field):
        return np.rot90(field, 1)

    close(other.pressure, turned(one.pressure), 1e-6 * peak)
    close(other.shear[1], turned(one.shear[0]), 1e-5 * MU * peak)
    close(other.shear[0], -turned(one.shear[1]), 1e-5 * MU * peak)
    assert other.twist == pytest.approx(one.twist, rel=1e-5)
    # (φ_x, φ_y) are the slopes along y and x.
    close(other.tilt[::-1], [-one.tilt[0], one.tilt[1]], 1e-5 * np.max(np.abs(one.tilt)))


@pytest.mark.parametrize("bodies", [{}, {"indenter": RIGID_BALL}], ids=["alike", "unlike"])
def test_both_controls_lead_to_the_same_state(bodies):
    forced = end(
        {**PRESS, **lean(0.3, 0.1), "increments": 2},
        {**push(0.3), **twist(0.4), "increments": 1},
        **bodies,
    )
    for rotations in (
        {"twist": forced.twist, **push(0.3)},
        {"torque": forced.torque, "tangential_shift": tuple(map(float, forced.tangential_shift))},
        {"twist": forced.twist, "tangential_shift": tuple(map(float, forced.tangential_shift))},
    ):
        led = end(
            {**PRESS, **lean(0.3, 0.1), "increments": 2}, {**rotations, "increments": 1}, **bodies
        )
        close(led.pressure, forced.pressure, 1e-6 * forced.peak_pressure)
        close(led.shear, forced.shear, 1e-5 * MU * forced.peak_pressure)
        assert led.torque == pytest.approx(forced.torque, rel=1e-6)
    pressed = end({**PRESS, **lean(0.3, 0.1)}, friction=None, **bodies)
    for step in (
        {**PRESS, "tilt": tuple(map(float, pressed.tilt))},
        {"approach": pressed.approach, "tilt": tuple(map(float, pressed.tilt))},
        {"approach": pressed.approach, "moment": tuple(map(float, pressed.moment))},
    ):
        led = end(step, friction=None, **bodies)
        close(led.pressure, pressed.pressure, 1e-6 * pressed.peak_pressure)
        assert led.normal_force == pytest.approx(LOAD, rel=1e-6)
        assert led.approach == pytest.approx(pressed.approach, rel=1e-6)


@pytest.mark.parametrize(
    ("loading", "tilts", "twists"),
    [
        ((PRESS, push(0.3)), False, False),
        ((PRESS, {"twist": 0.0, "tilt": (0.0, 0.0)}, push(0.3)), False, False),
        ((PRESS, {"moment": (0.0, 0.0)}), False, False),
        ((PRESS, roll(0.1)), True, False),
        ((PRESS, twist(0.3)), False, True),
        ((PRESS, {"twist": 1e-3}), False, True),
        ((PRESS, push(0.3), {"torque": 0.0}), False, False),
        ((PRESS, {"torque": 0.0}), False, False),  # nothing is sheared: it cannot turn
    ],
)
def test_rotations_are_solved_for_where_a_step_calls_for_them(loading, tilts, twists):
    decided = plan(scene(*loading))
    assert (decided.tilt, decided.torsion) == (tilts, twists)
    effects = {effect.name: effect for effect in decided.effects}
    assert (effects["tilt"].on, effects["torsion"].on) == (tilts, twists)
    assert effects["tilt"].why
    assert effects["torsion"].why
    smooth = [step for step in loading if set(step) <= {*PRESS, "moment", "tilt"}]
    assert not plan(scene(*smooth, friction=None)).torsion
