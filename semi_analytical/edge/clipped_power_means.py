"""Cell means of a power of a linear function, cut off where it is negative, and their inverse.

Over the unit cell the mean of (f + f_x x + f_y y)_+^a is, with b, c the moduli of the slopes, the
second difference of F(s) = s_+^(a+2)/((a+1)(a+2) b c) over the corners f ± b/2 ± c/2.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field

# One for all places, or of each.
Exponent = float | Field

# Below this part of the larger slope the smaller one is integrated by points, not by differences.
STRAIGHT = 1e-4
# So many times the sum of the slopes above zero the cell sees a smooth function.
DEEP = 3.0
POINTS, WEIGHTS = (half / 2 for half in np.polynomial.legendre.leggauss(4))
MAX_TURNS = 80
SMOOTH_TURNS = 5
# The next turn would leave its square.
SETTLED = 1e-3


def mean_power(f: Field, f_x: Field, f_y: Field, exponent: Exponent) -> Field:
    """Mean over a cell of (f + f_x x + f_y y)_+^exponent, shape of f.

    f         value at the centre
    f_x, f_y  slopes per cell
    exponent  above -1; 0 gives the part of the cell where the function is positive, and
              a mean_power(…, a - 1) is the derivative of mean_power(…, a) with respect to f
    """
    f, f_x, f_y, _ = np.broadcast_arrays(f, f_x, f_y, exponent)
    b, c = np.maximum(np.abs(f_x), np.abs(f_y)), np.minimum(np.abs(f_x), np.abs(f_y))
    result = np.zeros(f.shape)
    loaded = f > -(b + c) / 2
    deep = loaded & (f > DEEP * (b + c))
    cut = loaded & ~deep
    for where, mean in ((deep, mean_of_smooth), (cut, _cut)):
        if np.any(where):
            a = _among(exponent, f.shape, where)
            result[where] = mean(f[where], b[where], c[where], a)
    return result


def power(base: Field, exponent: Exponent) -> Field:
    """base^exponent, shape of base; halves of whole numbers by roots, ten times as fast."""
    if isinstance(exponent, np.ndarray) or exponent < 0 or 2 * exponent % 1:
        return np.asarray(base**exponent)
    whole = int(exponent)
    if exponent == whole:
        return np.asarray(base**whole)
    return np.asarray(np.sqrt(base) * base**whole if whole else np.sqrt(base))


def _among(exponent: Exponent, shape: tuple[int, ...], where: NDArray[Any]) -> Exponent:
    """The exponents at some of the places; one for all remains a number."""
    return np.broadcast_to(exponent, shape)[where] if np.ndim(exponent) else exponent


def mean_of_smooth(f: Field, f_x: Field, f_y: Field, a: Exponent) -> Field:
    """`mean_power` where f is at least 1.5 times the sum of the slopes, to 3e-7."""
    mean = _series(1 / f**2, *_bends(f_x, f_y, a))
    mean *= power(f, a)
    return mean


def mean_of_cut(f: Field, f_x: Field, f_y: Field, a: Exponent) -> Field:
    """`mean_power` where f is above minus half of the sum of the slopes and less than a few of
    them, all of shape (n,); the slopes are not negative."""
    return _cut(f, np.maximum(f_x, f_y), np.minimum(f_x, f_y), a)


def _bends(b: Field, c: Field, a: Exponent) -> tuple[Field, Field, Field]:
    """Of 1/f² to 1/f⁶ in the mean of (f + b x + c y)^a over f^a: the binomial series with the means
    of (b x + c y) to the second, fourth and sixth."""
    b, c = b**2, c**2
    second = a * (a - 1) / 2
    fourth = second * (a - 2) * (a - 3) / 12
    sixth = fourth * (a - 4) * (a - 5) / 30
    return (
        np.asarray(second * (b + c) / 12),
        np.asarray(fourth * ((b**2 + c**2) / 80 + b * c / 24)),
        np.asarray(sixth * ((b**3 + c**3) / 448 + b * c * (b + c) / 64)),
    )


def _series(inverse: Field, second: Field, fourth: Field, sixth: Field) -> Field:
    """inverse  1/f²"""
    total = inverse * sixth
    for term in (fourth, second):
        total += term
        total *= inverse
    total += 1
    return np.asarray(total)


def _cut(f: Field, b: Field, c: Field, a: Exponent) -> Field:
    return _cut_with_slope(f, b, c, a)[0]


def _cut_with_slope(f: Field, b: Field, c: Field, a: Exponent) -> tuple[Field, Field]:
    """The mean and its derivative with respect to f, where the cell may be cut, shape (n,)."""
    straight = c < STRAIGHT * b
    if not np.any(straight):
        return _oblique(f, b, c, a)
    found = np.empty((2, len(f)))
    for where, means in ((straight, _straight), (~straight, _oblique)):
        found[:, where] = means(f[where], b[where], c[where], _among(a, f.shape, where))
    return found[0], found[1]


def _straight(f: Field, b: Field, c: Field, a: Exponent) -> tuple[Field, Field]:
    """In closed form along the larger slope, by Gauss points across."""
    mean, slope = np.zeros(f.shape), np.zeros(f.shape)
    for y, weight in zip(POINTS, WEIGHTS, strict=True):
        for side in (1, -1):
            s = np.maximum(f + side * b / 2 + c * y, 0.0)
            end = weight * side * power(s, a + 1)
            mean += end
            slope += end / np.where(s > 0, s, 1.0)
    return mean / ((a + 1) * b), slope / b


def _oblique(f: Field, b: Field, c: Field, a: Exponent) -> tuple[Field, Field]:
    outer, inner = (b + c) / 2, (b - c) / 2
    # Those of which two are added, and those of which two are taken away.
    corners = np.maximum(np.array([f + outer, f - outer, f + inner, f - inner]), 0.0)
    of_corners = power(corners, a + 1)
    slope = _differences(of_corners) / ((a + 1) * b * c)
    of_corners *= corners
    return _differences(of_corners) / ((a + 1) * (a + 2) * b * c), slope


def _differences(corners: Field) -> Field:
    return np.asarray(corners[0] + corners[1] - (corners[2] + corners[3]))


def centre_value(
    mean: Field, f_x: Field, f_y: Field, exponent: Exponent, near: Field | None = None
) -> Field:
    """The f for which `mean_power` gives a mean, all of one shape (n,).

    mean  of the power over the cell, positive
    near  values about which to look where the cell may be cut; None where nothing is known
    Between mean^(1/exponent) ± half the sum of the slopes.
    """
    f_x, f_y = np.abs(f_x), np.abs(f_y)
    b, c = np.maximum(f_x, f_y), np.minimum(f_x, f_y)
    f = power(mean, np.divide(1, exponent))
    deep = f > DEEP * (b + c)
    for where, inverse in ((deep, _smooth_centre), (~deep, _cut_centre)):
        about = None if near is None else near[where]
        f[where] = inverse(f[where], b[where], c[where], _among(exponent, f.shape, where), about)
    return f


def _smooth_centre(target: Field, b: Field, c: Field, a: Exponent, near: Field | None) -> Field:
    """By iterations, each of which leaves a two-hundredth of the error: no value near the result
    is needed."""
    f, terms = target, _bends(b, c, a)
    for _ in range(SMOOTH_TURNS):
        f = target / power(_series(1 / f**2, *terms), np.divide(1, a))
    return f


def _first_centre(target: Field, b: Field, c: Field, a: Exponent) -> Field:
    """Near the f that is asked for: where the edge cuts off a corner, exactly; where it cuts off
    two, by the larger slope alone; else the value without slopes."""
    mean = (a + 1) * b * power(target, a)
    corner, side = power((a + 2) * c * mean, 1 / (a + 2)), power(mean, 1 / (a + 1))
    f = np.where(side <= b, side - b / 2, target)
    return np.asarray(np.where(corner < c, corner - (b + c) / 2, f))


def _cut_centre(target: Field, b: Field, c: Field, a: Exponent, near: Field | None) -> Field:
    """By Newton's method on mean^(1/a), which is almost linear in f.

    target  mean^(1/a)
    """
    half = (b + c) / 2
    low, high = -half, target + half
    f = _first_centre(target, b, c, a) if near is None else np.clip(near, low, high)
    for _ in range(MAX_TURNS):
        found, slope = _cut_with_slope(f, b, c, a)
        value = power(found, np.divide(1, a))
        missing = target - value
        low, high = np.where(missing > 0, f, low), np.where(missing > 0, high, f)
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = f + missing * a * found / (value * slope)
        last, f = f, np.where((newton >= low) & (newton <= high), newton, (low + high) / 2)
        if np.all(np.abs(f - last) <= SETTLED * (target + half)):
            break
    return f
