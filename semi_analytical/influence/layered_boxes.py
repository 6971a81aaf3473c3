"""Division of cells into integration boxes that are small compared with their distance from the
origin.

A point force acts at the origin. Gauss quadrature of its response is accurate on such boxes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Array, Indices, Mask

# Least distance of a box over its half side. For a function analytic except at the origin, POINTS
# Gauss points have the relative error (4 + sqrt 15)^(-2 POINTS) = 1e-18. The margin is for
# oscillating responses.
CLEARANCE = 4.0
POINTS = 10


@dataclass(frozen=True)
class Boxes:
    """Axis-parallel integration rectangles.

    x, y            centres (boxes,) [length]
    half_x, half_y  half sides (boxes,) [length]
    cell            index of the cell to which each box belongs (boxes,)
    """

    x: Array
    y: Array
    half_x: Array
    half_y: Array
    cell: Indices

    @staticmethod
    def single(x: float, y: float, half_x: float, half_y: float) -> Boxes:
        """Return a collection of one integration box, which belongs to cell 0.

        x, y            centre [length]
        half_x, half_y  half sides [length]
        """
        sides = np.array([half_x]), np.array([half_y])
        return Boxes(np.array([x]), np.array([y]), *sides, np.zeros(1, np.intp))

    def chosen(self, which: Mask | slice) -> Boxes:
        """Select some of the boxes by a mask or a slice."""
        return Boxes(*(values[which] for values in vars(self).values()))

    def batches(self, points: int) -> Iterator[Boxes]:
        """Split the boxes into batches with about `points` Gauss points each, to limit the
        memory."""
        size = max(1, points // POINTS**2)
        for start in range(0, len(self.x), size):
            yield self.chosen(slice(start, start + size))

    def gauss_points(self) -> tuple[Array, Array, Array]:
        """Return x, y and weight of the Gauss points of each box, each of shape (boxes,
        POINTS^2)."""
        nodes, weights = np.polynomial.legendre.leggauss(POINTS)
        s, t = (grid.ravel() for grid in np.meshgrid(nodes, nodes, indexing="ij"))
        area = np.outer(weights, weights).ravel()
        return (
            self.x[:, None] + self.half_x[:, None] * s,
            self.y[:, None] + self.half_y[:, None] * t,
            (self.half_x * self.half_y)[:, None] * area,
        )


def joined(parts: list[Boxes]) -> Boxes:
    """Concatenate several collections of boxes to one collection."""
    none = np.empty(0)
    empty = Boxes(none, none, none, none, np.empty(0, np.intp))
    columns = zip(*(vars(part).values() for part in (empty, *parts)), strict=True)
    return Boxes(*map(np.concatenate, columns))


def boxes_of_cells(spacing: tuple[float, float], cells: Indices) -> Boxes:
    """Divide cells into boxes until each box is small compared with its distance from the origin.

    spacing  cell sides [length]
    cells    offsets (i, j) of the cells (n, 2), without (0, 0)
    """
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
    """Divide the quadrant x, y > 0 of the cell at the origin into a core and boxes around the core.

    spacing  cell sides [length]
    radius   radius of a disc that contains the core [length]
    returns  half sides of the core, and the boxes between the core and the border of the cell
    """
    half_x, half_y = spacing[0] / 2, spacing[1] / 2
    parts = []
    while np.hypot(half_x, half_y) > radius:
        half_x, half_y = half_x / 2, half_y / 2
        # Centres in quarters of the previous side: 1 in the inner half, 3 in the outer half.
        for right, upper in ((3, 1), (1, 3), (3, 3)):
            parts.append(
                Boxes.single(right * half_x / 2, upper * half_y / 2, half_x / 2, half_y / 2)
            )
    return (half_x, half_y), _cut(joined(parts))


def _cut(boxes: Boxes) -> Boxes:
    """Halve integration boxes until all sides are small compared with the distance from the origin.

    Each box is halved along every side that is too long. The origin is the point of the force.
    """
    done = []
    while len(boxes.x):
        distance = np.hypot(boxes.x, boxes.y)
        long_x = CLEARANCE * boxes.half_x > distance
        long_y = CLEARANCE * boxes.half_y > distance
        done.append(boxes.chosen(~(long_x | long_y)))
        along_x, along_y = boxes.chosen(long_x), boxes.chosen(long_y & ~long_x)
        (left, right), (lower, upper) = _ends(along_x.half_x), _ends(along_y.half_y)
        boxes = joined(
            [
                *(replace(along_x, x=along_x.x + s, half_x=right) for s in (left, right)),
                *(replace(along_y, y=along_y.y + s, half_y=upper) for s in (lower, upper)),
            ]
        )
    return joined(done)


def _ends(half: Array) -> tuple[Array, Array]:
    """Return the centres of both halves of an interval, relative to the centre of the interval.

    half  half the length of the interval
    """
    return -half / 2, half / 2
