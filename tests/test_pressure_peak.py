"""The largest pressure at a point, from means over cells."""

import numpy as np
import pytest

from semi_analytical.edge.fit import peak_of

CELLS = 64
POINTS, WEIGHTS = (half / 2 for half in np.polynomial.legendre.leggauss(3))


def means(pressure):
    """Over unit cells about the origin, off their symmetry."""
    at = np.arange(CELLS) - (CELLS - 1) / 2
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
    [(cap, False, 1e-6), (ring, True, 3e-5), (long_cap, True, 3e-5)],
    ids=["cap", "ring", "long cap"],
)
def test_the_peak_of_caps_and_ridges(pressure, ridge, within):
    """The largest means are 5e-4 too small."""
    found = peak_of(means(pressure))
    assert found.ridge is ridge
    assert found.value == pytest.approx(1.0, abs=within)
