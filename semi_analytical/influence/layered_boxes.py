"""Boxes on which a function like 1/r is smooth: each small against its distance from the origin."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Array, Indices, Mask

# Distance of a box in units of its half side. A function analytic but at the origin is then
# integrated by POINTS Gauss points to (4 + sqrt 15)^(-2 POINTS) = 1e-18 of itself; the margin is
# for responses that wave.
CLEARANCE = 4.0
POINTS = 10


@dataclass(frozen=True)
class Boxes:
    """Axis-parallel rectangles: centres, half sides [length] and the cell each belongs to."""

    x: Array
    y: Array
    half_x: Array
    half_y: Array
    cell: Indices

    @staticmethod
    def single(x: float, y: float, half_x: float, half_y: float) -> Boxes:
        """One box, of cell 0."""
        sides = np.array([half_x]), np.array([half_y])
        return Boxes(np.array([x]), np.array([y]), *sides, np.zeros(1, np.intp))

    def chosen(self, which: Mask | slice) -> Boxes:
        """Some of the boxes."""
        return Boxes(
            self.x[which], self.y[which], self.half_x[which], self.half_y[which], self.cell[which]
        )

    def batches(self, points: int) -> Iterator[Boxes]:
        """The boxes in parts of at most about so many Gauss points."""
        size = max(1, points // POINTS**2)
        for start in range(0, len(self.x), size):
            yield self.chosen(slice(start, start + size))

    def gauss_points(self) -> tuple[Array, Array, Array]:
        """Coordinates and weights, each of shape (boxes, POINTS^2)."""
        nodes, weights = np.polynomial.legendre.leggauss(POINTS)
        s, t = (grid.ravel() for grid in np.meshgrid(nodes, nodes, indexing="ij"))
        area = np.outer(weights, weights).ravel()
        return (
            self.x[:, None] + self.half_x[:, None] * s,
            self.y[:, None] + self.half_y[:, None] * t,
            (self.half_x * self.half_y)[:, None] * area,
        )


def joined(parts: list[Boxes]) -> Boxes:
    """All boxes of several collections."""
    none = np.empty(0)
    parts = [Boxes(none, none, none, none, np.empty(0, np.intp)), *parts]
    return Boxes(
        np.concatenate([part.x for part in parts]),
        np.concatenate([part.y for part in parts]),
        np.concatenate([part.half_x for part in parts]),
        np.concatenate([part.half_y for part in parts]),
        np.concatenate([part.cell for part in parts]),
    )


def boxes_of_cells(spacing: tuple[float, float], cells: Indices) -> Boxes:
    """Cells at index offsets (i, j), not (0, 0), cut until every box is clear of the origin."""
    count = len(cells)
    offsets = cells.astype(np.float64)
    return _cut(
        Boxes(
            offsets[:, 0] * spacing[0],
            offsets[:, 1] * spacing[1],
            np.full(count, spacing[0] / 2, np.float64),
            np.full(count, spacing[1] / 2, np.float64),
            np.arange(count),
        )
    )


def boxes_around_core(
    spacing: tuple[float, float], radius: float
) -> tuple[tuple[float, float], Boxes]:
    """One quadrant of the cell at the origin, less a core that a disc of `radius` contains.

    returns  half sides of the core, and the boxes between core and border in the quadrant x, y > 0
    """
    half_x, half_y = spacing[0] / 2, spacing[1] / 2
    parts = []
    while np.hypot(half_x, half_y) > radius:
        half_x, half_y = half_x / 2, half_y / 2
        # Centres in quarters of the old side: 1 in its inner, 3 in its outer half.
        for right, upper in ((3, 1), (1, 3), (3, 3)):
            parts.append(
                Boxes.single(right * half_x / 2, upper * half_y / 2, half_x / 2, half_y / 2)
            )
    return (half_x, half_y), _cut(joined(parts))


def _cut(boxes: Boxes) -> Boxes:
    """Halve every box along the sides that are not small against its distance."""
    done = []
    while len(boxes.x):
        distance = np.hypot(boxes.x, boxes.y)
        long_x = CLEARANCE * boxes.half_x > distance
        long_y = CLEARANCE * boxes.half_y > distance
        done.append(boxes.chosen(~(long_x | long_y)))
        boxes = joined([_halved_x(boxes.chosen(long_x)), _halved_y(boxes.chosen(long_y & ~long_x))])
    return joined(done)


def _halved_x(boxes: Boxes) -> Boxes:
    quarter = boxes.half_x / 2
    return joined(
        [
            Boxes(boxes.x + shift, boxes.y, quarter, boxes.half_y, boxes.cell)
            for shift in (-quarter, quarter)
        ]
    )


def _halved_y(boxes: Boxes) -> Boxes:
    quarter = boxes.half_y / 2
    return joined(
        [
            Boxes(boxes.x, boxes.y + shift, boxes.half_x, quarter, boxes.cell)
            for shift in (-quarter, quarter)
        ]
    )
