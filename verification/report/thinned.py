"""A curve with the points that a reader can see, and no others."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

FINENESS = 1e-3  # of either side of the panel; half a pixel of 500


def thinned(
    x: ArrayLike,
    y: ArrayLike,
    spans: tuple[tuple[float, float], tuple[float, float]],
    logarithmic: tuple[bool, bool],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Drop points that lie on the line between their neighbours, within what can be seen.

    Ramer (1972), Douglas and Peucker (1973).

    spans        what the axes show of x and of y: smallest and largest value
    logarithmic  which axes are
    returns      x and y, both ends always kept
    """
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    places = [
        _on_axis(values, span, is_log)
        for values, span, is_log in zip((x, y), spans, logarithmic, strict=True)
    ]
    u, v = places
    if len(x) < 3 or not (np.isfinite(u).all() and np.isfinite(v).all()):
        return x, y
    kept = np.zeros(len(x), dtype=bool)
    kept[[0, -1]] = True
    open_parts = [(0, len(x) - 1)]
    while open_parts:
        first, last = open_parts.pop()
        if last - first < 2:
            continue
        apart = _from_chord(u[first : last + 1], v[first : last + 1])
        worst = int(np.argmax(apart))
        if apart[worst] > FINENESS:
            kept[first + worst] = True
            open_parts += [(first, first + worst), (first + worst, last)]
    return x[kept], y[kept]


def _on_axis(
    values: NDArray[np.float64], span: tuple[float, float], logarithmic: bool
) -> NDArray[np.float64]:
    """Where on the axis, over its length; NaN for what is not on it."""
    low, high = span
    if logarithmic:
        if low <= 0 or np.any(values <= 0):
            return np.full_like(values, np.nan)
        values, low, high = np.log(values), float(np.log(low)), float(np.log(high))
    return np.asarray((values - low) / ((high - low) or 1.0))


def _from_chord(u: NDArray[np.float64], v: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distances from the straight piece between the first and the last point."""
    along, up = u[-1] - u[0], v[-1] - v[0]
    length = along**2 + up**2
    du, dv = u - u[0], v - v[0]
    part = np.clip((du * along + dv * up) / length, 0.0, 1.0) if length else np.zeros_like(u)
    return np.asarray(np.hypot(du - part * along, dv - part * up))
