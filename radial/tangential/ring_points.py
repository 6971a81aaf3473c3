"""Points of a contact: nodes of rings times angles, and their compliance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import CubicSpline

from contact_scene.array_types import Array
from radial.angular_grid import Circle
from radial.tangential.stick_border import stick_area

FINER = 16  # subdivisions of an element, to find a front
# Nodes for the fit of an edge: largest distance from the last node with pressure over its radius,
# and least number.
BESIDE_EDGE, FITTED = 0.15, 4
FEWEST = 2  # rings within a contact that resolve its edge
# Cache of inverses for contacts with a changing number of rings: least number and size [byte].
# Relative norm below which the angles cannot represent a component of a harmonic.
INVERSES, ROOM, ROUND_OFF = 3, 1 << 23, 1e-12


@dataclass(frozen=True, eq=False)
class Points:
    """Nodes of rings times angles, and the compliance of both bodies at these points.

    radii     of the nodes (n,) [length]
    energies  Galerkin matrices of `ring_compliance` up to harmonic J (J + 1, 3, 3, n, n)
    weights   ∫ φ r dr (n,) [length²]
    arms      ∫ φ r² dr (n,) [length³]
    gap       ∫ φ f r dr at first contact (n,) [length³]
    circle    angles of a ring

    Fields of points have the shape (n count,), with the angle as the fast index. Vectors have the
    shape (3 n count,), with the components r, θ, z as the slow index.
    """

    radii: Array
    energies: Array
    weights: Array
    arms: Array
    gap: Array
    circle: Circle

    @property
    def count(self) -> int:
        """Number of angles of a ring."""
        return len(self.angles)

    @property
    def highest(self) -> int:
        """J, the highest harmonic."""
        return len(self.energies) - 1

    @cached_property
    def angles(self) -> Array:
        """Angles of the points on a ring."""
        return self.circle.angles(self.highest)

    @cached_property
    def areas(self) -> Array:
        """Area of every point, including its symmetric counterparts."""
        return self._at_points(self.weights)

    @cached_property
    def gap_areas(self) -> Array:
        """f times the area of every point."""
        return self._at_points(self.gap)

    @cached_property
    def levers(self) -> Array:
        """r times the area of every point."""
        return self._at_points(self.arms)

    def _at_points(self, of_nodes: Array) -> Array:
        return np.repeat(of_nodes, self.count) * (2 * np.pi / self.count)

    @cached_property
    def rigid_motions(self) -> Array:
        """Areas times the displacement (r, θ) by unit rigid motions (3, 2 n count).

        The motions are a shift along θ = 0, a shift across, and a twist. Rows excluded by symmetry
        are 0.
        """
        nodes, nothing = len(self.weights), np.zeros_like(self.areas)
        cos, sin = np.tile(np.cos(self.angles), nodes), np.tile(np.sin(self.angles), nodes)
        found = np.zeros((3, 2 * len(nothing)))
        if self.circle is not Circle.ONE:
            found[0] = np.concatenate([self.areas * cos, -self.areas * sin])
        if self.circle is Circle.WHOLE:
            found[1] = np.concatenate([self.areas * sin, self.areas * cos])
        if self.circle is not Circle.HALF:
            found[2] = np.concatenate([nothing, self.levers])
        return found

    @cached_property
    def compliance(self) -> Array:
        """Matrix from tractions to displacements times areas (3 n count,) * 2 [length^5/force]."""
        return self._over_harmonics(self._harmonics, self._harmonic_energies)

    @cached_property
    def softness(self) -> Array:
        """Diagonal of the compliance (3 n count,) [length^5/force].

        Both components of shear have their mean, which does not depend on the direction.
        """
        outward, around, down = np.diagonal(self.compliance).reshape(3, -1)
        tangential = (outward + around) / 2
        return np.concatenate([tangential, tangential, down])

    def of_rings(self, field: Array, rings: int) -> Array:
        """Restrict a vector (3 n count,) to the innermost rings."""
        return np.ascontiguousarray(field.reshape(3, -1)[:, : rings * self.count]).ravel()

    @cached_property
    def tractions(self) -> Callable[[int], Array]:
        """Function of a number of rings that returns the inverse of the compliance on the innermost
        rings.

        The inverse (3 rings count,) * 2 maps displacements times areas to tractions, if no other
        ring carries any. It is scaled by √`softness` on both sides [1].
        """
        count = max(INVERSES, ROOM // self.compliance.nbytes)
        return lru_cache(maxsize=count)(self._tractions)

    def _tractions(self, rings: int) -> Array:
        """Invert the compliance harmonic by harmonic. Harmonics are not coupled."""
        back = np.zeros_like(self._harmonics)
        norms = np.sum(self._harmonics**2, axis=2)
        has = norms > ROUND_OFF * np.max(norms)
        back[has] = self._harmonics[has] / norms[has, None]
        energies = self._harmonic_energies[..., :rings, :rings]
        inverses = np.zeros_like(energies)
        for parts, energy, inverse in zip(has.T, energies, inverses, strict=True):
            present, n = np.flatnonzero(parts), int(np.sum(parts)) * rings
            known = energy[np.ix_(present, present)].swapaxes(1, 2).reshape(n, n)
            units = 1 / np.sqrt(np.diag(known))
            found = units * np.linalg.inv(units[:, None] * known * units) * units[:, None]
            found = found.reshape(len(present), rings, len(present), rings).swapaxes(1, 2)
            inverse[np.ix_(present, present)] = found
        found = self._over_harmonics(back, inverses)
        units = np.sqrt(self.of_rings(self.softness, rings))
        found *= units
        found *= units[:, None]
        return found

    @cached_property
    def _harmonics(self) -> Array:
        """Matrices from values at the angles to harmonics (3, families × (J + 1), count)."""
        return np.concatenate(self.circle.families(self.highest), axis=1)

    @cached_property
    def _harmonic_energies(self) -> Array:
        """Energies of the harmonics of `_harmonics`, times their norms (…, 3, 3, n, n)."""
        norms = np.full(len(self.energies), np.pi)
        norms[[0, -1]] = 2 * np.pi
        families = self._harmonics.shape[1] // len(norms)
        return np.concatenate([norms[:, None, None, None, None] * self.energies] * families)

    @staticmethod
    def _over_harmonics(rigid_motions: Array, harmonic_matrices: Array) -> Array:
        """Assemble a matrix between points from the matrices of all harmonics."""
        (_, count, angles), nodes = rigid_motions.shape, harmonic_matrices.shape[-1]
        whole = np.empty((3, nodes, angles, 3, nodes, angles))
        for a, b in np.ndindex(3, 3):
            both = (rigid_motions[a, :, :, None] * rigid_motions[b, :, None]).reshape(count, -1)
            block = harmonic_matrices[:, a, b].reshape(count, -1).T @ both
            whole[a, :, :, b] = block.reshape(nodes, nodes, angles, angles).swapaxes(1, 2)
        return whole.reshape(3 * nodes * angles, -1)

    @cached_property
    def round(self) -> Points:
        """Points with the same nodes and one angle, for axisymmetric fields."""
        return replace(self, energies=self.energies[:1], circle=Circle.ONE)

    def every_angle(self, field: Array) -> Array:
        """Repeat a field (…, n) of `round` at all angles.

        Divide quantities that are multiplied by the area of a point by the number of angles
        afterwards.
        """
        return np.repeat(field, self.count, axis=-1)

    def is_resolved(self, pressure: Array) -> bool:
        """Return true if the contact has enough rings to resolve its edge and stick zone."""
        return bool(np.any(pressure[FEWEST * self.count :] > 0))

    def contact_area(self, pressure: Array) -> float:
        """Return the contact area within the edge, where p² extrapolates to zero [length²].

        An axisymmetric contact has dense nodes at its edge: p² is linear in r² through the last two
        nodes. Otherwise p² is a parabola in r², fitted to the nodes near the edge of every ray.
        """
        p, r = pressure.reshape(-1, self.count), self.radii
        area = 0.0
        for ray in p.T:
            inside = np.flatnonzero(ray > 0)
            if len(inside) == 0:
                continue
            last = int(inside[-1])
            further = r[min(last + 1, len(r) - 1)] ** 2
            if self.circle is Circle.ONE:
                edge = r[last] ** 2
                if last and ray[last - 1] > ray[last]:
                    share = ray[last] ** 2 / (ray[last - 1] ** 2 - ray[last] ** 2)
                    edge += share * (edge - r[last - 1] ** 2)
            else:
                edge = self._fitted_edge(ray, last)
            area += np.pi * min(edge, further)
        return area / self.count

    def _fitted_edge(self, ray: Array, last: int) -> float:
        """Return r² of the edge on a ray with its last node with pressure [length²].

        Return r² of this node if too few nodes have pressure, or if the fit has no zero near it.
        """
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

    def stick_area(self, share: Array, shear: Array, bound: Array) -> float:
        """Return the area of the stick zone, resolved below the distance of points [length²].

        The stick zone of an axisymmetric contact ends where the share of the limit, linear in r, is
        1. See `stick_border` for other contacts.

        share  |q - Δs/d| over the limit, see `PointState`
        shear  q_r and q_θ (2, n count)
        bound  µp
        """
        sticks = share.reshape(-1, self.count) < 1
        if self.circle is Circle.ONE:
            left = np.clip(np.where(np.isfinite(share), 1 - share, -1.0), -1.0, 1.0)
            parts = (np.arange(FINER) + 0.5) / FINER
            inside = (1 - parts) * left[:-1, None] + parts * left[1:, None] > 0
            inner, length = self.radii[:-1, None], np.diff(self.radii)[:, None]
            edges = inner + length * np.arange(FINER + 1) / FINER
            return float(np.pi * np.sum(inside * np.diff(edges**2)))
        q = shear.reshape(2, -1, self.count)
        p = bound.reshape(-1, self.count)
        if self.circle is Circle.HALF:
            q = np.concatenate([q, np.array([1, -1])[:, None, None] * q[..., ::-1]], axis=-1)
            p, sticks = (np.concatenate([field, field[:, ::-1]], axis=-1) for field in (p, sticks))
        return stick_area(self.radii, q, p, sticks)

    def shown(self, field: Array, sense: float) -> Array:
        """Interpolate a field to `output_angles` by a periodic spline in θ (n, angles).

        sense  1 for a field that is even about θ = 0, -1 for an odd one
        """
        return self._around(field.reshape(-1, self.count), sense, self.output_angles)

    @property
    def output_angles(self) -> Array:
        """Output angles; they include the direction of the load."""
        return self.circle.shown(self.highest)

    def _around(self, field: Array, sense: float, angles: Array) -> Array:
        """Interpolate a field (n, count) to other angles."""
        return field @ self._spline(sense, tuple(angles))

    @cached_property
    def _spline(self) -> Callable[[float, tuple[float, ...]], Array]:
        """Function that returns the interpolation matrix from `angles` to other angles (count,
        …)."""

        @lru_cache
        def weights(sense: float, others: tuple[float, ...]) -> Array:
            every, whole = self.angles, np.eye(self.count)
            if self.circle is Circle.HALF:
                every = np.concatenate([every, 2 * np.pi - every[::-1]])
                whole = np.hstack([whole, sense * whole[:, ::-1]])
            every = np.append(every, every[0] + 2 * np.pi)
            whole = np.hstack([whole, whole[:, :1]])
            return np.ascontiguousarray(
                CubicSpline(every, whole, axis=1, bc_type="periodic")(np.array(others))
            )

        return weights
