"""Points where nodes of rings meet angles between 0 and π, and what tractions at them move.

Of the other half circle everything is the mirror image: p and q_r go as cosines of the angle from
the tangential load, q_θ as sines.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.fft import dct, dst
from scipy.interpolate import CubicSpline

Array = NDArray[np.float64]

FINER, AROUND = 16, 180  # places per element and angles, where a front is looked for
# Nodes that tell an edge: so far from the last one with pressure, over its radius, and how many.
BESIDE_EDGE, FITTED = 0.15, 4
# How far beyond a front the largest slip is, where no shear is 1 within: of 0.3, 0.5, 0.7 and 1
# what brings Cattaneo's circle and a coated contact on cells nearest.
BY_SLIP = 0.5


@dataclass(frozen=True, eq=False)
class Points:
    """Nodes of rings times angles, and what tractions at them do.

    radii     of the nodes (n,) [length]
    energies  of `ring_compliance` up to harmonic J, of the bodies (J + 1, 3, 3, n, n)
    weights   ∫ φ r dr (n,) [length²]
    gap       ∫ φ f r dr at first touch (n,) [length³]

    Fields of points are (n J,), angle by angle within a node; vectors (3 n J,), r, θ, z outermost.
    One angle, π/2, is enough for what is the same all around.
    """

    radii: Array
    energies: Array
    weights: Array
    gap: Array

    @property
    def count(self) -> int:
        """J, angles on the half circle."""
        return len(self.energies) - 1

    @property
    def angles(self) -> Array:
        """θ_j = π(j + ½)/J."""
        return np.pi * (np.arange(self.count) + 0.5) / self.count

    @cached_property
    def areas(self) -> Array:
        """Of every point and its mirror image."""
        return np.repeat(self.weights, self.count) * (2 * np.pi / self.count)

    @cached_property
    def bare(self) -> Array:
        """f times the area of a point."""
        return np.repeat(self.gap, self.count) * (2 * np.pi / self.count)

    @cached_property
    def along(self) -> Array:
        """Areas times the direction of the load, in r and θ (2 n J,)."""
        nodes = len(self.weights)
        ways = np.tile(np.cos(self.angles), nodes), -np.tile(np.sin(self.angles), nodes)
        return np.concatenate([self.areas * way for way in ways])

    @cached_property
    def compliance(self) -> Array:
        """Displacements times areas by tractions (3 n J, 3 n J) [length^5/force]."""
        J, nodes = self.count, len(self.weights)
        cosines, sines = np.zeros((J + 1, J)), np.zeros((J + 1, J))
        cosines[:J] = dct(np.eye(J), type=2, axis=0) / J
        sines[1:] = dst(np.eye(J), type=2, axis=0) / J
        cosines[0] /= 2
        sines[J] /= 2
        norms = np.full(J + 1, np.pi)
        norms[[0, J]] = 2 * np.pi
        ways = np.stack([cosines, sines, cosines])
        whole = np.einsum(
            "m,amj,mabik,bml->aijbkl", norms, ways, self.energies, ways, optimize=True
        )
        return whole.reshape(3 * nodes * J, -1)

    @cached_property
    def around(self) -> Points:
        """The same nodes, for what is the same all around."""
        return Points(self.radii, self.energies[:2], self.weights, self.gap)

    def every_angle(self, field: Array) -> Array:
        """Of the points, from one (…, n) of `around`; what is times the area still is so."""
        return np.repeat(field, self.count, axis=-1)

    def contact_area(self, pressure: Array) -> float:
        """Within the edge at which p² would end [length²]: linear in r² between the last two nodes,
        which stand close where the contact is the same all around; one that is pushed has its edge
        elsewhere, and the parabola in r² that is nearest to all nodes next to it tells where."""
        p, r = pressure.reshape(-1, self.count), self.radii
        area = 0.0
        for ray in p.T:
            inside = np.flatnonzero(ray > 0)
            if len(inside) == 0:
                continue
            last = int(inside[-1])
            further = r[min(last + 1, len(r) - 1)] ** 2
            if self.count == 1:
                edge = r[last] ** 2
                if last and ray[last - 1] > ray[last]:
                    share = ray[last] ** 2 / (ray[last - 1] ** 2 - ray[last] ** 2)
                    edge += share * (edge - r[last - 1] ** 2)
            else:
                edge = self._fitted_edge(ray, last)
            area += np.pi * min(edge, further)
        return area / self.count

    def _fitted_edge(self, ray: Array, last: int) -> float:
        """r² of the edge on a ray whose last node with pressure is given; that node where too few
        have any, or where the pressure does not fall to zero near it [length²]."""
        r = self.radii
        first = min(int(np.searchsorted(r, (1 - BESIDE_EDGE) * r[last])), last + 1 - FITTED)
        if first < 0:
            return float(r[last] ** 2)
        near = slice(first, last + 1)
        squares = np.polynomial.Polynomial.fit(
            r[near] ** 2, ray[near] ** 2, 2, w=np.sqrt(self.weights[near])
        )
        zeros = squares.roots()
        beyond = zeros.real[(zeros.imag == 0) & (zeros.real > r[last - 1] ** 2)]
        return float(np.min(beyond) if len(beyond) else r[last] ** 2)

    def stick_area(self, share: Array, slipped: Array) -> float:
        """Where nothing slips, linear in r, a spline in θ [length²]: no count of points.

        share    of the limit, as `Held` has it
        slipped  how far, in any unit: of what is pushed slip tells how far beyond a front a point
                 is, over the largest, for the share beyond 1 goes with the size of the increment
        """
        beyond = share - 1
        if self.count > 1 and np.any(share > 1):
            largest = np.max(slipped, where=np.isfinite(share), initial=0.0)
            beyond = BY_SLIP * (slipped / largest) ** (2 / 3)
        left = np.where(share < 1, 1 - share, -np.where(np.isfinite(share), beyond, 1.0))
        left = np.clip(left, -1.0, 1.0).reshape(-1, self.count)
        turned = self._around(left, 1.0, np.pi * (np.arange(AROUND) + 0.5) / AROUND)
        nodes = np.arange(len(self.radii))
        edges = np.interp(np.linspace(0, nodes[-1], FINER * nodes[-1] + 1), nodes, self.radii)
        middle = (edges[1:] + edges[:-1]) / 2
        sticks = np.array([np.interp(middle, self.radii, values) > 0 for values in turned.T])
        return float(np.pi * np.mean(sticks, axis=0) @ np.diff(edges**2))

    def shown(self, field: Array, sense: float) -> Array:
        """A field at the angles of `shown_angles` (n, J + 1), by a spline in θ.

        sense  1 for what the mirror image has alike, -1 for what it has opposite
        """
        return self._around(field.reshape(-1, self.count), sense, self.shown_angles)

    @property
    def shown_angles(self) -> Array:
        """πj/J, with the line along the load."""
        return np.pi * np.arange(self.count + 1) / self.count

    def _around(self, field: Array, sense: float, angles: Array) -> Array:
        """A field (n, J) at other angles."""
        every = np.concatenate([self.angles, 2 * np.pi - self.angles[::-1]])
        every = np.append(every, every[0] + 2 * np.pi)
        whole = np.hstack([field, sense * field[:, ::-1], field[:, :1]])
        spline = CubicSpline(every, whole, axis=1, bc_type="periodic")
        return np.asarray(spline(angles))
