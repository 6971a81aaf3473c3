"""Interpolation of maps: heights by limited cubic convolution, friction coefficients bilinearly.

Cubic convolution (Keys 1981, IEEE ASSP 29, Eq. 15) interpolates two values by a cubic that has the
slopes of central differences. Beside a flat this cubic is below the flat. The slopes are therefore
limited such that the cubic is monotone where the values are, and has an extremum between two values
only if the curvatures on both sides agree, as on a smooth tip (Huynh 1993, SIAM J. Numer. Anal. 30,
57).
"""

from functools import reduce
from typing import Annotated, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import BeforeValidator

from contact_scene.reading.quantity import PositiveLength

# Distance of a coordinate from a map point, in spacings, that is round-off of equal grids.
_COINCIDES = 1e-9

# Largest sum of the magnitudes of the negative weights of cubic convolution in two dimensions,
# 2 (9/8) (1/8) at the centre of four points.
_NEGATIVE_WEIGHTS = 9 / 32
# Values per block of rows; largest number of sampled patches in a block; number of patches with the
# lowest samples that are refined; number of refinements, each to a quarter of the width.
_BLOCK = 1 << 17
_MAX_PATCHES = 8192
_PATCHES = 64
_REFINEMENTS = 14
# Points that are interpolated at a time, each from 36 values: 5 MB.
_POINTS = 1 << 14

_SWEEPS = 20  # Jacobi iterations on every level


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
    """Determine if a value is the name of a unit alone, such as "um", instead of a quantity."""
    return isinstance(value, str) and value[:1].isalpha()


def fill_missing_heights(heights: NDArray[np.float64]) -> NDArray[np.float64]:
    """Replace the missing heights of a height map (NaN) by interpolated heights.

    The interpolated heights solve Laplace's equation, with the measured heights as boundary values.
    The error is about 1 % of the adjacent heights. The method is cascadic multigrid: a Jacobi
    iteration that starts from the solution on half the points along each side (Bornemann and
    Deuflhard 1996, Numer. Math. 75, 135). Every iterate is a mean of measured heights and not below
    the lowest of them.

    heights  measured heights, NaN where missing (nx, ny) [length]
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
    coarse = fill_missing_heights(sums / np.where(counts, counts, np.nan))
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
    """Interpolate a height map by limited cubic convolution, which is never below a flat.

    The result is the mean of two interpolations: first along x, then along y, and in reverse order.
    Between its outermost points and the border of their cells, the map is extrapolated by
    parabolas, so that the interpolation has the third order there as well.

    Parameters
    ----------
    heights : ndarray, shape (nx, ny)
        Values at the centres of cells, centred on the origin [length].
    spacing : tuple of float
        Distance between adjacent values along x and y [length].
    x, y : array_like
        Coordinates [length], broadcast together.

    Returns
    -------
    ndarray, shape of x + y
        Heights [length] of third order in the spacing; at the points of the map, its values bit for
        bit.

    Raises
    ------
    ValueError
        For coordinates outside the cells of the map.
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    i, s = _locate_between_points(x, heights.shape[0], spacing[0], "x")
    j, t = _locate_between_points(y, heights.shape[1], spacing[1], "y")
    return _interpolate_padded(_extrapolate_rows(_extrapolate_rows(heights).T).T, i, s, j, t)


def leave_out_every_second(
    heights: NDArray[np.float64], spacing: tuple[float, float]
) -> NDArray[np.float64]:
    """Replace every second row and column of a height map by values interpolated from the others.

    The difference from the map shows how well its points determine the surface between them.

    heights  heights at the points (nx, ny) [length]
    spacing  distance between adjacent points along x and y [length]
    """
    kept = heights[::2, ::2]
    x, y = (
        step * (np.arange(count) - (half - 1))
        for step, count, half in zip(spacing, heights.shape, kept.shape, strict=True)
    )
    return interpolate(kept, (2 * spacing[0], 2 * spacing[1]), x[:, None], y)


def lowest_point(heights: NDArray[np.float64]) -> tuple[float, tuple[float, float]]:
    """Find the minimum of the interpolated surface of a height map between its outermost points.

    The minimum is the point of first contact. The surface is that of `interpolate`. Beyond the
    outermost points the surface is extrapolated and therefore ignored. The search is by blocks of
    rows, without a copy of the map.

    heights  heights at the points, (nx, ny) [length]
    returns  minimum minus the lowest of the heights [length]; position of the minimum in indices of
             points
    """
    x = int(np.argmin(np.min(heights, axis=1)))  # argmin copies whole arrays that are read-only
    y = int(np.argmin(heights[x]))
    lowest, place, last = 0.0, (float(x), float(y)), len(heights) - 1
    count = max(1, _BLOCK // heights.shape[1])
    for begin in range(0, last, count):
        rows = _rows_with_neighbours(heights, begin, min(begin + count, last)) - heights[x, y]
        found, at = _lowest_between(rows, lowest)
        if found < lowest:
            lowest, place = found, (begin + at[0], at[1])
    return lowest, place


def _rows_with_neighbours(
    heights: NDArray[np.float64], begin: int, end: int
) -> NDArray[np.float64]:
    """Return rows of a height map with two more rows or columns on every side,
    extrapolated beyond the outermost points, for the interpolation between points."""
    first = max(begin - 3, 0)  # extrapolation takes three rows
    padded = _extrapolate_rows(_extrapolate_rows(heights[first : end + 4]).T).T
    return np.asarray(padded[begin - first + 1 : end - first + 6, 1:-1])


def _lowest_between(padded: NDArray[np.float64], limit: float) -> tuple[float, tuple[float, float]]:
    """Find the minimum of the interpolated surface of a height map, if it is below a limit.

    A patch is the surface between four adjacent points. The surface undershoots the lowest of the
    4 x 4 values around it by at most `_NEGATIVE_WEIGHTS` times their range: it undershoots less
    than cubic convolution, because limits only reduce slopes. This bound selects the patches that
    can be below the limit. The minimum of these patches is located on grids that shrink around it.

    padded   heights with two more values beyond the outermost points on every side [length]
    limit    value above which a minimum is ignored [length]
    returns  minimum, or the limit if no value is below it [length]; position in indices of points
    """
    last = np.array(padded.shape) - 5.0
    lowest, place, half = limit, np.zeros(2), 0.5
    centres = _patches_below(padded[1:-1, 1:-1], limit)
    for _ in range(_REFINEMENTS if len(centres) else 0):
        around = half * np.linspace(-1.0, 1.0, 9)
        x, y = (np.clip(centres[:, axis, None] + around, 0.0, last[axis]) for axis in (0, 1))
        x, y = np.broadcast_arrays(x[:, :, None], y[:, None, :])
        i, j = (
            np.minimum(np.floor(z), end - 1).astype(np.intp)
            for z, end in zip((x, y), last, strict=True)
        )
        values = _interpolate_padded(padded, i, x - i, j, y - j).reshape(len(x), -1)
        at = np.argmin(values, axis=1)
        best = np.argsort(values[np.arange(len(at)), at])[:_PATCHES]
        centres = np.stack([c.reshape(len(x), -1)[best, at[best]] for c in (x, y)], axis=1)
        if (found := float(values[best[0], at[best[0]]])) < lowest:
            lowest, place = found, centres[0]
        half /= 4
    return lowest, (float(place[0]), float(place[1]))


def _patches_below(padded: NDArray[np.float64], limit: float) -> NDArray[np.float64]:
    """Select patches of an interpolated height map that can contain values below a limit.

    A patch is the surface between four points. Its lower bound follows from the 4 x 4 values around
    it.

    padded   heights with one more value beyond the outermost points on every side [length]
    returns  centres of at most `_MAX_PATCHES` patches with the lowest bounds, in indices of points,
             (count, 2)
    """

    def extreme_of_four(extreme: np.ufunc, rows: NDArray[np.float64]) -> NDArray[np.float64]:
        along = reduce(extreme, (rows[k : len(rows) - 3 + k] for k in range(4))).T
        return np.asarray(reduce(extreme, (along[k : len(along) - 3 + k] for k in range(4))).T)

    least, most = extreme_of_four(np.minimum, padded), extreme_of_four(np.maximum, padded)
    bound = least - _NEGATIVE_WEIGHTS * (most - least)
    found = np.argwhere(bound < limit) + 0.5
    return np.asarray(found[np.argsort(bound[bound < limit])[:_MAX_PATCHES]])


def _interpolate_padded(
    padded: NDArray[np.float64],
    i: NDArray[np.intp],
    s: NDArray[np.float64],
    j: NDArray[np.intp],
    t: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Interpolate a height map at given points, from 6 x 6 values each.

    padded  heights with added rows and columns on every side
    i, j    indices of the first of the six values along each axis, in the padded map
    s, t    distances of the points from the third value, in spacings of the map
    """
    result, six = np.empty(s.shape), np.arange(6)
    i, j, s, t = i.ravel(), j.ravel(), s.ravel(), t.ravel()
    for begin in range(0, len(s), _POINTS):
        at = slice(begin, begin + _POINTS)
        values = padded[i[at] + six[:, None, None], j[at] + six[:, None]]
        x_first = interpolate_middle(interpolate_middle(values, s[at]), t[at])
        y_first = interpolate_middle(interpolate_middle(values.swapaxes(0, 1), t[at]), s[at])
        result.flat[at] = 0.5 * (x_first + y_first)
    return result


def interpolate_middle(values: NDArray[np.float64], t: NDArray[np.float64]) -> NDArray[np.float64]:
    """Interpolate between the middle two of six equally spaced values by a limited cubic.

    values  six values (6, …)
    t       distances of the points from the third value, in spacings, from 0 to 1 (…)
    """
    rise = np.diff(values, axis=0)
    bend = np.diff(rise, axis=0)
    turn = 0.5 * nearer_to_zero(bend[:-1], bend[1:])  # in the three intervals between inner values
    central = 0.5 * (rise[1:3] + rise[2:4])
    parabolas = rise[1:3] + turn[:2], rise[2:4] - turn[1:]
    start, end = limited_slope(central, rise[1:3], rise[2:4], *parabolas)
    return interpolate_cubic(values[2], rise[2], start, end, t)


def interpolate_cubic(
    value: NDArray[np.float64],
    rise: NDArray[np.float64],
    start: NDArray[np.float64],
    end: NDArray[np.float64],
    t: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Evaluate a cubic from its values and slopes at both ends (Hermite).

    value, rise  value at the start, and difference of the values
    start, end   slopes at the start and the end, per interval
    t            fraction of the interval, from 0 to 1
    """
    back = 1.0 - t
    return np.asarray(value + t * t * (3.0 - 2.0 * t) * rise + t * back * (back * start - t * end))


def limited_slope(
    central: NDArray[np.float64],
    before: NDArray[np.float64],
    after: NDArray[np.float64],
    parabola_before: NDArray[np.float64],
    parabola_after: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Limit the slope at a value of a map such that its interpolation preserves the shape.

    The limits are 0, three times the smaller of the adjacent mean slopes, and 3/2 of the smaller
    of the slopes of two parabolas through the ends of the adjacent intervals (Huynh 1993). The
    curvature of a parabola is the smaller one at the ends of its interval, and 0 if their signs
    differ.

    central                          slope without limit
    before, after                    mean slopes of the adjacent intervals
    parabola_before, parabola_after  slopes of the parabolas at the value
    """
    monotone = 3.0 * nearer_to_zero(before, after)
    smooth = 1.5 * nearer_to_zero(parabola_before, parabola_after)
    least = np.minimum(0.0, np.minimum(monotone, smooth))
    most = np.maximum(0.0, np.maximum(monotone, smooth))
    return np.clip(central, least, most)


def nearer_to_zero(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the number of smaller magnitude of two, or 0 if their signs differ (minmod)."""
    return np.asarray(0.5 * (np.sign(a) + np.sign(b)) * np.minimum(np.abs(a), np.abs(b)))


def interpolate_between(
    values: NDArray[np.float64], spacing: tuple[float, float], x: ArrayLike, y: ArrayLike
) -> NDArray[np.float64]:
    """Interpolate a map bilinearly, within the range of the adjacent values.

    Used for coefficients of friction, which must not become negative. Values are constant up to
    half a spacing beyond the outermost points.

    values   values at the centres of cells, (nx, ny), centred on the origin
    spacing  distance between adjacent values along x and y [length]
    x, y     coordinates [length], broadcast together

    Raises ValueError for coordinates outside the cells of the map.
    """
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    i, s = _locate_between_points(x, values.shape[0], spacing[0], "x")
    j, t = _locate_between_points(y, values.shape[1], spacing[1], "y")
    padded = np.pad(values, 1, mode="edge")
    before, after = ((1 - t) * padded[k, j] + t * padded[k, j + 1] for k in (i, i + 1))
    return np.asarray((1 - s) * before + s * after)


def _locate_between_points(
    coordinate: NDArray[np.float64], count: int, spacing: float, axis: str
) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Determine the position of coordinates between the points of a map along one axis.

    The map contains heights or coefficients of friction. Used to interpolate between its points.

    coordinate  coordinates relative to the centre of the map [length]
    count       number of points of the map along the axis
    spacing     distance between adjacent points [length]
    axis        name of the axis, for the message
    returns     index of the point at or before each coordinate, plus 1; distance of the coordinate
                from this point, in spacings

    Raises ValueError for coordinates outside the map.
    """
    position = coordinate / spacing + 0.5 * (count - 1)
    nearest = np.rint(position)
    position = np.where(np.abs(position - nearest) <= _COINCIDES, nearest, position)
    inside = (position >= -0.5 - _COINCIDES) & (position <= count - 0.5 + _COINCIDES)
    if not np.all(inside):
        farthest, reach = float(np.max(np.abs(coordinate))), 0.5 * count * spacing
        raise ValueError(
            f"the map covers |{axis}| <= {reach:g} ({count} values, {spacing:g} apart), but the "
            f"point requested is |{axis}| = {farthest:g}: use a window of at most {2 * reach:g} "
            f"along {axis}"
        )
    index = np.floor(position)
    return index.astype(np.intp) + 1, position - index


def _extrapolate_rows(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Extrapolate heights (n, m) beyond the outermost rows (n + 6, m), for the interpolation.

    The extrapolation in each column is a parabola through three rows, and a line if there are two
    rows.
    """
    before, after = ([*each] for each in (rows[2::-1], rows[-3:]))
    for outwards in (before, after):
        if len(outwards) == 2:
            outwards.insert(0, 2.0 * outwards[0] - outwards[1])
        for _ in range(3):
            outwards.append(3.0 * outwards[-1] - 3.0 * outwards[-2] + outwards[-3])
    return np.concatenate([before[:-4:-1], rows, after[-3:]])
