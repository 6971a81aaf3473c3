"""Integrals over the cells of a grid of the response of a layered body to a point force.

These integrals are the influence coefficients. The integration in real space has neither aliasing
nor periodic images. Cells near the singularity of the response are divided into boxes that are
small compared with their distance from it, and integrated by Gauss points. On other cells the
response at cell centres is averaged.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from contact_scene.array_types import Field, Indices

Response = Callable[[Field, Field], Field]

# Number of points evaluated at a time (some megabytes of work space).
BATCH = 1 << 16
# Cell average from the values at the centre and at four neighbours on each side; exact for
# polynomials of degree nine.
CELL_AVERAGE = (
    np.array([-27859, 399032, -3207892, 29039624, 412080590, 29039624, -3207892, 399032, -27859])
    / 464486400
)
MARGIN = len(CELL_AVERAGE) // 2
# Distance in cells beyond which the nine-point average of 1/r has a relative error below 4e-14.
FAR = 32
# Gauss points and weights along a side of a box, by its least distance d from the singularity over
# its half side. For a function analytic except there, n points have the relative error
# (d + sqrt(d^2 - 1))^(-2n) = 1e-18. The margin is for oscillating responses.
GAUSS = {least: np.polynomial.legendre.leggauss(n) for least, n in ((16.0, 6), (4.0, 10))}
CLEAR = min(GAUSS)
QUARTERS = np.array([(-1, -1), (-1, 1), (1, -1), (1, 1)])


def cell_integrals(
    response: Response,
    parities: Sequence[tuple[int, int]],
    spacing: tuple[float, float],
    shape: tuple[int, int],
    clearance: float = 0.0,
) -> Field:
    """Integrate a layered point-force response over cells at offsets i < nx, j < ny.

    The result has the shape (components, nx, ny). Without a clearance the integral over the cell at
    the origin, which contains the singularity, is not computed.

    response   function of x and y relative to the force that returns (components, *x.shape)
    parities   parity of each component along x and y: 1 even, -1 odd
    spacing    cell sides [length]
    shape      number of offsets nx, ny along x and y
    clearance  height of the singularity above the origin [length]
    """
    result = _average_cells(response, parities, spacing, shape)
    radius = FAR * max(spacing)
    i, j = (np.arange(min(n, int(radius / d) + 1)) for n, d in zip(shape, spacing, strict=True))
    distance = np.hypot(np.hypot((i * spacing[0])[:, None], j * spacing[1]), clearance)
    cells = np.argwhere((distance < radius) & (distance > 0))
    result[:, cells[:, 0], cells[:, 1]] = integrals_near(response, cells, spacing, clearance)
    for component, (along_x, along_y) in zip(result, parities, strict=True):
        # Odd components are exactly zero on their symmetry line.
        if along_x < 0:
            component[0, :] = 0
        if along_y < 0:
            component[:, 0] = 0
    return result


def _average_cells(
    response: Response,
    parities: Sequence[tuple[int, int]],
    spacing: tuple[float, float],
    shape: tuple[int, int],
) -> Field:
    """Integrate a point-force response over cells far from its singularity, from values at cell
    centres.

    The integral is a weighted average over nine cell centres along each axis, times the cell area.
    The result (components, nx, ny) is not accurate for cells near the singularity.

    response  function of x and y relative to the force that returns (components, *x.shape)
    parities  parity of each component along x and y: 1 even, -1 odd
    spacing   cell sides [length]
    shape     number of offsets nx, ny along x and y
    """
    x, y = ((np.arange(n + MARGIN) * d) for n, d in zip(shape, spacing, strict=True))
    points = np.empty((len(parities), len(x), len(y)))
    rows = max(1, BATCH // len(y))
    for start in range(0, len(x), rows):
        some = slice(start, start + rows)
        points[:, some] = response(*np.broadcast_arrays(x[some, None], y))
    points *= spacing[0] * spacing[1]
    result = np.empty((len(parities), *shape))
    for averaged, field, (along_x, along_y) in zip(result, points, parities, strict=True):
        averaged[:] = _average_first_axis(_average_first_axis(field, along_x).T, along_y).T
    return result


def _average_first_axis(field: Field, parity: int) -> Field:
    """Average a point-force response at offsets >= 0 over each cell along the first axis,
    from centre values of the parity 1 (even) or -1 (odd); the result is shorter by MARGIN."""
    both_sides = np.concatenate([parity * field[MARGIN:0:-1], field])
    windows = np.lib.stride_tricks.sliding_window_view(both_sides, len(CELL_AVERAGE), axis=0)
    return np.einsum("ijk,k->ij", windows, CELL_AVERAGE)


def integrals_near(
    response: Response, cells: Indices, spacing: tuple[float, float], clearance: float
) -> Any:
    """Integrate the response to a point force over cells near its singularity (components, n).

    Cells are divided into four boxes until each box is small compared with its distance from the
    singularity. The result is 0 if there are no cells.

    response   function of x and y relative to the force that returns (components, *x.shape)
    cells      offsets (i, j) of the cells (n, 2)
    spacing    cell sides [length]
    clearance  height of the singularity above the origin [length]
    """
    half, centres, cell = np.array(spacing) / 2, cells * np.array(spacing), np.arange(len(cells))
    total: Any = 0.0
    while len(cell):
        distance = np.hypot(np.hypot(centres[:, 0], centres[:, 1]), clearance) / np.max(half)
        large, farther = distance < CLEAR, np.inf
        for least, (nodes, weights) in GAUSS.items():
            inside = (distance >= least) & (distance < farther)
            boxes, of_boxes, farther = centres[inside], cell[inside], least
            to_x, to_y = np.stack(np.meshgrid(*np.outer(half, nodes), indexing="ij")).reshape(2, -1)
            at_once = BATCH // 4 // len(nodes) ** 2
            for start in range(0, len(boxes), at_once):
                x, y = boxes[start : start + at_once].T[..., None]
                values = response(x + to_x, y + to_y)
                integrals = values @ (half[0] * half[1] * np.outer(weights, weights).ravel())
                at = of_boxes[start : start + at_once]
                total = total + np.stack([np.bincount(at, one, len(cells)) for one in integrals])
        half = half / 2
        centres = (centres[large][:, None] + half * QUARTERS).reshape(-1, 2)
        cell = np.repeat(cell[large], len(QUARTERS))
    return total
