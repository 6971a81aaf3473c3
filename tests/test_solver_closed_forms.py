"""The solver against the closed forms: pressure, approach, shear, shift and energy."""

import numpy as np
import pytest
from contact_scenes import (
    LOAD,
    MU,
    PRESS,
    RIGID_BALL,
    YOUNG,
    A,
    grid,
    hertz,
    push,
    scene,
    steel,
)
from contact_scenes import paraboloid as ball

from contact_scene import Cone, FlatPunch
from semi_analytical import SurfaceGrid, solve
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.closed_forms.hertz import PointContact
from verification.closed_forms.moduli import contact_modulus, tangential_modulus
from verification.closed_forms.tangential_history import TangentialHistory

TOLERANCE = 1e-8


def pressed(cells, **more):
    return solve(scene(PRESS, friction=None, **more), grid(cells), TOLERANCE).steps[0]


@pytest.mark.parametrize(
    ("cells", "peak", "approach"),
    [(64, 5e-4, 8e-5), (128, 1.5e-4, 5e-5), pytest.param(256, 4e-5, 1e-5)],
)
def test_hertz(cells, peak, approach):
    """Discretisation errors: O(h^2) in peak and approach."""
    exact, found = hertz(), pressed(cells)
    assert found.peak_pressure == pytest.approx(exact.peak_pressure, rel=peak)
    assert found.approach == pytest.approx(exact.approach, rel=approach)
    assert found.contact_radius == pytest.approx(exact.contact_radius, rel=0.2 / cells + 1e-3)


def test_hertz_under_a_rigid_ball():
    exact = PointContact.under_load(LOAD, 0.018, contact_modulus((YOUNG, 0.3)))
    window = grid(64, radius=exact.contact_radius)
    found = solve(scene(PRESS, friction=None, indenter=RIGID_BALL), window, TOLERANCE).steps[0]
    assert found.approach == pytest.approx(exact.approach, rel=8e-5)
    assert found.peak_pressure == pytest.approx(exact.peak_pressure, rel=5e-4)


def test_gap_outside_the_contact_is_that_of_hertz():
    found = pressed(64)
    x, y = grid(64).coordinates()
    np.testing.assert_allclose(found.gap, hertz().gap(np.hypot(x, y)), atol=2e-3 * found.approach)


def test_cone():
    slope = 0.02
    exact = ConeContact.under_load(LOAD, slope, contact_modulus((YOUNG, 0.3), (YOUNG, 0.3)))
    cone = Cone(slope_angle=slope, material=steel())
    window = grid(128, radius=exact.contact_radius)
    found = solve(scene(PRESS, friction=None, indenter=cone), window, TOLERANCE).steps[0]
    # The tip lies between the centres, half a cell diagonal away: its height is missing.
    assert found.approach == pytest.approx(exact.approach, rel=1e-2)
    assert found.contact_radius == pytest.approx(exact.contact_radius, rel=3e-3)


def test_flat_punch():
    exact = FlatPunchContact.under_load(LOAD, A, contact_modulus((YOUNG, 0.3), (YOUNG, 0.3)))
    found = pressed(128, indenter=FlatPunch(radius=A, material=steel()))
    # Cells approximate the rim, where pressure is infinite: first order.
    assert found.approach == pytest.approx(exact.approach, rel=5e-3)
    assert found.contact_radius == pytest.approx(A, rel=2e-3)


@pytest.fixture(scope="module")
def fretting():
    """Identical bodies of nu = 0, where Mindlin and Deresiewicz are exact, before any shear."""
    moduli = ((YOUNG, 0.0), (YOUNG, 0.0))
    contact = PointContact.under_load(LOAD, 0.018, contact_modulus(*moduli))
    virgin = PartialSlip(LOAD, contact.contact_radius, MU, tangential_modulus(*moduli), 0.0)
    window = SurfaceGrid((64, 64), (3 * contact.contact_radius,) * 2)
    path = [push(0.9, increments=3), push(-0.9, increments=3), push(0.9, increments=3)]
    problem = scene(PRESS, *path, indenter=ball(steel(0)), body=steel(0))
    return TangentialHistory(virgin), solve(problem, window, TOLERANCE)


def test_shear_follows_mindlin_and_deresiewicz(fretting):
    exact, result = fretting
    x, y = result.grid.coordinates()
    for increment in result.increments[1:]:
        exact = exact.loaded_to(float(increment.tangential_force[0]))
        q = exact.shear(np.hypot(x, y))
        # Edge cells: worst just after a reversal, when the new slip zone is narrower than a cell.
        assert np.sum(np.abs(increment.shear[0] - q)) < 7e-3 * MU * np.sum(increment.pressure)
        assert np.max(np.abs(increment.shear[1])) <= 1e-8 * np.max(increment.shear)


def test_shift_and_energy_follow_mindlin_and_deresiewicz(fretting):
    exact, result = fretting
    for increment in result.increments[1:]:
        exact = exact.loaded_to(float(increment.tangential_force[0]))
        assert increment.tangential_shift[0] == pytest.approx(
            exact.shift, abs=3e-4 * exact.virgin.sliding_shift
        )
        assert increment.stick_radius == pytest.approx(
            exact.stick_radius, abs=0.01 * exact.virgin.contact_radius
        )
    assert result.steps[-1].dissipated_energy == pytest.approx(exact.dissipated_energy, rel=2e-3)
