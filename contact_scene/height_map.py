"""Interpolation of maps: smoothly of heights, within their bounds of other values."""

from functools import reduce
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import BeforeValidator

from contact_scene.reading.quantity import PositiveLength

# A coordinate this close to a map point (in spacings) is that point: grids that coincide but were
# computed by another formula differ by a few units of round-off.
_COINCIDES = 1e-9

# Sum of the magnitudes of the negative weights of cubic convolution in two dimensions, at most: at
# the centre of four points it is 2 (9/8) (1/8).
_NEGATIVE_WEIGHTS = 9 / 32
# Values whose rows are searched at once; patches of them that are searched; those with the lowest
# samples, whose minimum is refined; refinements, each to a quarter of the width.
_BLOCK, _MOST_PATCHES, _PATCHES, _REFINEMENTS = 1 << 17, 8192, 64, 14

_SWEEPS = 20  # of the Jacobi iteration, on every level


def _one_for_both(value: Any) -> Any:
    return value if isinstance(value, list | tuple) else (value, value)


PairOfSpacings = Annotated[
    tuple[PositiveLength, PositiveLength],
    BeforeValidator(
        _one_for_both, json_schema_input_type=PositiveLength | tuple[PositiveLength, PositiveLength]
    ),
]
HeightUnit = Annotated[
    PositiveLength,
    BeforeValidator(lambda value: f"1 {value}" if _is_name(value) else value),
]


def _is_name(value: Any) -> bool:
    """Whether a unit is given by its name alone."""
    return isinstance(value, str) and value[:1].isalpha()


def filled(heights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Replace NaN by a solution of Laplace's equation, to about 1 % of the heights around.

    Cascadic multigrid: Jacobi iteration from the solution on half the points along each side
    (Bornemann and Deuflhard 1996, Numer. Math. 75, 135). Every iterate is a mean of measured
    heights: none is lower than the lowest of these.
    """
    known = np.isfinite(heights)
    if np.all(known):
        return heights
    nx, ny = heights.shape
    sums, counts = (
        np.pad(one, ((0, nx % 2), (0, ny % 2)))
        .reshape((nx + 1) // 2, 2, (ny + 1) // 2, 2)
        .sum(axis=(1, 3))
        for one in (np.where(known, heights, 0.0), known)
    )
    coarse = filled(sums / np.where(counts, counts, np.nan))
    found = np.where(known, heights, coarse.repeat(2, axis=0).repeat(2, axis=1)[:nx, :ny])
    i, j = np.nonzero(~known)
    around = [
        np.ravel_multi_index((i + di, j + dj), (nx, ny), mode="clip")
        for di, dj in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))
    ]
    for _ in range(_SWEEPS):
        found.ravel()[around[0]] = np.mean([found.take(at) for at in around], axis=0)
    return found


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
    return _convolved(_continued(_continued(heights).T).T, i, s, j, t)


def lowest_point(heights: NDArray[np.float64]) -> tuple[float, tuple[float, float]]:
    """Minimum of the surface that `interpolate` defines between the outermost points of a map.

    heights  values at the points, (nx, ny) [length]
    returns  the minimum, counted from the lowest value [length]; its position, in indices of points

    Values beyond the outermost points are extrapolated and do not decide on first contact. The map
    is searched by blocks of rows, so that a large one is not copied.
    """
    x = int(np.argmin(np.min(heights, axis=1)))  # argmin copies whole arrays that are read-only
    y = int(np.argmin(heights[x]))
    lowest, place, last = 0.0, (float(x), float(y)), len(heights) - 1
    count = max(1, _BLOCK // heights.shape[1])
    for begin in range(0, last, count):
        rows = _with_neighbours(heights, begin, min(begin + count, last)) - heights[x, y]
        found, at = _lowest_between(rows, lowest)
        if found < lowest:
            lowest, place = found, (begin + at[0], at[1])
    return lowest, place


def _with_neighbours(heights: NDArray[np.float64], begin: int, end: int) -> NDArray[np.float64]:
    """Rows of a map from `begin` to `end` with one more on each side, and columns likewise; those
    beyond the outermost are extrapolated."""
    first = max(begin - 3, 0)  # extrapolation takes three rows
    padded = _continued(_continued(heights[first : end + 4]).T).T
    return np.asarray(padded[begin - first + 1 : end - first + 4, 1:-1])


def _lowest_between(padded: NDArray[np.float64], limit: float) -> tuple[float, tuple[float, float]]:
    """Minimum of the surface between points and its position, where it lies below a limit; else
    the limit.

    padded  with one value beyond the outermost points

    Cubic convolution undershoots its 16 values by their range times `_NEGATIVE_WEIGHTS` at most.
    This bound selects the patches that can lie below the limit; their minimum is found on grids
    that shrink around it.
    """
    last = np.array(padded.shape) - 3.0
    lowest, place, half = limit, np.zeros(2), 0.5
    centres = _patches_below(padded, limit)
    for _ in range(_REFINEMENTS if len(centres) else 0):
        around = half * np.linspace(-1.0, 1.0, 9)
        x, y = (np.clip(centres[:, axis, None] + around, 0.0, last[axis]) for axis in (0, 1))
        x, y = np.broadcast_arrays(x[:, :, None], y[:, None, :])
        i, j = (
            np.minimum(np.floor(z), end - 1).astype(np.intp)
            for z, end in zip((x, y), last, strict=True)
        )
        values = _convolved(padded, i, x - i, j, y - j).reshape(len(x), -1)
        at = np.argmin(values, axis=1)
        best = np.argsort(values[np.arange(len(at)), at])[:_PATCHES]
        centres = np.stack([c.reshape(len(x), -1)[best, at[best]] for c in (x, y)], axis=1)
        if (found := float(values[best[0], at[best[0]]])) < lowest:
            lowest, place = found, centres[0]
        half /= 4
    return lowest, (float(place[0]), float(place[1]))


def _patches_below(padded: NDArray[np.float64], limit: float) -> NDArray[np.float64]:
    """Centres of the patches between points whose bound lies below a limit, (count, 2), in indices
    of points; of more than `_MOST_PATCHES` those with the lowest bounds.

    padded  with one value beyond the outermost points
    """

    def of_four(extreme: np.ufunc, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        along = reduce(extreme, (rows[k : len(rows) - 3 + k] for k in range(4))).T
        return np.asarray(reduce(extreme, (along[k : len(along) - 3 + k] for k in range(4))).T)

    least, most = of_four(np.minimum, padded), of_four(np.maximum, padded)
    bound = least - _NEGATIVE_WEIGHTS * (most - least)
    found = np.argwhere(bound < limit) + 0.5
    return np.asarray(found[np.argsort(bound[bound < limit])[:_MOST_PATCHES]])


def _convolved(
    padded: NDArray[np.float64],
    i: NDArray[np.intp],
    s: NDArray[np.float64],
    j: NDArray[np.intp],
    t: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Cubic convolution at the distances s and t behind the second of four padded values, the first
    of which has the indices i and j."""
    across, along = _weights(s), _weights(t)
    result = np.zeros(np.broadcast_shapes(s.shape, t.shape))
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
