"""Tests of coupled increments: equations, status, contact fraction, and slip from first touch."""

from itertools import groupby

import numpy as np
import pytest
from contact_scenes import APPROACH, LIMIT, LOAD, MU, RADIUS, A, grid
from coupled_scenes import (
    bulk,
    coated,
    press,
    push,
    scene,
)

from contact_scene import (
    RIGID,
    Ellipsoid,
    FlatPunch,
    HeightMap,
)
from contact_scene.quantities.summary import ContactStatus
from fem_reference.contact.increment import touching_share as share_of_rings
from semi_analytical import SurfaceGrid, solve
from semi_analytical.increments.tangential_state import touching_share

TOLERANCE = 1e-8
GRID = grid(32)


def last(described, on=GRID, tolerance=1e-10):
    return solve(described, on, tolerance).increments[-1]


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


CELLS = 48
SPACING = 3 * A / CELLS
POSITIONS = (np.arange(CELLS) - 0.5 * (CELLS - 1)) * SPACING


def slide(x, increments=3) -> dict:
    """A tangential shift in units of a tenth of the approach."""
    return {"tangential_shift": (0.1 * x * APPROACH, 0.0), "increments": increments}


def to(x, load, increments=4) -> dict:
    """Both forces at once, in parts of the friction limit under full load and of that load."""
    force = {"tangential_force": (x * LIMIT, 0.0), "normal_force": load * LOAD}
    return {**force, "increments": increments}


def height_map(heights):
    return HeightMap(file=heights, spacing=SPACING, material=RIGID)


def two_bumps():
    one, other = ((POSITIONS[:, None] - c) ** 2 + POSITIONS**2 for c in (-0.7 * A, 0.7 * A))
    return height_map(np.minimum(one, other) / (2 * RADIUS))


def rough():
    noise = np.random.default_rng(3).standard_normal((CELLS, CELLS))
    heights = (POSITIONS[:, None] ** 2 + POSITIONS**2) / (2 * RADIUS)
    return height_map(heights + 0.02 * APPROACH * noise)


def patchy_friction():
    values = np.random.default_rng(4).uniform(0, 2 * MU, (CELLS, CELLS))
    values[values < 0.3 * MU] = 0
    return {"map": values, "spacing": SPACING}


def strong(friction, poisson_ratio, part):
    """Pushed by a part of the limit on a homogeneous body: µ|beta| of one and more."""
    loading = press(), push(part, friction=friction)
    return loading, {"body": bulk(poisson_ratio), "friction": friction}, 2.5


PATH = (press(), push(0.6))
# Loading steps, the scene, and the half window in contact radii if the contact is larger.
HISTORIES = {
    "µ = 2, ν = 0": strong(2.0, 0.0, 0.6),
    "µ = 5, ν = 0.3": strong(5.0, 0.3, 0.6),
    "mapped friction with zeros": (
        (press(), push(0.6), push(-0.6)),
        {"friction": patchy_friction()},
    ),
    "friction coefficient of zero": ((press(), slide(1)), {"friction": 0.0}),
    "two contacts": ((press(0.1), push(0.07), push(-0.07)), {"indenter": two_bumps()}),
    "rough surface": ((press(), push(0.6), push(-0.3, 0.4)), {"indenter": rough()}),
    "W and T reversed together": ((press(), push(0.8), to(-0.8, 0.85, 6)), {}),
    "T at the limit": ((press(), push(0.9), push(1.0)), {}),
    **{
        f"E1/E2 = {ratio:g}": (PATH, {"body": coated(ratio)}, wide)
        for ratio, wide in ((1e-3, 12), (1e3, 0.3))
    },
    "thin soft incompressible layer": (PATH, {"body": coated(0.1, 0.2, 0.5)}, 2),
    "shift far beyond sliding and back": ((press(), slide(1), slide(100), slide(0)), {}),
    "controls in turn": (
        ({"approach": APPROACH, "increments": 2}, slide(0.5), push(0.3), press(), slide(-0.5)),
        {},
    ),
    "unloading and reloading, sheared": ((press(), push(0.5), to(0, 0.01), to(0.5, 1)), {}),
    # Shear lifts the surface of the soft incompressible film more than pressure.
    "contact that falls apart": (
        (press(), push(0.9, friction=2.0, increments=1)),
        {"body": coated(1e-3, 0.01, 0.5), "friction": 2.0},
        1.3,
    ),
    "flat punch": (
        (press(), push(0.8), push(-0.8)),
        {"indenter": FlatPunch(radius=A, material=RIGID)},
    ),
    "ellipsoid, obliquely": (
        (press(0.3), push(0.15, 0.15)),
        {"indenter": Ellipsoid(radii=(RADIUS, 4 * RADIUS), material=RIGID)},
    ),
}


@pytest.mark.parametrize("history", HISTORIES.values(), ids=HISTORIES)
def test_every_increment_obeys_all_equations(history):
    loading, more, *wide = history
    energy = 0.0
    for increment in solve(scene(*loading, **more), grid(CELLS, *wide), TOLERANCE).increments:
        assert increment.residuals.worst <= TOLERANCE
        assert increment.halvings == 0
        assert np.all(np.isfinite(increment.pressure))
        assert np.all(np.isfinite(increment.shear))
        assert increment.stick_area <= increment.contact_area
        if increment.dissipated_energy is not None:
            assert increment.energy_imbalance < 1e-6
            assert increment.dissipated_energy >= energy
            energy = increment.dissipated_energy


def test_contact_that_falls_apart_under_coupling_is_found_with_caution():
    """Below it, µ = 2 on a soft incompressible film, shear lifts the surface more than pressure."""
    described = scene(
        press(), push(0.9, friction=2.0, increments=1), body=coated(1e-3, 0.01, 0.5), friction=2.0
    )
    for increment in solve(described, grid(CELLS, 1.3), TOLERANCE).increments:
        assert increment.residuals.worst <= TOLERANCE
        assert increment.halvings == 0


X = np.linspace(-1.2, 1.2, 49)
SQUARED = X[:, None] ** 2 + X**2


def hertz(a, squared=SQUARED):
    """Pressure below a paraboloid in contact up to a, over its largest at a = 1."""
    return np.sqrt(np.maximum(a**2 - squared, 0.0))


@pytest.mark.parametrize("a", [0.0, 0.52, 0.88])
def test_below_a_paraboloid_the_share_is_that_of_the_area(a):
    share = touching_share(hertz(a), hertz(1.0), SQUARED)
    meets = (a**2 < SQUARED) & (SQUARED < 1)
    np.testing.assert_allclose(share[meets], (1 - SQUARED[meets]) / (1 - a**2), atol=1e-9)
    assert np.all(share[~meets] == 1)


def test_a_lower_summit_touches_later():
    """Of alike summits each has p² in proportion to how far it is pressed in."""
    nearer, farther = (SQUARED + 1.2 * X[:, None] * side + 0.36 for side in (1, -1))
    before, after = hertz(0.3, nearer), hertz(0.5, nearer) + hertz(0.2, farther)
    share = touching_share(before, after, SQUARED)
    assert share[farther < 0.04].max() == pytest.approx(0.04 / 0.16)


def test_parting_is_meeting_backwards():
    meets = touching_share(hertz(0.8), hertz(1.0), SQUARED)
    np.testing.assert_array_equal(touching_share(hertz(1.0), hertz(0.8), SQUARED), meets)
    assert np.any(meets < 1)


def test_slip_and_its_energy_count_from_touch():
    """Against many increments; charged for all motion they are off by 0.58 and 0.08."""

    def pressed(increments):
        return solve(
            scene(press(increments=increments), body=bulk(0.3)), grid(40, 1.25), 1e-7
        ).increments[-1]

    few, many = pressed(10), pressed(40)
    assert np.max(np.hypot(*few.slip)) == pytest.approx(np.max(np.hypot(*many.slip)), rel=0.06)
    assert few.dissipated_energy == pytest.approx(many.dissipated_energy, rel=0.03)


def test_rings_touch_for_their_part_of_the_way_of_the_edge():
    radii = np.array([0.5, 1.25, 1.75, 3.0])
    small, large = (1.0, radii > 1.0), (2.0, radii > 2.0)
    for (edge, apart), (edge_after, apart_after) in ((small, large), (large, small)):
        share = share_of_rings(radii, apart, apart_after, edge, edge_after)
        np.testing.assert_allclose(share[:3], [1.0, 0.75, 0.25])
    assert share_of_rings(radii, small[1], large[1], 1.0, 2.0)[3] == 0.0
