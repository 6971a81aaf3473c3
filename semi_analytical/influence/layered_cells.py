"""Integrals of the point response of a layered body over the cells of a grid: influence
coefficients."""

import numpy as np
from scipy.ndimage import correlate1d

from contact_scene.array_types import Field, Indices
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.closed_form import HalfSpaceCoefficients, RectangleIntegrals
from semi_analytical.influence.layered_boxes import Boxes, boxes_around_core, boxes_of_cells
from semi_analytical.influence.layered_response import BATCH, Components, point_response
from semi_analytical.influence.radial_table import RadialTable

# Cell average from the values at the centre and at four neighbours on each side; exact for
# polynomials of degree nine.
CELL_AVERAGE = (
    np.array([-27859, 399032, -3207892, 29039624, 412080590, 29039624, -3207892, 399032, -27859])
    / 464486400
)
MARGIN = len(CELL_AVERAGE) // 2
# Distance in cells beyond which the nine-point average of 1/r has a relative error below 4e-14.
FAR = 32


def cell_integrals(
    table: RadialTable,
    stack: Stack,
    components: Components,
    spacing: tuple[float, float],
    shape: tuple[int, int],
) -> Field:
    """Integrate the point response of a layered body over the cells at all offsets i < nx, j < ny.

    The result has the shape (components, nx, ny).

    table       point response up to MARGIN cells beyond the window
    components  displacement-traction pairs to be integrated
    spacing     cell sides [length]
    shape       number of offsets along x and y
    """
    result = _averaged(table, components, spacing, shape)
    cells = _near_cells(spacing, shape)
    result[:, cells[:, 0], cells[:, 1]] = _near(table, components, spacing, cells)
    result[:, 0, 0] = _loaded_cell(table, stack, components, spacing)
    for component, (parity_x, parity_y) in zip(result, components.parity, strict=True):
        # Odd components are exactly zero on their symmetry line.
        if parity_x < 0:
            component[0, :] = 0
        if parity_y < 0:
            component[:, 0] = 0
    return result


def _averaged(
    table: RadialTable,
    components: Components,
    spacing: tuple[float, float],
    shape: tuple[int, int],
) -> Field:
    """Integrate the point response over all cells from nine points per cell and direction.

    The result (components, nx, ny) is accurate only for cells far from the origin.
    """
    x = np.arange(shape[0] + MARGIN) * spacing[0]
    y = np.arange(shape[1] + MARGIN) * spacing[1]
    points = np.empty((len(components.names), len(x), len(y)))
    rows = max(1, BATCH // len(y))
    for start in range(0, len(x), rows):
        X, Y = np.broadcast_arrays(x[start : start + rows, None], y)
        X = np.where((X == 0) & (Y == 0), spacing[0], X)  # see `_loaded_cell`
        points[:, start : start + rows] = point_response(table, components, X, Y)
    result = np.empty((len(components.names), *shape))
    area = spacing[0] * spacing[1]
    for k, (parity_x, parity_y) in enumerate(components.parity):
        averaged = _averaged_along(_averaged_along(points[k], 0, parity_x), 1, parity_y)
        np.multiply(averaged, area, out=result[k])
    return result


def _averaged_along(field: Field, axis: int, parity: int) -> Field:
    """Average a response over the cells along one axis, from point values at offsets >= 0.

    The result is shorter by MARGIN.

    parity  parity of the response along the axis
    """
    mirrored = parity * np.flip(np.take(field, range(1, MARGIN + 1), axis), axis)
    whole = np.concatenate([mirrored, field], axis)
    averaged = correlate1d(whole, CELL_AVERAGE, axis)
    return np.take(averaged, range(MARGIN, whole.shape[axis] - MARGIN), axis)


def _near_cells(spacing: tuple[float, float], shape: tuple[int, int]) -> Indices:
    """Return the indices (i, j) of the cells closer to the origin than FAR, without the loaded
    cell.

    FAR is in units of the longer cell side.
    """
    radius = FAR * max(spacing)
    i = np.arange(min(shape[0], int(radius / spacing[0]) + 1))
    j = np.arange(min(shape[1], int(radius / spacing[1]) + 1))
    distance = np.hypot((i * spacing[0])[:, None], j * spacing[1])
    cells = np.argwhere(distance < radius)
    return cells[cells.any(axis=1)]


def _near(
    table: RadialTable,
    components: Components,
    spacing: tuple[float, float],
    cells: Indices,
) -> Field:
    """Integrate the point response over cells near the loaded cell by Gauss quadrature.

    The result has the shape (components, cells).

    table       radial functions of the point response
    components  displacement-traction pairs to be integrated
    spacing     cell sides [length]
    cells       indices (i, j) of the cells (cells, 2)
    """
    result = np.zeros((len(components.names), len(cells)))
    for start in range(0, len(cells), BATCH):
        of_batch = result[:, start : start + BATCH]
        for part in boxes_of_cells(spacing, cells[start : start + BATCH]).batches(BATCH):
            integrals = _integrals(table, components, part)
            for total, integral in zip(of_batch, integrals, strict=True):
                total += np.bincount(part.cell, integral, len(total))
    return result


def _loaded_cell(
    table: RadialTable, stack: Stack, components: Components, spacing: tuple[float, float]
) -> Field:
    """Integrate the point response over the loaded cell; shape (components,).

    Near the origin, within the first panel of the table, the closed form of the outer material
    contains the singularity. The rest of the cell is divided into boxes.
    """
    (core_x, core_y), boxes = boxes_around_core(spacing, table.core)
    quadrant = Boxes.single(core_x / 2, core_y / 2, core_x / 2, core_y / 2)
    result = 4 * _integrals(table.remainder(), components, quadrant)[:, 0]
    for part in boxes.batches(BATCH):
        result += 4 * _integrals(table, components, part).sum(axis=1)
    core = HalfSpaceCoefficients(RectangleIntegrals(2 * core_x, 2 * core_y, (1, 1)), *stack.outer)
    for k, (name, parity) in enumerate(zip(components.names, components.parity, strict=True)):
        # Odd components are zero at the loaded cell; four times a quadrant would be wrong.
        result[k] = result[k] + getattr(core, name)[0, 0] if parity == (1, 1) else 0
    return result


def _integrals(table: RadialTable, components: Components, boxes: Boxes) -> Field:
    """Integrate the point response of a layered body over boxes by Gauss quadrature.

    The result has the shape (components, boxes).

    table       radial functions of the point response
    components  displacement-traction pairs to be integrated
    boxes       integration rectangles
    """
    x, y, weight = boxes.gauss_points()
    values = point_response(table, components, x, y)
    integrals: Field = np.einsum("fbp,bp->fb", values, weight)
    return integrals
