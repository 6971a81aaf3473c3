"""Tests of the shape of the contact edge: means of powers, fits to means, points and peaks."""

import numpy as np
import pytest
from cell_means import ellipse_means, elliptic_radius
from numpy.typing import NDArray
from scipy.ndimage import binary_erosion

from semi_analytical.edge.clipped_power_means import mean_of_cut, mean_of_smooth
from semi_analytical.edge.fit import NARROW, WIDE, peak_of
from semi_analytical.edge.kernels import PARITY
from semi_analytical.edge.shape import EdgeShape, edge_shape

CELLS = 40


def border(shape: EdgeShape) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    region = shape.means > 0
    i, j = np.nonzero(region & ~binary_erosion(region))
    return i, j


# Radii in cells, angle; and the largest error of the radius there, which falls like their square.
CIRCLE = ((13.3, 13.3), 0.0)
ELLIPSE = ((15.0, 9.0), 0.5)
BOUNDS = {NARROW: 2e-4, WIDE: 3e-5}


@pytest.mark.parametrize("exponent", [0.5, 0.51, 1.5])
@pytest.mark.parametrize(("stencil", "rings"), [(NARROW, 1), (WIDE, 2)])
@pytest.mark.parametrize(("radii", "angle"), [CIRCLE, ELLIPSE])
def test_edge_points_are_on_the_edge_that_exact_means_have(radii, angle, stencil, rings, exponent):
    centre = (19.37, 19.81)
    means = ellipse_means(CELLS, radii, centre, angle, exponent)
    shape = edge_shape(means, means > 0, stencil, rings=rings, exponent=exponent)
    points, safe = shape.edge_points(*border(shape))
    assert np.all(safe)
    assert np.max(np.abs(points.f)) < 1e-12 * np.max(points.slope)
    error = elliptic_radius(points.x, points.y, radii, centre, angle) - 1
    assert np.max(np.abs(error)) < (3.0 if exponent > 1 else 1.0) * BOUNDS[stencil]


def test_a_region_without_data_is_refused():
    means = ellipse_means(CELLS, (13.3, 1.2), (19.37, 19.81))
    with pytest.raises(ValueError, match="Use smaller cells"):
        edge_shape(means, means > 0, WIDE, rings=2)


@pytest.mark.parametrize(("component", "parity"), PARITY.items())
def test_a_mirror_turns_every_index_along_its_normal(component, parity):
    assert parity == tuple((-1) ** component.count(axis) for axis in "xy")


FILM_CELLS = 64
POINTS, WEIGHTS = (half / 2 for half in np.polynomial.legendre.leggauss(3))


def means(pressure):
    """Over unit cells about the origin, off their symmetry."""
    at = np.arange(FILM_CELLS) - (FILM_CELLS - 1) / 2
    x, y = (at + 0.31)[:, None], at - 0.17
    return sum(
        w * v * pressure(x + s, y + t)
        for s, w in zip(POINTS, WEIGHTS, strict=True)
        for t, v in zip(POINTS, WEIGHTS, strict=True)
    )


def cap(x, y):
    return np.sqrt(np.maximum(1 - (x / 25) ** 2 - (y / 15) ** 2, 0))


def ring(x, y):
    return np.sqrt(np.maximum(1 - ((np.hypot(x, y) - 18) / 9) ** 2, 0))


def long_cap(x, y):
    along, across = 0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y
    return np.sqrt(np.maximum(1 - (across / 9) ** 2 - (along / 200) ** 2, 0))


@pytest.mark.parametrize(
    ("pressure", "ridge", "within"),
    [
        (cap, False, 1e-6),
        (lambda x, y: cap(5 * x, 3.5 * y), False, 1e-5),
        (ring, True, 3e-5),
        (long_cap, True, 3e-5),
    ],
    ids=["cap", "small cap", "ring", "long cap"],
)
def test_the_peak_of_caps_and_ridges(pressure, ridge, within):
    """The largest means are 5e-4 too small."""
    found = peak_of(means(pressure))
    assert found.ridge is ridge
    assert found.value == pytest.approx(1.0, abs=within)


@pytest.mark.parametrize("exponent", [0.0, 0.5, 0.51, 1.5, -0.5])
def test_the_series_is_exact_to_what_it_states(exponent):
    slopes = np.array([[1.0, 0.8, 0.5], [0.0, 0.2, 0.5]])
    f = 1.5 * np.sum(slopes, axis=0)
    found, exact = (mean(f, *slopes, exponent) for mean in (mean_of_smooth, mean_of_cut))
    np.testing.assert_allclose(found, exact, rtol=5e-6 if exponent < 0 else 1e-6)
