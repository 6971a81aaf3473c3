"""Cell means of a power of the positive part of a linear function, and their inverse.

The mean of (f + f_x x + f_y y)_+^a over the unit cell is the second difference of F(s) =
s_+^(a+2)/((a+1)(a+2) b c) over the corners f ± b/2 ± c/2, with b = |f_x|, c = |f_y|. The edge
correction computes the mean pressure of partly covered cells by this formula.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field

# One exponent for all places, or one per place.
Exponent = float | Field

# Ratio of the slopes below which Gauss points replace the difference along the smaller one.
STRAIGHT = 1e-4
# Value at the centre over the sum of the slopes above which the binomial series is used.
DEEP = 3.0
POINTS, WEIGHTS = (half / 2 for half in np.polynomial.legendre.leggauss(4))
# Positions of the four corners of a cell along the larger and the smaller slope.
HALVES = np.array([[1, -1, 1, -1], [1, -1, -1, 1]])[..., None] / 2
MAX_NEWTON_STEPS = 80
# From an error of at most 2e-3 these steps reach that of the series, 1e-9 for deep cells.
FIXED_POINT_STEPS = 3
# Relative Newton step at which the iteration stops; convergence is quadratic.
SETTLED = 1e-3


def mean_power(f: Field, f_x: Field, f_y: Field, exponent: Exponent) -> Field:
    """Compute the mean of (f + f_x x + f_y y)_+^exponent over a unit cell, shape of f.

    The subscript + sets negative values to zero. The mean pressure of a cell that the contact edge
    cuts is such a mean. The derivative with respect to f is exponent * mean_power(…, exponent - 1).

    f         value of the linear function at the cell centre
    f_x, f_y  slopes: change of the function across a cell
    exponent  above -1; with 0 the mean is the fraction of the cell with a positive function
    """
    f, f_x, f_y, _ = np.broadcast_arrays(f, f_x, f_y, exponent)
    b, c = np.maximum(np.abs(f_x), np.abs(f_y)), np.minimum(np.abs(f_x), np.abs(f_y))
    result = np.zeros(f.shape)
    loaded = f > -(b + c) / 2
    deep = loaded & (f > DEEP * (b + c))
    cut = loaded & ~deep
    for where, mean in ((deep, mean_of_smooth), (cut, mean_of_cut)):
        if np.any(where):
            a = _select_exponents(exponent, f.shape, where)
            result[where] = mean(f[where], b[where], c[where], a)
    return result


def power(base: Field, exponent: Exponent) -> Field:
    """Compute base^exponent element by element, by square roots for multiples of 1/2.

    Square roots and products are faster than a general power.
    """
    if isinstance(exponent, np.ndarray) or exponent < 0 or 2 * exponent % 1:
        return np.asarray(base**exponent)
    whole = int(exponent)
    if exponent == whole:
        return np.asarray(base**whole)
    return np.asarray(np.sqrt(base) * base**whole if whole else np.sqrt(base))


def _select_exponents(exponent: Exponent, shape: tuple[int, ...], where: NDArray[Any]) -> Exponent:
    return np.broadcast_to(exponent, shape)[where] if np.ndim(exponent) else exponent


def mean_of_smooth(f: Field, f_x: Field, f_y: Field, a: Exponent) -> Field:
    """Compute the mean of (f + f_x x + f_y y)^a over unit cells in which the function is positive.

    The binomial series has an error of 3e-7 if f is at least 1.5 times the sum of the slopes.

    f         value of the linear function at the cell centre
    f_x, f_y  slopes: change of the function across a cell
    a         exponent
    """
    mean = _sum_series(1 / f**2, *_series_terms(f_x, f_y, a))
    mean *= power(f, a)
    return mean


def mean_of_cut(f: Field, f_x: Field, f_y: Field, a: Exponent) -> Field:
    """Compute the mean of (f + f_x x + f_y y)_+^a over unit cells that the zero line may cut.

    Negative values of the function count as zero. All arrays have the shape (n,).

    f         value of the linear function at the cell centre: between minus half and a few times
              the sum of the slopes
    f_x, f_y  slopes: change of the function across a cell, not negative
    a         exponent
    """
    return _cut_with_slope(f, np.maximum(f_x, f_y), np.minimum(f_x, f_y), a)[0]


def _series_terms(b: Field, c: Field, a: Exponent) -> tuple[Field, Field, Field]:
    """Return the coefficients of 1/f², 1/f⁴ and 1/f⁶ in the cell mean of (f + b x + c y)^a over
    f^a.

    The mean over the unit cell is a binomial series, with the means of powers of b x + c y.

    b, c  slopes of the linear function: change across a cell
    a     exponent
    """
    b, c = b * b, c * c
    total, product = b + c, b * c
    square = total * total
    second = a * (a - 1) / 2
    fourth = second * (a - 2) * (a - 3) / 12
    sixth = fourth * (a - 4) * (a - 5) / 30
    return (
        np.asarray(second / 12 * total),
        np.asarray(fourth / 80 * (square + 4 / 3 * product)),
        np.asarray(sixth / 448 * total * (square + 4 * product)),
    )


def _sum_series(inverse: Field, second: Field, fourth: Field, sixth: Field) -> Field:
    """Sum 1 + second/f² + fourth/f⁴ + sixth/f⁶, with `inverse` 1/f²:
    the mean of (f + b x + c y)^a over f^a."""
    total = inverse * sixth
    for term in (fourth, second):
        total += term
        total *= inverse
    total += 1
    return np.asarray(total)


def _cut_with_slope(f: Field, b: Field, c: Field, a: Exponent) -> tuple[Field, Field]:
    """Compute the mean of (f + b x + c y)_+^a over unit cells and its f-derivative (n,).

    f     value of the linear function at the cell centre; its zero line may cut the cell
    b, c  larger and smaller slope, not negative
    """
    straight = c < STRAIGHT * b
    if not np.any(straight):
        return _oblique_means(f, b, c, a)
    found = np.empty((2, len(f)))
    for where, means in ((straight, _straight_means), (~straight, _oblique_means)):
        found[:, where] = means(f[where], b[where], c[where], _select_exponents(a, f.shape, where))
    return found[0], found[1]


def _straight_means(f: Field, b: Field, c: Field, a: Exponent) -> tuple[Field, Field]:
    """Compute the mean of (f + b x + c y)_+^a over unit cells and its f-derivative (n,).

    The slope c is small, so that the zero line is almost parallel to a cell side. The integral
    along the larger slope b has a closed form. Gauss points are used along c.
    """
    mean, slope = np.zeros(f.shape), np.zeros(f.shape)
    for y, weight in zip(POINTS, WEIGHTS, strict=True):
        for side in (1, -1):
            s = np.maximum(f + side * b / 2 + c * y, 0.0)
            end = weight * side * power(s, a + 1)
            mean += end
            slope += end / np.where(s > 0, s, 1.0)
    return mean / ((a + 1) * b), slope / b


def _oblique_means(f: Field, b: Field, c: Field, a: Exponent) -> tuple[Field, Field]:
    """Compute the mean of (f + b x + c y)_+^a over unit cells and its f-derivative (n,),
    as a second difference over the corners. It requires a slope c that is not small."""
    corners = np.maximum(f + (HALVES[0] * b + HALVES[1] * c), 0.0)
    of_corners, divisor = power(corners, a + 1), (a + 1) * (b * c)
    slope = _corner_differences(of_corners) / divisor
    of_corners *= corners
    return _corner_differences(of_corners) / ((a + 2) * divisor), slope


def _corner_differences(corners: Field) -> Field:
    return np.asarray(corners[0] + corners[1] - (corners[2] + corners[3]))


def centre_value(
    mean: Field, f_x: Field, f_y: Field, exponent: Exponent, near: Field | None = None
) -> Field:
    """Compute the centre value f of a linear function from the mean of its power over a unit cell.

    This function is the inverse of `mean_power`. The edge correction computes φ = p^(1/α) at the
    cell centre from the mean pressure p in this way. The result (n,) differs from mean^(1/exponent)
    by at most half the sum of the slopes.

    mean      mean of (f + f_x x + f_y y)_+^exponent over the cell, positive
    f_x, f_y  slopes: change of the function across a cell
    exponent  exponent α of the power
    near      initial guess of f for cells that the zero line may cut
    """
    f_x, f_y = np.abs(f_x), np.abs(f_y)
    b, c = np.maximum(f_x, f_y), np.minimum(f_x, f_y)
    f = power(mean, np.divide(1, exponent))
    deep = f > DEEP * (b + c)
    slopes, a = (b[deep], c[deep]), _select_exponents(exponent, f.shape, deep)
    f[deep] = _smooth_centre(f[deep], *slopes, a)
    cut, a = ~deep, _select_exponents(exponent, f.shape, ~deep)
    f[cut] = _cut_centre(f[cut], b[cut], c[cut], a, None if near is None else near[cut])
    return f


def _smooth_centre(target: Field, b: Field, c: Field, a: Exponent) -> Field:
    """Solve mean^(1/a) = target for f: the mean of (f + b x + c y)^a over a cell
    without a zero line. Each fixed-point iteration divides the error by 200."""
    f, terms = target, _series_terms(b, c, a)
    for _ in range(FIXED_POINT_STEPS):
        f = target / power(_sum_series(1 / f**2, *terms), np.divide(1, a))
    return f


def _initial_centre(target: Field, b: Field, c: Field, a: Exponent) -> Field:
    """Return a guess of f from mean^(1/a) of (f + b x + c y)_+^a:
    exact if one corner is positive, without the smaller slope if two are, else without slopes."""
    mean = (a + 1) * b * power(target, a)
    corner, side = power((a + 2) * c * mean, 1 / (a + 2)), power(mean, 1 / (a + 1))
    f = np.where(side <= b, side - b / 2, target)
    return np.asarray(np.where(corner < c, corner - (b + c) / 2, f))


def _cut_centre(target: Field, b: Field, c: Field, a: Exponent, near: Field | None) -> Field:
    """Compute the centre value f of a linear function from the cell mean of its power, in cut
    cells.

    The zero line of the function f + b x + c y may cut the cell. The equation mean^(1/a) = target
    is almost linear in f. Newton's method is safeguarded by bisection.

    target  given value of mean^(1/a), with the mean of (f + b x + c y)_+^a over the cell
    b, c    larger and smaller slope, not negative
    a       exponent
    near    initial guess of f; None if unknown
    """
    half = (b + c) / 2
    low, high = -half, target + half
    f = (
        _initial_centre(target, b, c, a)
        if near is None
        else np.minimum(np.maximum(near, low), high)
    )
    inverse, limit = np.divide(1, a), SETTLED * (target + half)
    with np.errstate(divide="ignore", invalid="ignore"):
        for _ in range(MAX_NEWTON_STEPS):
            found, slope = _cut_with_slope(f, b, c, a)
            value = power(found, inverse)
            residual = target - value
            below = residual > 0
            low, high = np.where(below, f, low), np.where(below, high, f)
            newton = f + residual * a * found / (value * slope)
            last, f = f, np.where((newton >= low) & (newton <= high), newton, (low + high) / 2)
            if np.all(np.abs(f - last) <= limit):
                break
    return f
