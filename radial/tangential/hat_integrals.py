"""Galerkin integrals of hat functions on rings, for each harmonic, on a unit half-space.

The integrals ∬ φ_i K φ_j r s dr ds contain a kernel K of `harmonic_kernels` and hats φ that are
linear between nodes x = r/a. Pairs of elements with a common node use Duffy's triangles, other
pairs Gauss quadrature. The error is below 1e-10 if the widths of adjacent elements differ by less
than a factor of 2.5.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Array
from radial.response.bessel_functions import bessel_functions
from radial.response.quadrature import unit_gauss
from radial.tangential.harmonic_kernels import equal_order_kernels

Numbers = NDArray[np.int64]
# Pairs of quadrature points: element of r, element of s, r, s, s - r and weights.
Pairs = tuple[Numbers, Numbers, Array, Array, Array, Array]

SAME = 26
TOUCHING = (14, 12)
# Range of the distance of two elements (in elements), and number of Gauss points per direction.
APART = ((2, 4, 11), (4, 9, 7))
FAR = 9
FAR_POINTS = 5
WAVE_POINTS = 6
CACHED = 8


class HalfSpaceIntegrals(NamedTuple):
    """Galerkin integrals ∬ φ_i K φ_j r s dr ds of half-space kernels K, for all harmonics m.

    The integrals give the displacements of a half-space by tractions on rings, weighted over the
    radius. φ_i and φ_j are the hat functions of the nodes i and j (linear between nodes). J_m is
    the Bessel function. The shapes are (harmonics, n + 1, n + 1) for n + 1 nodes. Lengths are in
    units of the outermost radius.

    equal_order  kernel G_m = ∫ J_m(kr) J_m(ks) dk, m = 0 … M + 1
    shifted      kernel ∫ J_{m-1}(kr) J_{m+1}(ks) dk, m = 1 … M; the entry m = 0 is -equal_order[1]
    stepped      kernel ∫ J_m(kr) J_{m+1}(ks) dk, m = 0 … M
    """

    equal_order: Array
    shifted: Array
    stepped: Array


@lru_cache(maxsize=CACHED)
def half_space_integrals(nodes: tuple[float, ...], highest: int) -> HalfSpaceIntegrals:
    """Compute the Galerkin integrals of half-space kernels with hat functions of nodes on a radius.

    The integrals ∬ φ_i K φ_j r s dr ds give the displacements of a half-space by tractions on
    rings. φ_i is the hat function of node i, and K(r, s) a kernel ∫ J J dk with Bessel functions of
    kr and ks. The kernels of all angular harmonics are integrated. The results are cached.

    nodes    radii of the nodes over the unit of length, increasing from 0 (n + 1,)
    highest  highest angular harmonic M
    """
    x = np.array(nodes)
    size = (len(x), len(x))
    products = np.zeros((highest + 2, *size))
    squares = np.zeros((highest + 2, *size))  # Galerkin integrals of (r/s) G_m
    steps = np.zeros((highest + 1, *size))
    for inner, outer, r, s, apart, weights in _quadrature_pairs(x):
        kernel = equal_order_kernels(highest + 1, r, s, apart) * weights
        power = weights * r * (r / s) ** np.arange(highest + 1.0)[:, None, None]
        for i, at_r in enumerate(_evaluate_hats(x, inner, r)):
            for j, at_s in enumerate(_evaluate_hats(x, outer, s)):
                row, column, both = inner + i, outer + j, at_r * at_s
                part = (kernel * (both * r * s)).sum(-1)
                products[:, row, column] += part
                products[:, column, row] += part
                squares[:, row, column] += (kernel * (both * r * r)).sum(-1)
                squares[:, column, row] += (kernel * (both * s * s)).sum(-1)
                steps[:, row, column] += (power * both).sum(-1)
    m = np.arange(1.0, highest + 1)[:, None, None]
    shifted = (2 * m - 1) * products[:highest] - 2 * m * squares[1 : highest + 1]
    shifted = np.concatenate([-products[1:2], shifted])
    return HalfSpaceIntegrals(products, shifted, steps)


def _evaluate_hats(x: Array, element: Numbers, r: Array) -> tuple[Array, Array]:
    """Evaluate the linear hats of the inner and of the outer node (elements, points)
    at r of that shape; `element` is the index of the inner node in x (elements,)."""
    inner, outer = x[element, None], x[element + 1, None]
    return (outer - r) / (outer - inner), (r - inner) / (outer - inner)


def _quadrature_pairs(x: Array) -> Iterator[Pairs]:
    """Yield quadrature points r < s for double integrals over all pairs of elements of the radius.

    An element is the interval between two adjacent nodes. Pairs of elements are grouped by their
    distance, because a group has one quadrature rule. The rules of equal and of adjacent elements
    are dense near r = s, where the kernels are logarithmic. A group contains the numbers of the
    elements of r and of s (k,), and the arrays r, s, s - r and weights (k, points).

    x  radii of the nodes, increasing
    """
    count = len(x) - 1
    length = np.diff(x)
    each = np.arange(count)
    v, u, weights = _unit_square_rule(SAME, SAME)
    v, u, weights = v**2, u**4, weights * 2 * v * 4 * u**3
    off = length[:, None] * v
    s, apart = x[:-1, None] + off, off * u
    # r is a sum of positive terms instead of s - off u: r > 0 for all u < 1.
    yield each, each, x[:-1, None] + off * (1 - u), s, apart, weights * length[:, None] * off
    t, y, weights = _unit_square_rule(*TOUCHING)
    t, weights = t**3, weights * 3 * t**5
    inner, outer = each[:-1], each[1:]
    for before, behind in ((t, t * y), (t * y, t)):
        below, above = length[:-1, None] * before, length[1:, None] * behind
        shared = x[1:-1, None]
        area = (length[:-1] * length[1:])[:, None]
        yield inner, outer, shared - below, shared + above, below + above, weights * area
    between = each[None, :] - each[:, None]
    for first, last, points in (*APART, (FAR, count, FAR_POINTS)):
        inner, outer = np.nonzero((between >= first) & (between < last))
        v, u, weights = _unit_square_rule(points, points)
        r = x[inner, None] + length[inner, None] * v
        s = x[outer, None] + length[outer, None] * u
        area = (length[inner] * length[outer])[:, None]
        yield inner, outer, r, s, s - r, weights * area


def _unit_square_rule(first: int, second: int) -> tuple[Array, Array, Array]:
    """Return two coordinates and weights of Gauss points of the unit square, as flat arrays."""
    v, of_v = unit_gauss(first)
    u, of_u = unit_gauss(second)
    return np.repeat(v, second), np.tile(u, first), np.outer(of_v, of_u).ravel()


def hat_transforms(nodes: tuple[float, ...], highest: int, kappa: Array) -> Array:
    """Compute the Hankel transforms ∫ φ J_m(κx) x dx of the hat functions φ of nodes on a radius.

    The shape is (M + 2, κ, n + 1), for the orders m = 0 … M + 1 of the Bessel function J_m. The
    displacements by layers are integrals of products of these transforms over the wavenumber κ.

    nodes    radii x of the nodes over the unit of length (n + 1,)
    highest  highest angular harmonic M of the tractions
    kappa    wavenumbers κ times the unit of length (κ,)
    """
    x = np.array(nodes)
    length = np.diff(x)[:, None]
    v, weights = unit_gauss(WAVE_POINTS)
    s = x[:-1, None] + length * v
    at, weights = np.multiply.outer(kappa, s), length * weights * s
    found = np.zeros((highest + 2, len(kappa), len(x)))
    for total, values in zip(found, bessel_functions(highest + 1, at), strict=True):
        part = values * weights
        total[:, :-1] += part @ (1 - v)
        total[:, 1:] += part @ v
    return found
