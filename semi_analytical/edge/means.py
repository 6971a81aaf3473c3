"""Cell means of a power of a linear function, cut off where it is negative, and their inverse.

Over the unit cell the mean of (f + f_x x + f_y y)_+^a is, with b, c the moduli of the slopes, the
second difference of F(s) = s_+^(a+2)/((a+1)(a+2) b c) over the corners f ± b/2 ± c/2.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
# One for all places, or of each.
Exponent = float | Field

# Below this part of the larger slope the smaller one is integrated by points, not by differences.
STRAIGHT = 1e-4
# So many times the sum of the slopes above zero the cell sees a smooth function.
DEEP = 3.0
POINTS, WEIGHTS = (half / 2 for half in np.polynomial.legendre.leggauss(4))
MOST_TURNS = 80
SETTLED = 1e-13


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
    straight = loaded & ~deep & (c < STRAIGHT * b)
    oblique = loaded & ~deep & ~straight
    for where, mean in ((deep, _smooth), (straight, _straight), (oblique, _oblique)):
        if np.any(where):
            result[where] = mean(f[where], b[where], c[where], _among(exponent, f.shape, where))
    return result


def power(base: Field, exponent: Exponent) -> Field:
    """base^exponent, shape of base; halves of whole numbers by roots, ten times as fast."""
    if np.ndim(exponent) or exponent < 0 or 2 * exponent % 1:
        return np.asarray(base**exponent)
    whole = int(exponent)
    if exponent == whole:
        return np.asarray(base**whole)
    return np.asarray(np.sqrt(base) * base**whole if whole else np.sqrt(base))


def _among(exponent: Exponent, shape: tuple[int, ...], where: NDArray[Any]) -> Exponent:
    """The exponents at some of the places; one for all remains a number."""
    return np.broadcast_to(exponent, shape)[where] if np.ndim(exponent) else exponent


def _smooth(f: Field, b: Field, c: Field, a: Exponent) -> Field:
    """By Gauss points."""
    total = np.zeros(f.shape)
    for x, weight_x in zip(POINTS, WEIGHTS, strict=True):
        for y, weight_y in zip(POINTS, WEIGHTS, strict=True):
            total += weight_x * weight_y * power(f + b * x + c * y, a)
    return total


def _straight(f: Field, b: Field, c: Field, a: Exponent) -> Field:
    """In closed form along the larger slope, by Gauss points across."""
    total = np.zeros(f.shape)
    for y, weight in zip(POINTS, WEIGHTS, strict=True):
        ends = [power(np.maximum(f + side * b / 2 + c * y, 0.0), a + 1) for side in (1, -1)]
        total += weight * (ends[0] - ends[1])
    return total / ((a + 1) * b)


def _oblique(f: Field, b: Field, c: Field, a: Exponent) -> Field:
    total = np.zeros(f.shape)
    for s in (1, -1):
        for t in (1, -1):
            total += s * t * power(np.maximum(f + s * b / 2 + t * c / 2, 0.0), a + 2)
    return total / ((a + 1) * (a + 2) * b * c)


def centre_value(mean: Field, f_x: Field, f_y: Field, exponent: Exponent) -> Field:
    """The f for which `mean_power` gives a mean, shape of mean.

    mean  of the power over the cell, positive
    By Newton's method on mean^(1/exponent), which is almost linear in f, between
    mean^(1/exponent) ± half the sum of the slopes.
    """
    shape = np.broadcast_shapes(mean.shape, f_x.shape, f_y.shape)
    mean, f_x, f_y = (np.broadcast_to(field, shape).ravel() for field in (mean, f_x, f_y))
    a = np.broadcast_to(exponent, shape).ravel() if np.ndim(exponent) else exponent
    target = power(mean, 1 / a)
    half = (np.abs(f_x) + np.abs(f_y)) / 2
    low, high, f = -half, target + half, target.copy()
    k = np.arange(f.size)
    for _ in range(MOST_TURNS):
        at, a_k = (f[k], f_x[k], f_y[k]), _among(a, f.shape, k)
        found, slope = mean_power(*at, a_k), mean_power(*at, a_k - 1)
        value = power(found, 1 / a_k)
        below = value < target[k]
        low[k] = np.where(below, f[k], low[k])
        high[k] = np.where(below, high[k], f[k])
        with np.errstate(divide="ignore", invalid="ignore"):
            newton = f[k] + (target[k] - value) / (value * slope / found)
        safe = (newton >= low[k]) & (newton <= high[k])
        step = np.where(safe, newton, (low[k] + high[k]) / 2) - f[k]
        f[k] += step
        k = k[np.abs(step) > SETTLED * (target[k] + np.abs(f_x[k]) + np.abs(f_y[k]))]
        if not len(k):
            break
    return f.reshape(shape)
