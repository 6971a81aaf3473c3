"""Points of a contact with tangential load (nodes of rings times angles), and their compliance."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import CubicSpline

from contact_scene.array_types import Array
from radial.angular_grid import RingAngles
from radial.tangential.stick_border import stick_area

FINER = 16  # subdivisions of an element, to find the border of the stick zone
# Nodes for the fit of p² at the contact edge. BESIDE_EDGE: largest distance from the last node with
# pressure over the radius of this node. FITTED: least number.
BESIDE_EDGE, FITTED = 0.15, 4
FEWEST = 2  # least number of rings within a contact that resolve its edge
# INVERSES, ROOM: least number and total size [byte] of cached inverses of the compliance, for
# contacts with a changing number of rings. ROUND_OFF: relative norm below which the angles cannot
# represent a component of a harmonic.
INVERSES, ROOM, ROUND_OFF = 3, 1 << 23, 1e-12


@dataclass(frozen=True, eq=False)
class ContactPoints:
    """Points of a contact on rings times angles, and their elastic compliance.

    The compliance is that of both bodies and the rig's springs. There are n nodes along the radius
    and `count` angles. Fields have the shape (n count,), with the angle as the fast index. Vectors
    have the shape (3 n count,), with the components r, θ, z as the slow index. φ are the hat
    functions of the nodes.

    radii     radii of the nodes (n,) [length]
    energies  Galerkin matrices of the compliance, for angular harmonics up to J (J + 1, 3, 3, n, n)
              [length^5/force]
    weights   ∫ φ r dr (n,) [length²]
    arms      ∫ φ r² dr (n,) [length³]
    gap       ∫ φ f r dr with the undeformed gap f at first contact (n,) [length³]
    circle    angles of a ring
    """

    radii: Array
    energies: Array
    weights: Array
    arms: Array
    gap: Array
    circle: RingAngles

    @property
    def count(self) -> int:
        """Return the number of angles, the points on each ring."""
        return len(self.angles)

    @property
    def highest(self) -> int:
        """Return the highest angular harmonic J of the tractions."""
        return len(self.energies) - 1

    @cached_property
    def angles(self) -> Array:
        """Return the angles of the points on each ring (count,) [radian]."""
        return self.circle.angles(self.highest)

    @cached_property
    def areas(self) -> Array:
        """Return the area of every point (n count,) [length²].

        The area includes that of the mirror image if the angles cover half a circle.
        """
        return self._distribute_to_points(self.weights)

    @cached_property
    def gap_areas(self) -> Array:
        """Return the undeformed gap at every point times its area (n count,) [length³]."""
        return self._distribute_to_points(self.gap)

    @cached_property
    def levers(self) -> Array:
        """Return the distance of every point from the axis times its area (n count,) [length³]."""
        return self._distribute_to_points(self.arms)

    def _distribute_to_points(self, of_nodes: Array) -> Array:
        """Distribute integrals over the radius to the points of all angles (n count,).

        Each integral contains the hat function φ of a node. The values are those of the full
        circle.

        of_nodes  ∫ φ … dr of the nodes (n,)
        """
        return np.repeat(of_nodes, self.count) * (2 * np.pi / self.count)

    @cached_property
    def rigid_motions(self) -> Array:
        """Return the displacements r, θ of the points by unit rigid motions, times their areas.

        The shape is (3, 2 n count). The motions are a shift along θ = 0, a shift across it, and a
        twist. Motions that symmetry excludes are 0. The scalar product with the shear gives force
        and torque.
        """
        nodes, nothing = len(self.weights), np.zeros_like(self.areas)
        cos, sin = np.tile(np.cos(self.angles), nodes), np.tile(np.sin(self.angles), nodes)
        found = np.zeros((3, 2 * len(nothing)))
        if self.circle is not RingAngles.ONE:
            found[0] = np.concatenate([self.areas * cos, -self.areas * sin])
        if self.circle is RingAngles.WHOLE:
            found[1] = np.concatenate([self.areas * sin, self.areas * cos])
        if self.circle is not RingAngles.HALF:
            found[2] = np.concatenate([nothing, self.levers])
        return found

    @cached_property
    def compliance(self) -> Array:
        """Return the compliance matrix of all points [length^5/force].

        It maps tractions to displacements times the areas of the points, each with the components
        r, θ, z. The shape is (3 n count, 3 n count), with n nodes and `count` angles.
        """
        return self._over_harmonics(self._harmonic_transform, self._harmonic_energies)

    @cached_property
    def diagonal_compliance(self) -> Array:
        """Return the diagonal of the compliance matrix of all points (3 n count,) [length^5/force].

        An entry is the displacement of a point, times its area, by a unit traction at this point.
        The two components of shear have their mean, which does not depend on the direction.
        """
        outward, around, down = np.diagonal(self.compliance).reshape(3, -1)
        tangential = (outward + around) / 2
        return np.concatenate([tangential, tangential, down])

    def restrict_to_rings(self, field: Array, rings: int) -> Array:
        """Restrict a vector field from all points to the points on the innermost rings.

        field  components r, θ, z at all points (3 n count,)
        rings  number of innermost rings
        """
        return np.ascontiguousarray(field.reshape(3, -1)[:, : rings * self.count]).ravel()

    @cached_property
    def inverse_compliance(self) -> Callable[[int], Array]:
        """Return a function that computes the inverse compliance matrix of the innermost rings.

        The argument of the function is the number of rings. The inverse (3 rings count, 3 rings
        count) maps displacements times areas to tractions, if no other ring carries any. It is
        scaled by the square root of the compliance of each point on both sides [1]. The inverses
        are cached.
        """
        count = max(INVERSES, ROOM // self.compliance.nbytes)
        return lru_cache(maxsize=count)(self._compute_inverse)

    def _compute_inverse(self, rings: int) -> Array:
        """Compute the inverse of the compliance matrix on the innermost rings.

        The inverse is computed for each angular harmonic, because harmonics are not coupled. It is
        scaled by the square root of the compliance of each point on both sides [1].

        rings  number of rings
        """
        back = np.zeros_like(self._harmonic_transform)
        norms = np.sum(self._harmonic_transform**2, axis=2)
        has = norms > ROUND_OFF * np.max(norms)
        back[has] = self._harmonic_transform[has] / norms[has, None]
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
        units = np.sqrt(self.restrict_to_rings(self.diagonal_compliance, rings))
        found *= units
        found *= units[:, None]
        return found

    @cached_property
    def _harmonic_transform(self) -> Array:
        """Return the matrices that map values at the angles of a ring to amplitudes of harmonics.

        The shape is (3, families × (J + 1), count): components r, θ, z, harmonics 0 … J of each
        family, and `count` angles. In the symmetric family p and q_r are ∝ cos mθ and q_θ ∝ sin mθ.
        A full circle also has the antisymmetric family: p and q_r ∝ sin mθ, q_θ ∝ -cos mθ.
        """
        return np.concatenate(self.circle.harmonic_matrices(self.highest), axis=1)

    @cached_property
    def _harmonic_energies(self) -> Array:
        """Return the Galerkin matrices of all harmonics, times the norm of each harmonic.

        The shape is (families × (J + 1), 3, 3, n, n), with the harmonics up to J of the symmetric
        and antisymmetric families. The norm is π, or 2π for the harmonics 0 and J.
        """
        norms = np.full(len(self.energies), np.pi)
        norms[[0, -1]] = 2 * np.pi
        families = self._harmonic_transform.shape[1] // len(norms)
        return np.concatenate([norms[:, None, None, None, None] * self.energies] * families)

    @staticmethod
    def _over_harmonics(rigid_motions: Array, harmonic_matrices: Array) -> Array:
        """Assemble a matrix between points from the matrices of all angular harmonics.

        rigid_motions      transform from values at the angles to harmonics, of r, θ, z (3,
                           harmonics, count)
        harmonic_matrices  matrices between nodes, for each harmonic (harmonics, 3, 3, n, n)
        """
        (_, count, angles), nodes = rigid_motions.shape, harmonic_matrices.shape[-1]
        whole = np.empty((3, nodes, angles, 3, nodes, angles))
        for a, b in np.ndindex(3, 3):
            both = (rigid_motions[a, :, :, None] * rigid_motions[b, :, None]).reshape(count, -1)
            block = harmonic_matrices[:, a, b].reshape(count, -1).T @ both
            whole[a, :, :, b] = block.reshape(nodes, nodes, angles, angles).swapaxes(1, 2)
        return whole.reshape(3 * nodes * angles, -1)

    @cached_property
    def axisymmetric(self) -> ContactPoints:
        """Return the points for an axisymmetric contact: equal nodes with one angle per ring.

        Used as long as no tangential load acts.
        """
        return replace(self, energies=self.energies[:1], circle=RingAngles.ONE)

    def repeat_angles(self, field: Array) -> Array:
        """Repeat an axisymmetric field, known on one angle per ring, at all angles (…, n count).

        If the field contains the area of a point as a factor, divide the result by the number of
        angles.

        field  values with one angle per ring (…, n)
        """
        return np.repeat(field, self.count, axis=-1)

    def is_resolved(self, pressure: Array) -> bool:
        """Return true if the contact covers enough rings to resolve its edge and stick zone.

        pressure  pressure at the points (n count,)
        """
        return bool(np.any(pressure[FEWEST * self.count :] > 0))

    def contact_area(self, pressure: Array) -> float:
        """Return the contact area, bounded by the radius where p² extrapolates to zero [length²].

        An axisymmetric contact has dense nodes at its edge: p² is linear in r² through the last two
        nodes. Otherwise p² is a parabola in r², fitted to the nodes near the edge of every ray.

        pressure  pressure at the points (n count,)
        """
        p, r = pressure.reshape(-1, self.count), self.radii
        area = 0.0
        for ray in p.T:
            inside = np.flatnonzero(ray > 0)
            if len(inside) == 0:
                continue
            last = int(inside[-1])
            further = r[min(last + 1, len(r) - 1)] ** 2
            if self.circle is RingAngles.ONE:
                edge = r[last] ** 2
                if last and ray[last - 1] > ray[last]:
                    share = ray[last] ** 2 / (ray[last - 1] ** 2 - ray[last] ** 2)
                    edge += share * (edge - r[last - 1] ** 2)
            else:
                edge = self._fit_edge(ray, last)
            area += np.pi * min(edge, further)
        return area / self.count

    def _fit_edge(self, ray: Array, last: int) -> float:
        """Return the square of the contact radius on one ray, from a fit of the pressure [length²].

        p² is fitted by a parabola in r², and its zero is the edge. If too few nodes have pressure,
        or the parabola has no zero near the edge, the square of the radius of the last node with
        pressure is returned.

        ray   pressure at the nodes of the ray (n,)
        last  index of the last node with pressure
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
        """Compute the area of the stick zone, resolved below the distance of points [length²].

        The stick zone of an axisymmetric contact ends where `share`, linear in r, is 1. See
        `stick_border` for other contacts.

        share  trial shear |q - Δs/d| over the friction limit, with the slip Δs of the increment and
               the compliance d of the point (n count,)
        shear  q_r and q_θ (2, n count) [force/length²]
        bound  friction limit µp (n count,) [force/length²]
        """
        sticks = share.reshape(-1, self.count) < 1
        if self.circle is RingAngles.ONE:
            left = np.clip(np.where(np.isfinite(share), 1 - share, -1.0), -1.0, 1.0)
            parts = (np.arange(FINER) + 0.5) / FINER
            inside = (1 - parts) * left[:-1, None] + parts * left[1:, None] > 0
            inner, length = self.radii[:-1, None], np.diff(self.radii)[:, None]
            edges = inner + length * np.arange(FINER + 1) / FINER
            return float(np.pi * np.sum(inside * np.diff(edges**2)))
        q = shear.reshape(2, -1, self.count)
        p = bound.reshape(-1, self.count)
        if self.circle is RingAngles.HALF:
            q = np.concatenate([q, np.array([1, -1])[:, None, None] * q[..., ::-1]], axis=-1)
            p, sticks = (np.concatenate([field, field[:, ::-1]], axis=-1) for field in (p, sticks))
        return stick_area(self.radii, q, p, sticks)

    def interpolate_angles(self, field: Array, sense: float) -> Array:
        """Interpolate a field from the angles of the points to the output angles (n, angles).

        The interpolant on each of the n rings is a periodic spline in θ.

        field  values at the points (n count,)
        sense  1 for a field that is even about θ = 0, -1 for an odd field
        """
        values, angles = field.reshape(-1, self.count), self.angles
        if self.circle is RingAngles.HALF:
            values = np.hstack([values, sense * values[:, ::-1]])
            angles = np.concatenate([angles, 2 * np.pi - angles[::-1]])
        values, angles = (
            np.hstack([values, values[:, :1]]),
            np.append(angles, angles[0] + 2 * np.pi),
        )
        spline = CubicSpline(angles, values, axis=1, bc_type="periodic")
        return np.asarray(spline(self.output_angles))

    @property
    def output_angles(self) -> Array:
        """Return the angles at which fields are output [radian].

        They include the direction of the load, unlike the angles of the points.
        """
        return self.circle.output_angles(self.highest)
