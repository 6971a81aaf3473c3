"""Reference means of (1 - u² - v²)_+^exponent over grid cells of an ellipse, by quadrature."""

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
POINTS = 24


def ellipse_means(
    cells: int,
    radii: tuple[float, float],
    centre: tuple[float, float],
    angle: float = 0.0,
    exponent: float = 0.5,
) -> Field:
    """(cells, cells); lengths are cells, index coordinates."""
    places, weights = (half / 2 for half in np.polynomial.legendre.leggauss(POINTS))
    at = np.arange(cells)
    total = np.zeros((cells, cells))
    for dx, weight_x in zip(places, weights, strict=True):
        for dy, weight_y in zip(places, weights, strict=True):
            r = elliptic_radius(at[:, None] + dx, at + dy, radii, centre, angle)
            total += weight_x * weight_y * np.maximum(1 - r**2, 0.0) ** exponent
    return total


def elliptic_radius(
    x: Field,
    y: Field,
    radii: tuple[float, float],
    centre: tuple[float, float],
    angle: float = 0.0,
) -> Field:
    """One on the ellipse."""
    dx, dy = x - centre[0], y - centre[1]
    u, v = np.cos(angle) * dx + np.sin(angle) * dy, np.cos(angle) * dy - np.sin(angle) * dx
    return np.hypot(u / radii[0], v / radii[1])
