"""Coupled increments: laws of symmetry and scale, energy, limits, and what they cost others."""

from itertools import groupby

import numpy as np
import pytest
from contact_scenes import APPROACH, LIMIT, MU, grid, paraboloid
from contact_scenes import scene as alike_scene
from coupled_scenes import (
    SUBSTRATE,
    bulk,
    coupled_increments,
    press,
    push,
    scene,
)

from contact_scene import RIGID, Body, IsotropicMaterial, Paraboloid
from contact_scene.quantities.summary import ContactStatus
from semi_analytical import SurfaceGrid, solve

TOLERANCE = 1e-8
GRID = grid(32)
HISTORY = (press(), push(0.5, 0.2), push(-0.3, 0.1))


def last(described, on=GRID, tolerance=1e-10):
    return solve(described, on, tolerance).increments[-1]


def turned(loading):
    """The loads turned by a quarter: (x, y) -> (-y, x)."""
    return tuple(
        {**step, "tangential_force": (-step["tangential_force"][1], step["tangential_force"][0])}
        if "tangential_force" in step
        else step
        for step in loading
    )


def assert_equal_shear(one, other, pressure, tolerance=1e-6):
    assert np.max(np.abs(one - other)) <= tolerance * MU * np.max(pressure)


def test_a_turned_load_turns_the_answer():
    one, other = last(scene(*HISTORY)), last(scene(*turned(HISTORY)))
    np.testing.assert_allclose(
        other.pressure, np.rot90(one.pressure), atol=1e-6 * one.peak_pressure
    )
    x, y = (np.rot90(component) for component in one.shear)
    assert_equal_shear(other.shear, np.stack([-y, x]), one.pressure)
    x, y = one.tangential_shift
    np.testing.assert_allclose(other.tangential_shift, [-y, x], rtol=1e-7)


def test_alike_bodies_by_the_coupled_solver_are_as_by_the_uncoupled_one():
    described = alike_scene(*HISTORY)
    uncoupled = solve(described, GRID, 1e-11).increments
    coupled = coupled_increments(described, GRID, 1e-11)
    for one, other in zip(uncoupled, coupled, strict=True):
        np.testing.assert_allclose(other.pressure, one.pressure, atol=1e-8 * one.peak_pressure)
        assert_equal_shear(other.shear, one.shear, one.pressure, 1e-8)
        assert other.dissipated_energy == pytest.approx(one.dissipated_energy, rel=1e-8, abs=1e-20)
    assert one.tangential_shift == pytest.approx(other.tangential_shift, rel=1e-8)


def test_swapped_bodies_answer_an_opposite_push_with_the_opposite_shear():
    soft, stiff = Body(material=SUBSTRATE), Body(material=RIGID)
    on_soft = last(scene(press(), push(0.5), body=soft))
    of_soft = last(scene(press(), push(-0.5), body=stiff, indenter=paraboloid(SUBSTRATE)))
    np.testing.assert_allclose(
        of_soft.pressure, on_soft.pressure, atol=1e-7 * on_soft.peak_pressure
    )
    assert_equal_shear(of_soft.shear, -on_soft.shear, on_soft.pressure)


def test_status_tells_partial_slip_from_no_stick_area_from_gross_sliding():
    shift = {"tangential_shift": (APPROACH, 0.0), "increments": 10}
    path = solve(scene(press(), shift, body=bulk()), GRID, TOLERANCE).increments[2:]
    assert [status for status, _ in groupby(increment.status for increment in path)] == [
        ContactStatus.PARTIAL_SLIP,
        ContactStatus.NO_STICK_AREA_LEFT,
        ContactStatus.GROSS_SLIDING,
    ]
    for increment in path:
        assert (increment.stick_area == 0) == (increment.status is not ContactStatus.PARTIAL_SLIP)
    # The force rises all the way: no peak above what sliding takes, and no drop after it.
    force = [increment.tangential_force[0] for increment in path]
    assert np.all(np.diff(force) > 0)
    assert force[-1] == pytest.approx(LIMIT, rel=1e-5)


def test_one_cell_that_touches_sticks_and_its_slip_of_round_off_is_none():
    """Its own displacement vanishes by symmetry: what its pressure does around it tells a scale."""
    odd = SurfaceGrid((45, 45), (9 * GRID.window[0], 9 * GRID.window[1]))
    end = last(scene(press(1e-6, increments=2)), odd)
    assert np.count_nonzero(end.in_contact) == 1
    assert end.status is ContactStatus.FULL_STICK
    assert end.halvings == 0
    assert end.residuals.slip_direction < 1e-10


@pytest.mark.parametrize("cells", [25, 33])
def test_a_contact_of_one_or_five_cells_is_an_ordinary_state(cells):
    """The cell in the middle does not slip: its slip is round-off without a direction."""
    body = Body(material=IsotropicMaterial(young_modulus=100e9, poisson_ratio=0.2))
    loads = 50.0 * (np.arange(1, 7) / 50) ** 3  # as the first increments of 50 below 50 N
    described = scene(
        *({"normal_force": load, "increments": 1} for load in loads),
        body=body,
        indenter=Paraboloid(radius=0.01, material=RIGID),
        friction=0.3,
    )
    for width in (336e-6, 338e-6):
        on = SurfaceGrid((cells, cells), (width, width))
        increments = solve(described, on, TOLERANCE).increments
        assert np.count_nonzero(increments[0].in_contact) == 1
        assert np.max(np.abs(increments[0].shear)) < 1e-9 * increments[0].peak_pressure
        assert np.count_nonzero(increments[-1].in_contact) >= 5
