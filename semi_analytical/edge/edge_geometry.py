"""The edge of a region as a line: where it is next to cells, and how far places are from it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.operator.domain import ReducedDomain

# Places see the line from so many of its cells, the last of them with no weight: of cells that are
# equally far none is to be preferred, or a mirror image would not be one.
SEEN = 5
# Of the slope of phi inside, of that at the edge, at least; and of 1 - κ s.
LEAST_SLOPE, LEAST_TURN = 0.1, 0.3


@dataclass(frozen=True)
class Seen:
    """The edge as places see it, all of one shape.

    distance   s from it, negative outside
    normal     (2, …) unit vector inwards, there
    slope      of phi at the edge, along the normal
    bend       second derivative of phi along the normal
    curvature  κ of the edge, positive about what is convex
    """

    distance: Field
    normal: Field
    slope: Field
    bend: Field
    curvature: Field

    @property
    def slope_here(self) -> Field:
        """Of phi at the places."""
        inside = self.slope + self.bend * self.distance
        return np.maximum(inside, LEAST_SLOPE * self.slope)

    @property
    def foot(self) -> Field:
        """From the places to the edge (2, …)."""
        return -self.distance * self.normal


@dataclass(frozen=True)
class EdgeLine:
    """Points of the edge, one per cell along it, shape (n,), in index coordinates.

    at           (2, n) the cells
    x, y         points of the edge nearest to them
    normal       (2, n); this and the rest as of `Seen`
    stretched    lengths of the sides of a cell, the units of lengths
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
    def of(cls, phi: Quadratic, stretched: tuple[float, float]) -> EdgeLine:
        """The edge next to the middles of quadratics."""
        q = phi.scaled(*stretched)
        steep = np.maximum(q.slope, np.finfo(float).tiny)
        n_x, n_y = q.f_x / steep, q.f_y / steep
        bend = q.f_xx * n_x**2 + 2 * q.f_xy * n_x * n_y + q.f_yy * n_y**2
        along = q.f_xx * n_y**2 - 2 * q.f_xy * n_x * n_y + q.f_yy * n_x**2
        slope = np.sqrt(np.maximum(steep**2 - 2 * q.f * bend, (LEAST_SLOPE * steep) ** 2))
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

    def evened(self) -> EdgeLine:
        """With the same curvature everywhere, and bends in the same ratio to slopes: the medians,
        where second derivatives are not to be believed yet."""
        bend = self.slope * np.median(self.bend / self.slope)
        curvature = np.full_like(bend, np.median(self.curvature))
        return replace(self, bend=bend, curvature=curvature)

    def with_images(self, domain: ReducedDomain) -> EdgeLine:
        """With the images of its points beyond the mirror planes of a domain."""
        line = self
        for axis in domain.planes:
            line = line._beside(line._mirrored(axis))
        return line

    def _mirrored(self, axis: int) -> EdgeLine:
        """At a plane half a cell before the first."""
        at, normal, places = self.at.copy(), self.normal.copy(), [self.x, self.y]
        at[axis], normal[axis], places[axis] = -1 - at[axis], -normal[axis], -1 - places[axis]
        return replace(self, at=at, x=places[0], y=places[1], normal=normal)

    def _beside(self, other: EdgeLine) -> EdgeLine:
        """Both."""
        at, normal = (
            np.concatenate(pair, axis=1)
            for pair in ((self.at, other.at), (self.normal, other.normal))
        )
        x, y, slope, bend, curvature = (
            np.concatenate(pair)
            for pair in (
                (self.x, other.x),
                (self.y, other.y),
                (self.slope, other.slope),
                (self.bend, other.bend),
                (self.curvature, other.curvature),
            )
        )
        return EdgeLine(at, x, y, normal, slope, bend, curvature, self.stretched)

    def seen_from(self, i: Indices, j: Indices) -> Seen:
        """From cells (n,), each by the points that are nearest."""
        from scipy.spatial import KDTree  # as long to import as a small contact takes

        count = min(SEEN, len(self.x))
        far, which = KDTree(self.at.T).query(np.stack([i, j], axis=-1), k=count)
        weight = far[:, -1:] ** 2 - far**2 + 1e-9
        weight /= np.sum(weight, axis=1, keepdims=True)
        each = self.seen_by(which, i[:, None], j[:, None])
        s, n_x, n_y, slope, bend, curvature = (
            np.sum(weight * part, axis=-1)
            for part in (each.distance, *each.normal, each.slope, each.bend, each.curvature)
        )
        return Seen(s, np.stack([n_x, n_y]) / np.hypot(n_x, n_y), slope, bend, curvature)

    def seen_by(self, which: Indices | slice, x: Field | Indices, y: Field | Indices) -> Seen:
        """As places that broadcast with these see the points `which`."""
        dx, dy = (
            (at - of[which]) * side
            for at, of, side in zip((x, y), (self.x, self.y), self.stretched, strict=True)
        )
        n_x, n_y = self.normal[:, which]
        curvature = self.curvature[which]
        inwards, across = n_x * dx + n_y * dy, n_x * dy - n_y * dx
        turn = curvature * across / np.maximum(1 - curvature * inwards, LEAST_TURN)
        normal = np.stack([n_x + turn * n_y, n_y - turn * n_x]) / np.sqrt(1 + turn**2)
        slope, bend, curvature = (
            np.broadcast_to(part[which], dx.shape)
            for part in (self.slope, self.bend, self.curvature)
        )
        return Seen(inwards - turn * across / 2, normal, slope, bend, curvature)
