"""Compound recursion of the surface compliance through one layer, without overflow or cancellation.

The material below a depth is represented by the symmetric 2x2 compliance C between the displacement
(U, u_z) and the traction (Q, p) in the plane of the wave vector and z. The recursion propagates y =
(det C, C11, C12, C22, 1) times a scale (second compounds or delta matrices, Dunkin 1965). It
contains no differences of exponentials. The terms sinh x cosh x - x and sinh^2 x - x^2, which
vanish for thin layers, are computed by series.
"""

from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Array

# Upper bound of alpha h. The underside of a layer has no effect on its top from 373 on, where
# exp(-2x) = 0 in double precision. The bound prevents x exp(-2x) = inf * 0.
OPAQUE = 1e4


class Waves(NamedTuple):
    """Hyperbolic functions of x in a layer, multiplied by one scale, for the compound recursion.

    x is the wavenumber times the thickness of the layer. With the scale exp(-2x) the functions are
    bounded for every x. The names of the fields are the functions; `one` is the scale and `xx` is
    x² times the scale.
    """

    one: Array
    x: Array
    xx: Array
    sinh2: Array  # sinh^2 x
    cosh_sinh_plus_x: Array  # sinh x cosh x + x
    cosh_sinh_minus_x: Array
    sinh2_minus_xx: Array


def decaying_waves(x: Array) -> Waves:
    """Compute the hyperbolic functions of a layer times exp(-2x), accurately for all x >= 0.

    The functions occur in the recursion of the surface compliance. The scale exp(-2x) prevents
    overflow for thick layers.

    x  wavenumber times thickness of the layer
    """
    w = np.exp(-2 * x)
    s = np.expm1(-2 * x) ** 2 / 4
    c = -np.expm1(-4 * x) / 4
    thin = x < 1
    c_minus_x, s_minus_xx = c - x * w, s - x * x * w
    series_c, series_s = _thin_series(x[thin])
    c_minus_x[thin] = series_c * w[thin]
    s_minus_xx[thin] = series_s * w[thin]
    return Waves(w, x * w, x * x * w, s, c + x * w, c_minus_x, s_minus_xx)


def _thin_series(x: Array) -> tuple[Array, Array]:
    """Compute sinh x cosh x - x and sinh^2 x - x^2 for x < 1 by series, truncated at 1e-17.

    For thin layers the closed forms would cancel.

    x  wavenumber times thickness of the layer
    """
    z = 4 * x * x
    c = np.zeros_like(x)
    s = np.zeros_like(x)
    for k in range(12, 0, -1):
        c = (1 + c) * z / ((2 * k) * (2 * k + 1))
        s = (1 + s) * z / ((2 * k + 1) * (2 * k + 2))
    # sinh x cosh x = x (1 + c); sinh^2 x = x^2 (1 + s).
    return x * c, x * x * s


def echo_waves(x: Array) -> Waves:
    """Compute the hyperbolic functions of a layer minus their limits for a thick layer.

    These limits, such as exp(2x)/4 of sinh^2 x, cancel in the difference between the compliance of
    a layered body and that of a half-space of its outermost material. The functions have the scale
    1.

    x  wavenumber times thickness of the layer
    """
    w = np.exp(-2 * x)
    s = w / 4 - 0.5
    c = -w / 4
    return Waves(np.ones_like(x), x, x * x, s, c + x, c - x, s - x * x)


def compound_rows(y: tuple[Array, ...], nu: float, f: Waves) -> tuple[Array, ...]:
    """Compute the compliance at the top of a layer from that at its underside, at each wavenumber.

    The compliance C is represented by (det C, C11, C12, C22, 1) times an arbitrary scale, in units
    of 1 / (2 G alpha), with the layer's shear modulus G and the wavenumber alpha. The last row of
    the result is the divisor.

    y   values at the underside
    nu  Poisson's ratio of the layer
    f   hyperbolic functions of the layer
    """
    det, c11, c12, c22, unit = y
    e = 1 / (2 * (1 - nu))
    g = (1 - 2 * nu) * e
    s, p, q, plus = f.sinh2, f.cosh_sinh_minus_x, f.sinh2_minus_xx, f.cosh_sinh_plus_x
    ee_xx = e * e * f.xx
    mixed = f.one + ee_xx + e * (1 + g) * s  # 1 + e²x² + e(1+g) sinh²
    down = (1 + g) * p + 2 * g * f.x  # (1+g) sinh cosh - e x
    up = (1 + g) * p + 2 * f.x  # (1+g) sinh cosh + e x
    cross = g * p + (2 * g - 1) * f.x  # g sinh cosh - e x
    cross_up = g * p + f.x  # g sinh cosh + e x
    twist = g * (1 + g) * q + (3 * g - 1) * f.xx  # g(1+g) sinh² - e²x²
    bend = ee_xx + g * e * s
    return (
        mixed * det
        + down * c11
        + 2 * twist * c12
        + up * c22
        + ((1 + g) ** 2 * q + 4 * g * f.xx) * unit,
        e * p * det + (f.one + s) * c11 + 2 * cross_up * c12 + s * c22 + up * unit,
        bend * det
        + cross * c11
        + (f.one - 2 * ee_xx + 2 * g * g * s) * c12
        + cross_up * c22
        + twist * unit,
        e * plus * det + s * c11 + 2 * cross * c12 + (f.one + s) * c22 + down * unit,
        e * e * q * det + e * plus * c11 + 2 * bend * c12 + e * p * c22 + mixed * unit,
    )
