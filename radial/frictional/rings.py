"""Tractions on rings, and the response of half-spaces to them.

Tractions are hat functions φ (linear between nodes) in x = r/a, times the factor √(1-x²), which is
the behaviour of tractions at the edge. An element is the interval between two nodes. The nodes are
dense where tractions have kinks: at the border of the stick zone, at the edge and at the axis. The
response of half-spaces to a hat has a closed form or uses Gauss quadrature. Lengths are in units of
the contact radius a.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import exp, log

import numpy as np
from scipy.special import ellipe, ellipkm1, j0, j1

from contact_scene.array_types import Array
from radial.response.array_cache import (
    MAX_CACHED,
    cache_within_bytes,
)
from radial.response.quadrature import unit_gauss
from radial.response.wavenumbers import Waves, wave_blocks

# Stick radii c within this interval of log(c/(a - c)) share their rings; a is the contact radius.
SHARED = 0.08
NEAREST = 6.0  # largest |log(c/(a - c))|, which limits how near c is to axis and edge
# Ratio of the widths of adjacent rings towards axis and edge (GRADED) and towards the stick border
# (TOWARDS), and numbers of these rings: FINEST at the stick border, AT_AXIS, AT_EDGE.
GRADED = 0.5
TOWARDS = 0.6
FINEST = 9
AT_AXIS = 4
AT_EDGE = 6
# Gauss points of an element
POINTS = 14
WAVE_POINTS = 6
CACHED = 64
# Positions outside the contact at which displacements are computed, over the contact radius.
OUTSIDE = 1 + np.array([0.01, 0.03, 0.08, 0.2, 0.4, 0.7, 1.1, 1.6, 2.5, 4.0])


@dataclass(frozen=True, eq=False)
class Rings:
    """Nodes along the radius of a contact disc, with responses of half-spaces to tractions.

    Tractions are hat functions φ of the nodes (linear between nodes) times √(1-x²), with x = r/a
    and the contact radius a. The responses are matrices. Their rows are the positions of
    displacements: the nodes, then points outside the contact. Their columns are nodal tractions:
    pressure at the nodes 0 to n - 1, or radial shear at the nodes 1 to n - 1. In the last element
    (interval between two nodes) tractions are multiples of √(1-x²). Objects are created by
    `rings_for_stick_radius`.

    x  radii of the n + 1 nodes over the contact radius, from 0 to 1
    """

    x: Array

    @property
    def count(self) -> int:
        """Number n of elements of the radius, the intervals between its n + 1 nodes."""
        return len(self.x) - 1

    @cached_property
    def places(self) -> Array:
        """Radii at which displacements are evaluated, over the contact radius (rows,).

        They are the n + 1 nodes, then points outside the contact. The rows of all response matrices
        belong to these radii.
        """
        return np.concatenate([self.x, OUTSIDE])

    @cached_property
    def weights(self) -> Array:
        """Weights of nodal tractions in integrals over the contact area (n + 1,) [1].

        A weight is ∫ φ x dx, with the hat function φ of the node, which contains the factor
        √(1-x²), and x = r/a. The normal force ∫ p dA is 2πa² times the sum of the products of
        weights and nodal pressures.
        """
        return self._sum_at_nodes(*self._integrate_hats(1))

    def interpolate_traction(self, field: Array, x: Array) -> Array:
        """Interpolate nodal tractions to given radii; the result is zero outside the contact.

        The ratio of the traction to √(1-x²) is interpolated linearly.

        field  traction at the nodes (n + 1,) [force/length²]
        x      radii over the contact radius (any shape)
        """
        share = field[:-1] / _edge_root(self.x[:-1])
        return np.asarray(np.interp(x, self.x[:-1], share) * _edge_root(np.minimum(x, 1.0)))

    @cached_property
    def direct_responses(self) -> tuple[Array, Array]:
        """Direct responses of half-spaces to tractions on rings (rows, columns).

        They are the normal displacement by pressure, ∫ G₀ φ s ds, and the radial displacement by
        radial shear, ∫ G₁ φ s ds. The kernel G_m = ∫₀^∞ J_m(kx) J_m(ks) dk is logarithmic at s = x
        and has complete elliptic integrals (Gradshteyn and Ryzhik 6.512.1, 8.1). Rows are positions
        x of displacements, columns nodes of tractions.
        """
        inner, length = self.x[:-1], np.diff(self.x)
        v, weights = unit_gauss(POINTS)
        # Points are dense towards the position x, where the kernel is logarithmic.
        v, weights = v**3, 3 * v**2 * weights
        x = self.places[:, None]
        before = x <= inner
        off = length[:, None] * v
        s = np.where(before[..., None], inner[:, None] + off, self.x[1:, None] - off)
        apart = np.where(before, inner - x, x - self.x[1:])[..., None] + off
        share = np.where(before[..., None], v, 1 - v)
        left, right = self._weighted_hats(s, share, length[:, None] * weights * s)
        r, total = x[..., None], x[..., None] + s
        small = (apart / total) ** 2
        first, second = ellipkm1(small), ellipe(1 - small)
        zeroth = 2 / np.pi * first / total
        moment = np.where(r > 0, r, 1.0) * s
        once = ((r * r + s * s) / total * first - total * second) / (np.pi * moment)
        once = np.where(r > 0, once, 0.0)
        hats = [
            self._sum_at_nodes((part * left).sum(-1), (part * right).sum(-1))
            for part in (zeroth, once)
        ]
        return hats[0][:, :-1], hats[1][:, 1:-1]

    @cached_property
    def coupling_responses(self) -> tuple[Array, Array]:
        """Coupling responses of half-spaces to tractions on rings (rows, columns).

        They are the normal displacement by radial shear, ∫ₓ¹ φ ds, and the radial displacement by
        pressure, (1/x) ∫₀ˣ φ s ds. The kernel ∫₀^∞ J₀(kr) J₁(ks) dk is 1/s for r < s, else 0
        (Gradshteyn and Ryzhik 6.512.3). Rows are positions x of displacements, columns nodes of
        tractions.
        """
        inner, outer = self.x[:-1], self.x[1:]
        x = self.places[:, None]
        beyond, within = inner >= x, outer <= x
        reach = np.where(x > 0, x, 1.0)
        by_shear, by_pressure = (
            self._sum_at_nodes(
                *(np.where(there, part, 0.0) for part in self._integrate_hats(power))
            )
            for there, power in ((beyond, 0), (within, 1))
        )
        return by_shear[:, 1:-1], (by_pressure / reach)[:, :-1]

    def _integrate_hats(self, power: int) -> tuple[Array, Array]:
        """Integrate the hats φ over each element, ∫ φ xᵐ dx with m = `power`:
        those of the inner nodes (n,), and those of the outer nodes (n,)."""
        v, weights = unit_gauss(POINTS)
        inner, length = self.x[:-1, None], np.diff(self.x)[:, None]
        s = inner + length * v
        left, right = self._weighted_hats(
            s, np.broadcast_to(v, s.shape), length * weights * s**power
        )
        return left.sum(-1), right.sum(-1)

    def _weighted_hats(self, s: Array, share: Array, weights: Array) -> tuple[Array, Array]:
        """Evaluate the hats of the inner and of the outer node of each element, times weights.

        The shape is (…, n, points). In the last element the hat of the inner node represents the
        whole traction.

        share  fraction of the element between its inner node and the point
        """
        root = _edge_root(self.x)
        known = _edge_root(s) * weights
        left = known * (1 - share) / root[:-1, None]
        right = known * share / np.append(root[1:-1], 1.0)[:, None]
        left[..., -1, :] += right[..., -1, :] / root[-2]
        right[..., -1, :] = 0.0
        return left, right

    @staticmethod
    def _sum_at_nodes(left: Array, right: Array) -> Array:
        """Sum contributions (…, n) of elements at their inner (left) and outer (right) nodes:
        (…, n + 1)."""
        total = np.zeros((*left.shape[:-1], left.shape[-1] + 1))
        total[..., :-1] += left
        total[..., 1:] += right
        return total

    @cache_within_bytes(MAX_CACHED)
    def transforms(self, waves: Waves) -> tuple[Array, Array, Array, Array]:
        """Compute Hankel transforms of the hat functions of nodes, for displacements by layers.

        Layers add displacements that are integrals of transforms of tractions times Bessel
        functions at the positions of displacements, over the wavenumber κ. Rows are positions x of
        displacements, columns nodes of tractions with the hat function φ. The four results are

            ∫ φ J₀(κs) s ds for the pressure,    ∫ φ J₁(κs) s ds for the shear    (κ, columns)
            J₀(κx),    J₁(κx)    (rows, κ)

        The results are cached.

        waves  quadrature over wavenumbers κ, multiplied by the contact radius
        """
        kappa = waves.rule[0]
        length = np.diff(self.x)[:, None]
        v, weights = unit_gauss(WAVE_POINTS)
        s = self.x[:-1, None] + length * v
        left, right = self._weighted_hats(s, np.broadcast_to(v, s.shape), length * weights * s)
        found = [np.empty((len(kappa), len(self.x))) for _ in range(2)]
        for some in wave_blocks(len(kappa), s.size):
            at = np.multiply.outer(kappa[some], s)
            for total, bessel in zip(found, (j0, j1), strict=True):
                part = bessel(at)
                total[some] = self._sum_at_nodes((part * left).sum(-1), (part * right).sum(-1))
        at = np.multiply.outer(self.places, kappa)
        return found[0][:, :-1], found[1][:, 1:-1], j0(at), j1(at)


def _edge_root(x: Array) -> Array:
    return np.asarray(np.sqrt((1 - x) * (1 + x)))


def layout_number(front: float) -> int:
    """Return the number of the ring layout whose nodes are dense at a given stick radius c.

    The number is log(c/(a - c)) with the contact radius a, rounded to multiples of 0.08. Similar
    stick radii thus share their rings, whose response matrices are cached.

    front  stick radius over the contact radius, c/a
    """
    c = min(max(front, 1e-9), 1 - 1e-9)
    return round(min(max(log(c / (1 - c)), -NEAREST), NEAREST) / SHARED)


def rings_for_stick_radius(front: float, count: int) -> Rings:
    """Return the nodes along the radius of a contact, dense at the border of the stick zone.

    Pressure and radial shear of a contact with friction are represented at these nodes.

    front  stick radius over the contact radius
    count  approximate number of rings, without those of dense regions
    """
    return _create_rings(layout_number(front), count)


@lru_cache(maxsize=CACHED)
def _create_rings(place: int, count: int) -> Rings:
    """Create nodes along the radius of a contact, dense at stick radius, axis and contact edge.

    place  number of the layout, returned by `layout_number` for a stick radius
    count  approximate number of rings, without those of dense regions
    """
    c = 1 / (1 + exp(-place * SHARED))
    share = 1 / (1 + ((1 - c) / c) ** 0.5)
    inside = max(round(count * share), 8)
    t = np.arange(inside + 1) / inside
    inner = c * t**1.5
    beyond = max(count - inside, 8)
    sliding = c + (1 - c) * np.sin(np.pi / 2 * np.arange(beyond + 1) / beyond)
    near = TOWARDS ** np.arange(FINEST)
    step_in, step_out = inner[-1] - inner[-2], sliding[1] - sliding[0]
    x = np.concatenate(
        [
            inner,
            sliding,
            inner[1] * GRADED ** np.arange(1, AT_AXIS),
            1 - (1 - sliding[-2]) * GRADED ** np.arange(1, AT_EDGE),
            c - step_in * near[1:],
            c + step_out * near[1:],
        ]
    )
    return Rings(np.unique(x))
