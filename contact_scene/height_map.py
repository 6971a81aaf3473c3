"""Interpolation of maps: smoothly of heights, within their bounds of other values."""

from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import BeforeValidator

from contact_scene.quantity import PositiveLength

# A coordinate this close to a map point (in spacings) is that point: grids that coincide but were
# computed by another formula differ by a few units of round-off.
_COINCIDES = 1e-9


def _one_for_both(value: Any) -> Any:
    return value if isinstance(value, list | tuple) else (value, value)


PairOfSpacings = Annotated[
    tuple[PositiveLength, PositiveLength],
    BeforeValidator(
        _one_for_both, json_schema_input_type=PositiveLength | tuple[PositiveLength, PositiveLength]
    ),
]


def interpolate(
    heights: NDArray[np.float64], spacing: tuple[float, float], x: ArrayLike, y: ArrayLike
) -> NDArray[np.float64]:
    """Heights between the points of a map, by cubic convolution (Keys 1981, IEEE ASSP 29, Eq. 15).

    heights  values at the centres of cells, (nx, ny), centred on the origin [length]
    spacing  distance of neighbouring values (dx, dy) [length]
    x, y     where [length], broadcast together; ValueError outside the cells of the map
    returns  heights [length], third-order accurate in the spacing, continuous slopes;
             the map's own values, unchanged, at its own points

    Values beyond the rim continue the map by parabolas, which keeps the third order there.
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    i, s = _locate(x, heights.shape[0], spacing[0], "x")
    j, t = _locate(y, heights.shape[1], spacing[1], "y")
    padded = _continued(_continued(heights).T).T
    across, along = _weights(s), _weights(t)
    result = np.zeros(x.shape)
    for k in range(4):
        for m in range(4):
            result += across[k] * along[m] * padded[i + k, j + m]
    return result


def interpolate_between(
    values: NDArray[np.float64], spacing: tuple[float, float], x: ArrayLike, y: ArrayLike
) -> NDArray[np.float64]:
    """As `interpolate`, linearly along x and y: nowhere above or below the neighbouring values,
    and as far as half a spacing beyond the outermost as these."""
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    i, s = _locate(x, values.shape[0], spacing[0], "x")
    j, t = _locate(y, values.shape[1], spacing[1], "y")
    padded = np.pad(values, 1, mode="edge")
    before, after = ((1 - t) * padded[k, j] + t * padded[k, j + 1] for k in (i, i + 1))
    return np.asarray((1 - s) * before + s * after)


def _locate(
    coordinate: NDArray[np.float64], count: int, spacing: float, axis: str
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Index of the map point at or before each coordinate (counted from the rim's first
    continued value) and the distance from it in spacings."""
    position = coordinate / spacing + 0.5 * (count - 1)
    nearest = np.rint(position)
    position = np.where(np.abs(position - nearest) <= _COINCIDES, nearest, position)
    inside = (position >= -0.5 - _COINCIDES) & (position <= count - 0.5 + _COINCIDES)
    if not np.all(inside):
        farthest, reach = float(np.max(np.abs(coordinate))), 0.5 * count * spacing
        raise ValueError(
            f"the map covers |{axis}| <= {reach:g} ({count} values, {spacing:g} apart), "
            f"but is asked for |{axis}| = {farthest:g}: "
            f"choose a window of at most {2 * reach:g} along {axis}"
        )
    index = np.floor(position)
    return index.astype(np.intp) + 1, position - index


def _continued(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rows with two more before the first and after the last, on parabolas through three."""
    first = 3.0 * rows[0] - 3.0 * rows[1] + rows[2]
    second = 3.0 * first - 3.0 * rows[0] + rows[1]
    last = 3.0 * rows[-1] - 3.0 * rows[-2] + rows[-3]
    after = 3.0 * last - 3.0 * rows[-1] + rows[-2]
    return np.concatenate([[second, first], rows, [last, after]])


def _weights(t: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    """Weights of the four neighbours, t in [0, 1] behind the second; (0, 1, 0, 0) at t = 0."""
    return (
        t * (-0.5 + t * (1.0 - 0.5 * t)),
        1.0 + t * t * (-2.5 + 1.5 * t),
        t * (0.5 + t * (2.0 - 1.5 * t)),
        t * t * (-0.5 + 0.5 * t),
    )
