"""Contact edge as points with normals and curvatures, and distances of other points from it.

The edge pressure law of layered bodies needs the distance of each cell from the edge.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.operator.domain import ReducedDomain

# Number of nearest edge points that determine the geometry at a place. The farthest has zero
# weight, so that the choice among equally distant points does not matter (mirror symmetry).
NEIGHBOURS = 5
# Lower bounds of the slope inside over that at the edge, and of 1 - κ s.
MIN_SLOPE_RATIO = 0.1
MIN_JACOBIAN = 0.3


@dataclass(frozen=True)
class LocalEdge:
    """Distance from the contact edge and geometry of the edge near points, arrays of one shape.

    φ = p^(1/α) is a smooth function that vanishes at the edge, with the pressure p ~ s^α at the
    distance s from the edge.

    distance   distance s of the points from the edge, negative outside the contact
    normal     inward unit normal of the edge (2, …)
    slope      derivative of φ along the normal, at the edge
    bend       second derivative of φ along the normal
    curvature  curvature κ of the edge, positive for a convex contact area
    """

    distance: Field
    normal: Field
    slope: Field
    bend: Field
    curvature: Field

    @property
    def slope_at_place(self) -> Field:
        """Slope of φ = p^(1/α) along the edge normal at the given points, not at the edge.

        p is the pressure. The slope is at least MIN_SLOPE_RATIO of the slope at the edge.
        """
        inside = self.slope + self.bend * self.distance
        return np.maximum(inside, MIN_SLOPE_RATIO * self.slope)

    @property
    def foot(self) -> Field:
        """Vectors (2, …) from the given points to the nearest points of the contact edge."""
        return -self.distance * self.normal


@dataclass(frozen=True)
class EdgeLine:
    """Points of the contact edge, one per cell along the edge, with the local geometry of the edge.

    at         indices of the cells along the edge (2, n)
    x, y       edge point nearest to each cell, as cell indices (n,)
    normal     inward unit normal of the edge (2, n)
    slope      derivative of φ = p^(1/α) along the normal, at the edge, with the pressure p (n,)
    bend       second derivative of φ along the normal (n,)
    curvature  curvature of the edge, positive for a convex contact area (n,)
    stretched  sides of a cell along x and y in the unit of distances
    """

    at: Field
    x: Field
    y: Field
    normal: Field
    slope: Field
    bend: Field
    curvature: Field
    stretched: tuple[float, float]

    @classmethod
    def from_fits(cls, phi: Quadratic, stretched: tuple[float, float]) -> EdgeLine:
        """Compute the points of the contact edge from local fits of φ, one edge point per fit.

        φ = p^(1/α) is a function of the pressure p that vanishes at the edge. The edge point is the
        point with φ = 0 on the line along the gradient of φ.

        phi        quadratics of φ about the cells along the edge (n,)
        stretched  sides of a cell along x and y in the unit of distances
        """
        q = phi.in_scaled_axes(*stretched)
        steep = np.maximum(q.slope, np.finfo(float).tiny)
        n_x, n_y = q.f_x / steep, q.f_y / steep
        bend = q.f_xx * n_x**2 + 2 * q.f_xy * n_x * n_y + q.f_yy * n_y**2
        along = q.f_xx * n_y**2 - 2 * q.f_xy * n_x * n_y + q.f_yy * n_x**2
        slope = np.sqrt(np.maximum(steep**2 - 2 * q.f * bend, (MIN_SLOPE_RATIO * steep) ** 2))
        s = 2 * q.f / (steep + slope)
        return cls(
            np.stack([phi.x, phi.y]),
            phi.x - s * n_x / stretched[0],
            phi.y - s * n_y / stretched[1],
            np.stack([n_x, n_y]),
            slope,
            bend,
            -along / slope,
            stretched,
        )

    def use_median_curvature(self) -> EdgeLine:
        """Replace the curvature and the ratio bend/slope of the edge points by their medians.

        Used for the first approximations of the edge, whose second derivatives are not yet
        reliable.
        """
        bend = self.slope * np.median(self.bend / self.slope)
        curvature = np.full_like(bend, np.median(self.curvature))
        return replace(self, bend=bend, curvature=curvature)

    def append_images(self, domain: ReducedDomain) -> EdgeLine:
        """Append the mirror images of the edge points beyond the planes of a reduced domain.

        domain  reduced domain; without mirror planes the edge is returned unchanged
        """
        line = self
        for axis in domain.planes:
            one, image = vars(line), vars(line._reflect_points(axis))
            both: dict[str, Any] = {
                name: np.concatenate([one[name], image[name]], axis=-1)
                for name in one.keys() - {"stretched"}
            }
            line = replace(line, **both)
        return line

    def _reflect_points(self, axis: int) -> EdgeLine:
        """Reflect the points about the symmetry plane normal to `axis`,
        half a cell before the first cell."""
        at, normal, places = self.at.copy(), self.normal.copy(), [self.x, self.y]
        at[axis], normal[axis], places[axis] = -1 - at[axis], -normal[axis], -1 - places[axis]
        return replace(self, at=at, x=places[0], y=places[1], normal=normal)

    def geometry_at_cells(self, i: Indices, j: Indices) -> LocalEdge:
        """Compute the distance of cell centres from the edge, and the edge geometry near them.

        The results are weighted means over the values of the NEIGHBOURS nearest edge points.

        i, j  indices of the cells (n,)
        """
        from scipy.spatial import KDTree  # its import takes as long as a small contact

        count = min(NEIGHBOURS, len(self.x))
        far, which = KDTree(self.at.T).query(np.stack([i, j], axis=-1), k=count)
        weight = far[:, -1:] ** 2 - far**2 + 1e-9
        weight /= np.sum(weight, axis=1, keepdims=True)
        each = self.geometry_at_places(which, i[:, None], j[:, None])
        s, n_x, n_y, slope, bend, curvature = (
            np.sum(weight * part, axis=-1)
            for part in (each.distance, *each.normal, each.slope, each.bend, each.curvature)
        )
        return LocalEdge(s, np.stack([n_x, n_y]) / np.hypot(n_x, n_y), slope, bend, curvature)

    def geometry_at_places(
        self, which: Indices | slice, x: Field | Indices, y: Field | Indices
    ) -> LocalEdge:
        """Compute the distance of points from the edge, and the edge geometry near them.

        Each point uses one edge point, near which the edge is a circular arc. Distances are of
        first order in the curvature of the arc.

        which  indices of the edge points; broadcast with x and y
        x, y   points as cell indices
        """
        dx, dy = (
            (at - of[which]) * side
            for at, of, side in zip((x, y), (self.x, self.y), self.stretched, strict=True)
        )
        n_x, n_y = self.normal[:, which]
        curvature = self.curvature[which]
        inwards, across = n_x * dx + n_y * dy, n_x * dy - n_y * dx
        tangent = curvature * across / np.maximum(1 - curvature * inwards, MIN_JACOBIAN)
        normal = np.stack([n_x + tangent * n_y, n_y - tangent * n_x]) / np.sqrt(1 + tangent**2)
        slope, bend, curvature = (
            np.broadcast_to(part[which], dx.shape)
            for part in (self.slope, self.bend, self.curvature)
        )
        return LocalEdge(inwards - tangent * across / 2, normal, slope, bend, curvature)
