"""Indenters: the gap at first touch."""

from decimal import Decimal, localcontext
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from contact_scene import (
    RIGID,
    Cone,
    Ellipsoid,
    FlatPunch,
    HeightMap,
    Paraboloid,
    Sphere,
)

R = 0.018
SHAPES = [
    Sphere(material=RIGID, radius=R),
    Paraboloid(material=RIGID, radius=R),
    Ellipsoid(material=RIGID, radii=(R, 2 * R)),
    Cone(material=RIGID, slope_angle=0.3),
    FlatPunch(material=RIGID, radius=R),
]


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.shape)
def test_first_touch_is_at_the_origin_and_nothing_lies_below(shape: Any) -> None:
    x = np.linspace(-2 * R, 2 * R, 41)
    gap = shape.initial_gap(x[:, None], x[None, :])
    assert gap.shape == (41, 41)
    assert gap[20, 20] == 0.0
    assert gap.min() == 0.0


@pytest.mark.parametrize("r", [1e-9, 1e-6, 1e-3, 0.01, 0.0179999, 0.018 - 3.5e-18, 0.018 - 1e-12])
def test_the_sphere_is_the_exact_arc_without_cancellation(r: float) -> None:
    with localcontext() as context:
        context.prec = 60
        exact = Decimal(R) - (Decimal(R) ** 2 - Decimal(r) ** 2).sqrt()
    assert SHAPES[0].initial_gap(r, 0.0) == pytest.approx(float(exact), rel=2e-15)


def test_the_cone_rises_with_its_slope_angle() -> None:
    assert SHAPES[3].initial_gap(0.3, 0.4) == pytest.approx(0.5 * np.tan(0.3), rel=1e-15)


def test_the_flat_punch_touches_up_to_its_rim_and_never_beyond() -> None:
    gap = SHAPES[4].initial_gap([0.0, R, R * (1 + 1e-15), 2 * R], 0.0)
    np.testing.assert_array_equal(gap, [0.0, 0.0, np.inf, np.inf])


def heights(nx: int = 12, ny: int = 9, seed: int = 1) -> NDArray[np.float64]:
    return np.random.default_rng(seed).normal(size=(nx, ny))


def centres(count: int, spacing: float) -> NDArray[np.float64]:
    return (np.arange(count) - 0.5 * (count - 1)) * spacing


@given(st.floats(1e-9, 1e3), st.integers(4, 33), st.integers(4, 33))
def test_a_height_map_gives_its_own_values_to_round_off(spacing: float, nx: int, ny: int) -> None:
    values = heights(nx, ny)
    shape = HeightMap(material=RIGID, file=values, spacing=(spacing, 2 * spacing))
    # Another formula for the same centres, as a solver's grid may have.
    x = (np.arange(nx) + 0.5) * spacing - 0.5 * nx * spacing
    gap = shape.initial_gap(x[:, None], centres(ny, 2 * spacing)[None, :])
    np.testing.assert_allclose(gap - gap.min(), values - values.min(), rtol=0, atol=4e-15)


def test_first_touch_of_a_height_map_is_the_minimum_between_its_points() -> None:
    for seed in range(5):
        shape = HeightMap(material=RIGID, file=heights(seed=seed), spacing=1.0)
        x, y = np.linspace(-5.5, 5.5, 441), np.linspace(-4.0, 4.0, 321)  # 40 per spacing
        assert 0.0 <= shape.initial_gap(x[:, None], y).min() < 4e-3


def test_a_window_beyond_the_height_map_is_refused_with_both_lengths() -> None:
    shape = HeightMap(material=RIGID, file=heights(), spacing=1e-3)
    shape.initial_gap(6e-3, 4.5e-3)
    for x in (-6.1e-3, 6.1e-3, np.array([0.0, 6.1e-3, -1e-3])):
        with pytest.raises(ValueError, match=r"\|x\| <= 0.006 .*\|x\| = 0.0061: .* 0.012 along x"):
            shape.initial_gap(x, 0.0)
    with pytest.raises(ValueError, match=r"covers \|y\| <= 0.0045 .* asked for \|y\| = nan"):
        shape.initial_gap(0.0, np.nan)
