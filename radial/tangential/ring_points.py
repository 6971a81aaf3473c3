"""Points of a contact on rings × angles, with the elastic compliance between them.

The laws of contact and friction hold at these points.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import CubicSpline

from contact_scene.array_types import Array
from contact_solver.unequal_areas import UnequalAreas
from radial.angular_grid import RingAngles
from radial.tangential.ring_operator import RingOperator
from radial.tangential.stick_border import stick_area

FINER = 16  # subdivisions of an element, to find the border of the stick zone
# Nodes for the fit of p² at the contact edge. BESIDE_EDGE: largest distance from the last node with
# pressure over the radius of this node. FITTED: least number.
BESIDE_EDGE = 0.15
FITTED = 4
FEWEST = 2  # least number of rings within a contact that resolve its edge
# INVERSES, ROOM: least number and total size [byte] of cached inverses of the compliance, for
# contacts with a changing number of rings. ROUND_OFF: relative norm below which the angles cannot
# represent a component of a harmonic.
INVERSES = 3
ROOM = 1 << 23
ROUND_OFF = 1e-12


@dataclass(frozen=True, eq=False)
class ContactPoints:
    """Points of a contact on rings × angles, with the elastic compliance of bodies and test rig.

    A point is a node of the radius at one of `count` angles. There are n nodes. φ are the hat
    functions of the nodes, linear between nodes. Fields have the shape (n count,), with the angle
    as the fast index. Vectors have the shape (3 n count,), with the components r, θ, z as the slow
    index.

    radii      radii of the nodes (n,) [length]
    harmonics  Galerkin matrices of the compliance, for angular harmonics up to J
               (J + 1, 3, 3, n, n) [length^5/force]
    weights    ∫ φ r dr of the nodes, for areas (n,) [length²]
    arms       ∫ φ r² dr of the nodes, for torques (n,) [length³]
    gap        ∫ φ f r dr of the nodes, with the undeformed gap f at first contact (n,) [length³]
    circle     angles of the points on a ring: one angle, half a circle or the full circle
    """

    radii: Array
    harmonics: Array
    weights: Array
    arms: Array
    gap: Array
    circle: RingAngles

    @property
    def count(self) -> int:
        """Number of angles at which each ring has a point.

        Fields at the points of n rings have the shape (n count,).
        """
        return len(self.angles)

    @property
    def highest(self) -> int:
        """Highest angular harmonic J by which tractions on a ring are represented."""
        return len(self.harmonics) - 1

    @cached_property
    def angles(self) -> Array:
        """Angles of the points on each ring about the axis (count,) [radian].

        The angle θ = 0 is the direction of the tangential load.
        """
        return self.circle.angles(self.highest)

    @cached_property
    def areas(self) -> Array:
        """Area of the contact that each point represents (n count,) [length²].

        The area of a point is the integral of its hat function over the radius and over its share
        of the full circle. If the angles cover half a circle, the area includes that of the mirror
        image.
        """
        return self._distribute_to_points(self.weights)

    @cached_property
    def gap_areas(self) -> Array:
        """Undeformed gap at first contact at every point, times its area [length³].

        The shape is (n count,) for n rings with `count` angles each.
        """
        return self._distribute_to_points(self.gap)

    @cached_property
    def levers(self) -> Array:
        """Distance of every point from the axis, times its area (n count,) [length³].

        The levers multiply the circumferential shear in the torque.
        """
        return self._distribute_to_points(self.arms)

    def _distribute_to_points(self, of_nodes: Array) -> Array:
        """Give the points (n count,) equal shares of 2π times the integral of a node (n,)."""
        return np.repeat(of_nodes, self.count) * (2 * np.pi / self.count)

    @cached_property
    def rigid_motions(self) -> Array:
        """Displacements r, θ of all points by unit rigid motions, times their areas.

        The shape is (3, 2 n count) for n rings with `count` angles each. The motions are a shift
        along θ = 0, a shift across it, and a twist about the axis. Motions that symmetry excludes
        are 0. The scalar product of a row with the shear gives the conjugate force or torque.
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
    def operator(self) -> RingOperator:
        """Compliance of all points: displacement times area by traction [length^5/force]."""
        return RingOperator(self._harmonic_transform, self._harmonic_compliance)

    @cached_property
    def scale(self) -> UnequalAreas:
        """Conversion to points of equal area."""
        return UnequalAreas(self.areas)

    @cached_property
    def equal_compliance(self) -> RingOperator:
        """Compliance for points of equal area [length^3/force]: map from s t to s u.

        Here t are the tractions, u the displacements and s the roots of the areas.
        """
        units = 1 / np.sqrt(self.weights * (2 * np.pi / self.count))
        scaled = self._harmonic_compliance * units * units[:, None]
        return RingOperator(self._harmonic_transform, scaled)

    @cached_property
    def tangential_compliance(self) -> Array:
        """Tangential displacement of each point, times its area, by its own unit shear.

        The values (n count,) [length^5/force] are the means over radial and circumferential shear.
        They do not depend on the direction of the shear. The stick zone of an axisymmetric contact
        uses them as the compliance of a point.
        """
        outward, around, _ = self.operator.diagonal.reshape(3, -1)
        return np.asarray((outward + around) / 2)

    @cached_property
    def stiffness(self) -> Callable[[int], RingOperator]:
        """Function that computes the inverse of `equal_compliance` on the innermost rings.

        The argument of the function is the number of rings. The other rings carry no traction. The
        inverses are cached.
        """
        size = 8 * (3 * len(self.areas)) ** 2
        return lru_cache(maxsize=max(INVERSES, ROOM // size))(self._compute_inverse)

    def _compute_inverse(self, rings: int) -> RingOperator:
        """Compute the inverse of the compliance of the points on the innermost rings.

        The inverse is computed for each angular harmonic, because harmonics are not coupled.

        rings  number of innermost rings
        """
        back = np.zeros_like(self._harmonic_transform)
        norms = np.sum(self._harmonic_transform**2, axis=2)
        has = norms > ROUND_OFF * np.max(norms)
        back[has] = self._harmonic_transform[has] / norms[has, None]
        compliances = self.equal_compliance.matrices[..., :rings, :rings]
        inverses = np.zeros_like(compliances)
        for parts, compliance, inverse in zip(has.T, compliances, inverses, strict=True):
            present, n = np.flatnonzero(parts), int(np.sum(parts)) * rings
            known = compliance[np.ix_(present, present)].swapaxes(1, 2).reshape(n, n)
            found = np.linalg.inv(known)
            found = found.reshape(len(present), rings, len(present), rings).swapaxes(1, 2)
            inverse[np.ix_(present, present)] = found
        return RingOperator(back, inverses)

    @cached_property
    def _harmonic_transform(self) -> Array:
        """Matrices (3, families × (J + 1), count) from r, θ, z components at the angles
        of a ring to harmonics; a full circle adds p and q_r ∝ sin mθ and q_θ ∝ -cos mθ."""
        return np.concatenate(self.circle.harmonic_matrices(self.highest), axis=1)

    @cached_property
    def _harmonic_compliance(self) -> Array:
        """Galerkin compliances (families × (J + 1), 3, 3, n, n) times the norm of each harmonic:
        the integral π of cos² mθ over the circle, and 2π for the harmonics 0 and J."""
        norms = np.full(len(self.harmonics), np.pi)
        norms[[0, -1]] = 2 * np.pi
        families = self._harmonic_transform.shape[1] // len(norms)
        return np.concatenate([norms[:, None, None, None, None] * self.harmonics] * families)

    @cached_property
    def axisymmetric(self) -> ContactPoints:
        """Points of an axisymmetric contact: rings of equal radii, with one angle each.

        Used as long as no tangential load acts.
        """
        return replace(self, harmonics=self.harmonics[:1], circle=RingAngles.ONE)

    def repeat_angles(self, field: Array) -> Array:
        """Repeat an axisymmetric field, known at one angle per ring, at all angles (…, n count).

        If the field contains the area of a point as a factor, the caller divides the result by the
        number of angles.

        field  values of the n rings (…, n)
        """
        return np.repeat(field, self.count, axis=-1)

    def is_resolved(self, pressure: Array) -> bool:
        """Return true if the contact covers enough rings to resolve its edge and its stick zone.

        pressure  pressure at the points (n count,) [force/length²]
        """
        return bool(np.any(pressure[FEWEST * self.count :] > 0))

    def contact_area(self, pressure: Array) -> float:
        """Compute the contact area, whose edge is where p² extrapolates to zero [length²].

        An axisymmetric contact has dense nodes at its edge: p² is linear in r² through the last two
        nodes. Otherwise p² is a parabola in r², fitted to the nodes near the edge at every angle.

        pressure  pressure p at the points (n count,) [force/length²]
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
        """Return the square of the contact radius at one angle, by a pressure fit [length²].

        p² is fitted by a parabola in r², whose zero is the edge. If too few nodes have pressure, or
        the parabola has no zero near the edge, the result is the square of the radius of the last
        node with pressure.

        ray   pressure p at the n nodes at this angle (n,) [force/length²]
        last  index of the last node with pressure
        """
        r = self.radii
        first = min(int(np.searchsorted(r, (1 - BESIDE_EDGE) * r[last])), last + 1 - FITTED)
        if first < 0:
            return float(r[last] ** 2)
        near = slice(first, last + 1)
        square = r[last] ** 2
        places = r[near] ** 2 / square - 1
        roots = np.sqrt(self.weights[near])
        powers = roots[:, None] * np.vander(places, 3, increasing=True)
        level, slope, curvature = np.linalg.lstsq(powers, roots * ray[near] ** 2)[0]
        discriminant = slope**2 - 4 * curvature * level
        if not discriminant >= 0:
            return float(square)
        # The two zeros in a form without cancellation.
        half = -(slope + np.copysign(np.sqrt(discriminant), slope)) / 2
        with np.errstate(divide="ignore", invalid="ignore"):
            zeros = square * (1 + np.array([level / half, half / curvature]))
        beyond = zeros[zeros > r[last - 1] ** 2]
        return float(np.min(beyond) if len(beyond) else square)

    def stick_area(self, share: Array, shear: Array, bound: Array) -> float:
        """Compute the area of the stick zone, with its border between the points [length²].

        The stick zone of an axisymmetric contact ends where `share`, interpolated linearly in r, is
        1. The border in other contacts is found from the distance of the shear from gross slip
        (`stick_border`).

        share  trial shear |q - Δs/d| over the friction limit, with the slip Δs of the increment and
               the compliance d of the point (n count,) [1]
        shear  radial and circumferential shear q (2, n count) [force/length²]
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

        The interpolant on each of the n rings is a periodic spline in θ. Output angles include
        θ = 0.

        field  values at the points (n count,)
        sense  1 for a field that is even about θ = 0, -1 for an odd field; used for half a circle
        """
        return np.asarray(field.reshape(-1, self.count) @ self._interpolants[sense])

    @cached_property
    def _interpolants(self) -> dict[float, Array]:
        """Values of the splines of unit values at the output angles, by parity (count, angles)."""
        found = {}
        for sense in (1.0, -1.0):
            values, angles = np.eye(self.count), self.angles
            if self.circle is RingAngles.HALF:
                values = np.hstack([values, sense * values[:, ::-1]])
                angles = np.concatenate([angles, 2 * np.pi - angles[::-1]])
            values = np.hstack([values, values[:, :1]])
            angles = np.append(angles, angles[0] + 2 * np.pi)
            spline = CubicSpline(angles, values, axis=1, bc_type="periodic")
            found[sense] = np.asarray(spline(self.output_angles))
        return found

    @property
    def output_angles(self) -> Array:
        """Angles at which fields on the rings are output [radian].

        They include the direction θ = 0 of the load, unlike the angles of the points.
        """
        return self.circle.output_angles(self.highest)
