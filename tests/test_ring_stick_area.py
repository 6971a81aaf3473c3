"""Tests of stick areas from the border between points of rings, against closed forms."""

import numpy as np
import pytest
from numpy.typing import NDArray
from test_fem_edge import plane_contact

from radial.tangential.stick_border import stick_area as ring_stick_area

Array = NDArray[np.float64]
RINGS = np.arange(9.0)


def waves_contact(half: float, count: int, off: float) -> Array:
    """Pressure of a wave cos θ under a flat, at points that know as many harmonics (Westergaard
    1939, Bearing pressures and cracks): u = Σ p_k e^ikθ / |k|, mean sin²(α/2) of the half angle α.

    half, off  α and the place of the points, in points
    """
    step = 2 * np.pi / count
    places = (np.arange(count) - count // 2 + off) * step
    waves = np.abs(np.fft.fftfreq(count, 1 / count))
    of_waves = np.divide(1.0, waves, where=waves > 0, out=np.zeros(count))
    answer = np.fft.ifft(of_waves[:, None] * np.fft.fft(np.eye(count), axis=0), axis=0).real
    touching = np.abs(places) < half * step
    while True:
        n = np.flatnonzero(touching)
        system = np.block(
            [[answer[np.ix_(n, n)], np.ones((len(n), 1))], [np.ones((1, len(n))) / count, 0.0]]
        )
        *p, deep = np.linalg.solve(
            system, np.append(np.cos(places[n]), np.sin(half * step / 2) ** 2)
        )
        whole = np.zeros(count)
        whole[n] = p
        overlap = np.cos(places) - answer @ whole - deep
        then = np.where(touching, whole > 0, overlap > 1e-12)
        if np.array_equal(then, touching):
            return whole
        touching = then


@pytest.mark.parametrize("beyond", [0.0, 0.2, 0.4, 0.6, 0.75])
@pytest.mark.parametrize("turning", [0.0, 0.7])
def test_a_sector_that_sticks_is_as_wide_as_the_contact_of_harmonics(
    beyond: float, turning: float
) -> None:
    """All of its rings alike; the shear keeps one way, or goes on turning around."""
    half, count = 30 + beyond, 256
    missing = waves_contact(half, count, 0.0)
    sticks = np.tile(missing > 0, (len(RINGS), 1))
    angles = 2 * np.pi * np.arange(count) / count
    size = 2.0 - missing
    way = turning * np.sin(angles) - angles

    def area_of(way: Array) -> float:
        shear = np.stack([size * np.cos(way), size * np.sin(way)])
        whole = np.broadcast_to(shear[:, None], (2, len(RINGS), count))
        return ring_stick_area(RINGS, whole, np.full(sticks.shape, 2.0), sticks)

    area = area_of(way)
    width = area / (np.pi * RINGS[-1] ** 2) * count / 2
    assert width == pytest.approx(half, abs=0.01 if turning == 0 else 0.05)
    # Turned as a whole, with the jump of the angle by 2π between any two points beside the border.
    for last in np.flatnonzero(np.diff(sticks[0])):
        beside = way[last - 2 : last + 4]
        for jump in (beside[1:] + beside[:-1]) / 2:
            assert area_of(way + np.pi - jump) == pytest.approx(area, rel=1e-9)


@pytest.mark.parametrize("beyond", [0.05, 0.3, 0.5, 0.8, 0.99])
@pytest.mark.parametrize("count", [6, 7])
def test_a_disc_that_sticks_is_as_wide_as_the_plane_contact_on_hats(
    beyond: float, count: int
) -> None:
    missing = plane_contact(150 + beyond)
    radii, sticks = np.arange(len(missing)) * 1.0, missing > 0
    size = np.tile(200.0 - missing, (count, 1)).T
    angles = 2 * np.pi * np.arange(count) / count
    shear = np.stack([size * np.cos(angles), -size * np.sin(angles)])
    whole = np.tile(sticks, (count, 1)).T
    area = ring_stick_area(radii, shear, np.full(size.shape, 200.0), whole)
    assert np.sqrt(area / np.pi) == pytest.approx(150 + beyond, abs=6e-3)


def test_all_that_sticks_counts_and_nothing_else() -> None:
    shear, bound = np.zeros((2, 9, 8)), np.ones((9, 8))
    for share in (0.0, 1.0):
        area = ring_stick_area(RINGS, shear, bound, np.full((9, 8), share > 0))
        assert area == pytest.approx(share * np.pi * RINGS[-1] ** 2)
