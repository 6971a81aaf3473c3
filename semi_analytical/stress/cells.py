"""Cell integrals of the tabulated response of layered bodies at depth.

The response to a point force is analytic up to a singularity at a distance above or below the
surface, the clearance. Cells that are small relative to their distance from the singularity need
few integration points. Other cells are divided adaptively and integrated by Gauss points. The
integrals are accurate to round-off for all cell sizes, layers and depths.
"""

from collections.abc import Iterator
from math import hypot

import numpy as np
from scipy.ndimage import correlate1d

from contact_scene.array_types import Field, Indices
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.layered_boxes import Boxes, joined
from semi_analytical.influence.layered_cells import CELL_AVERAGE, FAR, MARGIN
from semi_analytical.influence.layered_response import BATCH
from semi_analytical.stress.components import each_response, empty_response
from semi_analytical.stress.radial_table import DepthTable, clearance, depth_table, in_scene_axes

# Least distance of a box from the singularity in units of its half side, as for the surface.
CLEAR = 4.0

# Levels per table, so that its work space is some tens of megabytes.
AT_ONCE = 16


def cell_integrals(
    table: DepthTable,
    level: int,
    clearance: float,
    spacing: tuple[float, float],
    shape: tuple[int, int],
) -> Field:
    """Integrate displacement and stress by a unit traction over a cell, for all cell offsets (i, j)
    >= 0.

    table      radial functions, up to MARGIN cells beyond the farthest offset
    level      index of the depth in the table
    clearance  distance of the nearest singularity [length]
    spacing    cell sides [length]
    shape      number of offsets along x and y
    returns    shape (FIELDS, acting tractions, nx, ny)
    """
    result = _averaged(table, level, spacing, shape)
    cells = _near_cells(spacing, shape, clearance)
    boxes = _clear_boxes(spacing, cells, clearance)
    near = np.zeros((*result.shape[:2], len(cells)))
    for part in boxes.batches(BATCH // 4):
        x, y, weight = part.gauss_points()
        integrals = np.einsum("ftbp,bp->ftb", _response(table, level, x, y), weight)
        for total, integral in zip(
            near.reshape(-1, len(cells)), integrals.reshape(-1, len(part.x)), strict=True
        ):
            total += np.bincount(part.cell, integral, len(cells))
    result[:, :, cells[:, 0], cells[:, 1]] = near
    return _with_exact_zeros(result)


def _with_exact_zeros(result: Field) -> Field:
    """Set odd displacement and stress responses to exactly zero on their symmetry lines, in place.

    result  responses (FIELDS, acting tractions, nx, ny) at offsets >= 0
    """
    for coefficients, (along_x, along_y) in each_response(result):
        if along_x < 0:
            coefficients[0, :] = 0
        if along_y < 0:
            coefficients[:, 0] = 0
    return result


def _response(table: DepthTable, level: int, x: Field, y: Field) -> Field:
    """Compute displacement and stress by unit point forces; shape (FIELDS, acting tractions,
    *x.shape).

    x, y  position relative to the force [length]
    """
    r = np.hypot(x, y)
    away = np.where(r > 0, r, 1.0)  # on the axis functions of the direction vanish
    functions = table.at(level, r.ravel()).reshape(-1, *x.shape)
    return in_scene_axes(functions, np.where(r > 0, x / away, 1.0), y / away)


def _averaged(
    table: DepthTable, level: int, spacing: tuple[float, float], shape: tuple[int, int]
) -> Field:
    """Average displacement and stress over all cells from nine points per cell and direction.

    The result is accurate only for cells far from the singularity.

    spacing  cell sides [length]
    shape    number of offsets along x and y
    """
    x = np.arange(shape[0] + MARGIN) * spacing[0]
    y = np.arange(shape[1] + MARGIN) * spacing[1]
    points = empty_response((len(x), len(y)), sheared=table.sheared)
    rows = max(1, BATCH // len(y))
    for start in range(0, len(x), rows):
        part = slice(start, start + rows)
        points[:, :, part] = _response(table, level, *np.broadcast_arrays(x[part, None], y))
    points *= spacing[0] * spacing[1]
    result = empty_response(shape, sheared=table.sheared)
    for averaged, (of_points, (along_x, along_y)) in zip(
        result.reshape(-1, *shape), each_response(points), strict=True
    ):
        averaged[:] = _averaged_along(_averaged_along(of_points, 0, along_x), 1, along_y)
    return result


def _averaged_along(field: Field, axis: int, sign: int) -> Field:
    """Average a response over the cells along one axis, from point values at offsets >= 0.

    The result is shorter by MARGIN.

    sign  parity of the response along the axis
    """
    mirrored = sign * np.flip(np.take(field, range(1, MARGIN + 1), axis), axis)
    averaged = correlate1d(np.concatenate([mirrored, field], axis), CELL_AVERAGE, axis)
    return np.take(averaged, range(MARGIN, averaged.shape[axis] - MARGIN), axis)


def _near_cells(spacing: tuple[float, float], shape: tuple[int, int], clearance: float) -> Indices:
    """Return the indices (i, j) of cells closer to the singularity than FAR times their longer
    side.

    clearance  distance of the singularity from the cell at the origin [length]
    """
    radius = FAR * max(spacing)
    i = np.arange(min(shape[0], int(radius / spacing[0]) + 1))
    j = np.arange(min(shape[1], int(radius / spacing[1]) + 1))
    distance = np.hypot(np.hypot((i * spacing[0])[:, None], j * spacing[1]), clearance)
    return np.argwhere(distance < radius)


def _clear_boxes(spacing: tuple[float, float], cells: Indices, clearance: float) -> Boxes:
    """Divide cells into boxes until each box is small relative to its distance from the
    singularity.

    cells      indices (n, 2) of the cells
    clearance  distance of the singularity from the cell at the origin [length]
    """
    count = len(cells)
    offsets = cells.astype(np.float64)
    boxes = Boxes(
        offsets[:, 0] * spacing[0],
        offsets[:, 1] * spacing[1],
        np.full(count, spacing[0] / 2, np.float64),
        np.full(count, spacing[1] / 2, np.float64),
        np.arange(count),
    )
    done = []
    while len(boxes.x):
        distance = np.hypot(np.hypot(boxes.x, boxes.y), clearance)
        long = CLEAR * np.maximum(boxes.half_x, boxes.half_y) > distance
        done.append(boxes.chosen(~long))
        boxes = _quartered(boxes.chosen(long))
    return joined(done)


def _quartered(boxes: Boxes) -> Boxes:
    """Divide each integration box into four boxes of half the sides."""
    half_x, half_y = boxes.half_x / 2, boxes.half_y / 2
    return joined(
        [
            Boxes(boxes.x + a * half_x, boxes.y + b * half_y, half_x, half_y, boxes.cell)
            for a in (-1, 1)
            for b in (-1, 1)
        ]
    )


def layered_coefficients(
    stack: Stack,
    levels: tuple[Level, ...],
    spacing: tuple[float, float],
    shape: tuple[int, int],
    *,
    sheared: bool,
) -> Iterator[Field]:
    """Iterate over the response of a layered body to unit tractions on one cell, at each depth.

    The response are displacements [length^3/force] and stresses [1] at all cell offsets >= 0. At a
    depth in the outermost layer, the response of a half-space of its material is excluded.

    stack    layers and base of the body
    levels   depths, each with the index of its layer
    spacing  cell sides [length]
    shape    number of offsets along x and y, including zero
    sheared  include the responses to shear, before those to pressure
    yields   shape (FIELDS, acting tractions, nx, ny)
    """
    reach = hypot((shape[0] + MARGIN) * spacing[0], (shape[1] + MARGIN) * spacing[1])
    for start in range(0, len(levels), AT_ONCE):
        batch = levels[start : start + AT_ONCE]
        table = depth_table(stack, batch, reach, sheared=sheared)
        for index, level in enumerate(batch):
            yield cell_integrals(table, index, clearance(stack, level), spacing, shape)
