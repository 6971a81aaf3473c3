"""Tests of the indenters: the gap at first touch."""

import re
from decimal import Decimal, localcontext
from typing import get_args

import numpy as np
import pytest
from contact_scenes import PRESS, RADIUS, A, scene, steel
from fem_scenes import elements
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import ArrayLike, NDArray
from strategies import SHAPED

import contact_scene
from contact_scene import (
    RIGID,
    Cone,
    Cylinder,
    HeightMap,
    LineProfile,
    Paraboloid,
    RevolvedProfile,
    Sphere,
    Strip,
    SurfaceDiscretisation,
)
from contact_scene.geometry import SHAPES as REGISTERED
from contact_scene.geometry import Gap, Indenter, ShapedBody
from contact_scene.reading.quantity import PositiveLength
from contact_scene.reading.scene_text import shape_text
from contact_scene.solver_errors import SolverError, UnsupportedScene
from fem_reference import plan as plan_of_elements
from fem_reference import solve as solve_by_elements
from semi_analytical import solve_discretised
from verification.closed_forms.flat_punch import ConeContact
from verification.closed_forms.hertz import PointContact
from verification.closed_forms.line_contact import CylinderContact

R = 0.018


@pytest.mark.parametrize("r", [1e-9, 1e-6, 1e-3, 0.01, 0.0179999, 0.018 - 3.5e-18, 0.018 - 1e-12])
def test_the_sphere_is_the_exact_arc_without_cancellation(r):
    with localcontext() as context:
        context.prec = 60
        exact = Decimal(R) - (Decimal(R) ** 2 - Decimal(r) ** 2).sqrt()
    assert Sphere(material=RIGID, radius=R).initial_gap(r, 0.0) == pytest.approx(
        float(exact), rel=2e-15
    )


def heights(nx: int = 12, ny: int = 9, seed: int = 1) -> NDArray[np.float64]:
    return np.random.default_rng(seed).normal(size=(nx, ny))


def centres(count: int, spacing: float) -> NDArray[np.float64]:
    return (np.arange(count) - 0.5 * (count - 1)) * spacing


@given(st.floats(1e-9, 1e3), st.integers(4, 33), st.integers(4, 33))
def test_a_height_map_gives_its_own_values_to_round_off(spacing, nx, ny):
    values = heights(nx, ny)
    shape = HeightMap(material=RIGID, file=values, spacing=(spacing, 2 * spacing))
    # Another formula for the same centres, as a solver's grid may have.
    x = (np.arange(nx) + 0.5) * spacing - 0.5 * nx * spacing
    gap = shape.initial_gap(x[:, None], centres(ny, 2 * spacing)[None, :])
    np.testing.assert_allclose(gap - gap.min(), values - values.min(), rtol=0, atol=4e-15)


def test_first_touch_of_a_height_map_is_the_minimum_between_its_points():
    for seed in range(5):
        shape = HeightMap(material=RIGID, file=heights(seed=seed), spacing=1.0)
        x, y = np.linspace(-5.5, 5.5, 441), np.linspace(-4.0, 4.0, 321)  # 40 per spacing
        assert 0.0 <= shape.initial_gap(x[:, None], y).min() < 4e-3


@pytest.mark.parametrize("count", [12, 13])
def test_a_map_touches_first_on_its_flat_and_not_beside_it(count):
    """Cubic convolution dips below a flat by 2/27 of the adjacent height."""
    x, y = centres(count, 1.0)[:, None], centres(count, 1.0)
    odd = [np.hypot(x, y)] * (count % 2)  # two equal values between larger ones are a smooth tip
    for r in (x + 0 * y, y + 0 * x, np.maximum(abs(x), abs(y)), *odd):
        for height in (np.square(np.maximum(abs(r) - 2.8, 0.0)), np.where(r > 0.3, 1.0, 0.0)):
            shape = HeightMap(material=RIGID, file=height, spacing=1.0)
            gap = shape.initial_gap(x, y)
            np.testing.assert_allclose(gap, height - np.min(height), rtol=0, atol=1e-14)
            fine = np.linspace(y[0], y[-1], 20 * count)
            assert np.min(shape.initial_gap(fine[:, None], fine)) >= -1e-14


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(0.1, 2.0))
def test_a_map_of_a_paraboloid_touches_first_at_the_tip(u, v, bent):
    """The tip may lie between the points."""
    x, y = centres(12, 1.0)[:, None], centres(13, 1.0)
    shape = HeightMap(material=RIGID, file=np.square(x - u) + bent * np.square(y - v), spacing=1.0)
    for r in (np.linspace(-6, 6, 25), np.array([u])):
        exact = np.square(r[:, None] - u) + bent * np.square(r - v)
        found = shape.initial_gap(r[:, None], r)
        np.testing.assert_allclose(found, exact, rtol=0, atol=1e-6)


def test_a_height_map_is_even_about_both_planes_or_not_at_all():
    x, y = centres(6, 1.0)[:, None], centres(5, 1.0)
    maps = (HeightMap(material=RIGID, file=x**2 + y**2 + odd, spacing=1.0) for odd in (0 * x, x, y))
    assert [shape.is_even for shape in maps] == [True, False, False]


def test_a_window_beyond_the_height_map_is_refused_with_both_lengths():
    shape = HeightMap(material=RIGID, file=heights(), spacing=1e-3)
    shape.initial_gap(6e-3, 4.5e-3)
    for x in (-6.1e-3, 6.1e-3, np.array([0.0, 6.1e-3, -1e-3])):
        with pytest.raises(ValueError, match=r"\|x\| <= 0.006 .*\|x\| = 0.0061: .* 0.012 along x"):
            shape.initial_gap(x, 0.0)
    with pytest.raises(ValueError, match=r"covers \|y\| <= 0.0045 .* requested is \|y\| = nan"):
        shape.initial_gap(0.0, np.nan)


def tip(radii, height, **more):
    """A profile of revolution by some of its points."""
    return RevolvedProfile(material=RIGID, file=np.stack([radii, height(radii)], axis=1), **more)


@pytest.mark.parametrize("first", [0.0, 0.07])
@pytest.mark.parametrize("power", [1.0, 1.7])
def test_a_profile_of_a_paraboloid_is_the_paraboloid(first, power):
    """Even at the axis, and whether or not it has a point there."""
    shape = tip(first + np.linspace(0, 1, 9) ** power, lambda r: 3.0 + r**2 / 2)
    r = np.linspace(0, 1, 101)
    np.testing.assert_allclose(shape.initial_gap(0.6 * r, 0.8 * r), r**2 / 2, rtol=0, atol=1e-14)
    assert shape.contact_at(0.01)[0] == pytest.approx(0.01, rel=1e-8)
    assert shape.contact_under(4e-3 / 3, 1.0)[0] == pytest.approx(1e-3, rel=1e-8)


@given(st.integers(4, 40), st.floats(0.1, 0.8))
def test_a_profile_does_not_dip_below_its_flat(count, flat):
    shape = tip(np.linspace(0, 1, count) ** 1.2, lambda r: np.maximum(r - flat, 0.0))
    gap = shape.initial_gap(np.linspace(0, 1, 401), 0.0)
    assert np.all(np.diff(gap) >= -1e-15)
    assert shape.lowest_radius == gap[0] == 0


def test_a_profile_is_read_in_any_order_unit_and_sign(tmp_path):
    whole = tip(1e-6 * np.array([0.0, 2.0, 3.0, 5.0]), lambda r: 1e-3 * r)
    table = np.array([[0.0, 2.0, 3.0, 5.0], [0.0, 2.0, 3.0, 5.0]])
    more = {"material": RIGID, "radius_unit": "um", "height_unit": "nm"}
    (tmp_path / "tip.csv").write_text("r;z\n0;0\n2;2,0\n3;3\n5;5\n", encoding="utf-8")
    read = {"folder": tmp_path}
    for shape in (
        RevolvedProfile(file=table, **more),
        RevolvedProfile(file=table.T[::-1], **more),
        RevolvedProfile(file=table * [[1], [-1]], flip=True, **more),
        RevolvedProfile.model_validate({"file": "tip.csv", **more}, context=read),
    ):
        r = np.linspace(0, 5e-6, 11)
        np.testing.assert_allclose(shape.initial_gap(r, 0), whole.initial_gap(r, 0), atol=1e-22)


ANGLES = np.linspace(0.0, 2 * np.pi, 17)


class Barrel(ShapedBody):
    """Two radii, and not a word of it."""

    radii: tuple[PositiveLength, PositiveLength]

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """To second order."""
        R_x, R_y = self.radii
        return np.asarray(np.square(x) / (2 * R_x) + np.square(y) / (2 * R_y))


class Egg(Paraboloid):
    """Derived from a shape of revolution, which it is not."""

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Twice as wide along y."""
        return np.asarray((np.square(x) + np.square(y) / 4) / (2 * self.radius))


class Dome(Barrel):
    """Says that it is of revolution, and nothing of how large its contact is."""

    @property
    def is_of_revolution(self) -> bool:
        """It is."""
        return True

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Of the fourth order."""
        return np.asarray((np.square(x) + np.square(y)) ** 2 / self.radii[0] ** 3)


NEW = (
    Barrel(material=steel(), radii=(RADIUS, 3 * RADIUS)),
    Egg(material=steel(), radius=RADIUS),
    Dome(material=steel(), radii=(0.1 * RADIUS, RADIUS)),
)
ALL = SHAPED | st.sampled_from(NEW)


def on(shape, **update):
    """A scene with any indenter, one that no file can name included."""
    return scene(PRESS, friction=None).model_copy(update={"indenter": shape, **update})


def test_every_shape_is_registered_everywhere():
    branches = get_args(get_args(Indenter)[0])
    assert [get_args(branch)[0] for branch in branches] == list(REGISTERED.values())
    assert [get_args(branch)[1].tag for branch in branches] == [f"<{name}>" for name in REGISTERED]
    for name, shape in REGISTERED.items():
        assert shape.model_fields["shape"].default == name
        assert getattr(contact_scene, shape.__name__) is shape


@given(ALL, st.floats(1e-9, 0.5), st.floats(0, 2 * np.pi))
def test_what_a_shape_says_of_its_gap_is_true(shape, reach, angle):
    x, y = np.multiply(shape.extent or (1.0, 1.0), reach) * (np.cos(angle), np.sin(angle))
    assert not np.isnan(shape.initial_gap(x, y))
    if shape.is_even:
        mirrored = shape.initial_gap(np.array([x, -x, x]), np.array([y, y, -y]))
        # A table is interpolated with the round-off of its heights.
        heights = np.ptp(shape.profile.heights) if isinstance(shape, LineProfile) else 0.0
        np.testing.assert_allclose(mirrored, mirrored[0], rtol=1e-12, atol=1e-15 * heights)
    if shape.is_of_revolution:
        around = shape.initial_gap(reach * np.cos(ANGLES), reach * np.sin(ANGLES))
        # Round-off of the radius, which an edge or an equator makes large, and of the gap.
        least, most = shape.initial_gap(reach * np.array([1 - 1e-15, 1 + 1e-15]), 0.0)
        assert np.all((around >= least * (1 - 1e-14)) & (around <= most * (1 + 1e-14)))
    if shape.rim is not None:
        r = shape.rim * np.array([0.0, 0.5, 1 - 1e-9, 1 + 1e-9, 2.0])
        np.testing.assert_array_equal(np.isfinite(shape.initial_gap(r, 0.0)), r < shape.rim)
    if shape.extent is not None:
        with pytest.raises(ValueError, match="covers"):
            shape.initial_gap(0.51 * shape.extent[0], 0.0)
    elif shape.gap_exponent is not None:
        k = shape.gap_exponent
        r = min(shape.contact_at(1e-18 * reach)) ** (1 / k)  # far below any radius that is drawn
        flat = shape.half_width if isinstance(shape, Strip) else 0.0
        # Beside a flat the distance has the round-off of its width.
        r = max(r, 1e-8 * flat)
        one, two = shape.initial_gap([flat + r, flat + 2 * r], 0.0)
        assert two / one == pytest.approx(2.0**k, rel=1e-5)


@pytest.mark.parametrize(
    ("shape", "exact"),
    [
        (Paraboloid(material=RIGID, radius=R), PointContact.under_load(800.0, R, 2e9)),
        (Cone(material=RIGID, slope_angle=0.3), ConeContact.under_load(800.0, 0.3, 2e9)),
        (
            Cylinder(material=RIGID, radius=R, reference_length=1.0),
            CylinderContact(800.0, R, 2e9, 1.0),
        ),
    ],
)
def test_a_contact_is_as_large_as_in_closed_form(shape, exact):
    a, k = exact.contact_radius, shape.gap_exponent
    assert shape.contact_at(exact.approach)[0] == pytest.approx(a**k, rel=1e-12)
    assert shape.contact_under(800.0, 2e9)[0] == pytest.approx(a**shape.load_exponent, rel=1e-12)


@given(ALL, st.floats(1e-9, 1.0), st.floats(1e3, 1e12))
def test_a_contact_grows_with_the_load(shape, approach, modulus):
    for of in (shape.contact_at, lambda load: shape.contact_under(load, modulus)):
        smaller, larger = of(approach), of(2 * approach)
        assert (smaller is None) == (larger is None)
        if smaller is not None:
            assert 0 < smaller[0] < larger[0] < np.inf
            assert 0 < smaller[1] < larger[1] < np.inf
            assert shape.gap_exponent is not None


ON = {
    "cells": lambda asked: solve_discretised(asked, SurfaceDiscretisation(cells=(16, 16))),
    "elements": lambda asked: solve_by_elements(asked, elements(4, box=10.0)),
}


@pytest.mark.parametrize("solve", ON.values(), ids=ON)
@given(shape=ALL)
@settings(max_examples=15)
def test_solvers_solve_or_refuse_any_shape(solve, shape):
    try:
        solved = solve(on(shape))
    except SolverError:
        return
    assert solved.increments[-1].normal_force == pytest.approx(PRESS["normal_force"])


@given(ALL.filter(lambda shape: not shape.is_of_revolution))
@settings(max_examples=15)
def test_elements_refuse_shapes_neither_of_revolution_nor_symmetric_lines(shape):
    if shape.is_line and shape.is_even:
        assert plan_of_elements(on(shape)).effects
        return
    named = re.escape(shape_text(shape))
    why = "not symmetric about x = 0" if shape.is_line else f"{named}.*bodies of revolution"
    with pytest.raises(UnsupportedScene, match=why):
        plan_of_elements(on(shape))


@pytest.mark.parametrize("shape", NEW, ids=lambda shape: type(shape).__name__)
def test_a_shape_that_says_nothing_is_solved_where_its_window_is_given(shape):
    with pytest.raises(UnsupportedScene, match="Set window"):
        solve_discretised(on(shape), SurfaceDiscretisation(cells=(16, 16)))
    window = (6 * A, 6 * A)
    asked = SurfaceDiscretisation(cells=(24, 24), window=window, tolerance=1e-6)
    assert solve_discretised(on(shape), asked).increments[-1].contact_radius > 0
