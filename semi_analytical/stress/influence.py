"""Influence coefficients at depth: fields by unit tractions on one cell of the surface."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot

import numpy as np
from numpy.typing import NDArray

from semi_analytical.frf.depth import Level, material_at
from semi_analytical.frf.stack import Stack
from semi_analytical.influence.layered_cells import MARGIN
from semi_analytical.stress.cells import cell_integrals
from semi_analytical.stress.radial_table import clearance, depth_table
from semi_analytical.stress.rectangle import RectanglePotentials, half_space_response

Field = NDArray[np.float64]

# Levels that share one table: its work space stays some tens of megabytes.
AT_ONCE = 16


def depth_coefficients(
    stack: Stack, levels: tuple[Level, ...], spacing: tuple[float, float], shape: tuple[int, int]
) -> Iterator[Field]:
    """Fields at offset (i dx, j dy), i, j >= 0, of each level in turn.

    Closed form of the outermost material within it, plus what the layers add; below it the whole
    response, tabulated. Other quadrants follow by `components.parity`. Displacements
    [length^3/force], stresses dimensionless.

    spacing  cell sides [length]
    shape    number of offsets along x and y, the zero offset included
    yields   shape (FIELDS, TRACTIONS, nx, ny)
    """
    for start in range(0, len(levels), AT_ONCE):
        batch = levels[start : start + AT_ONCE]
        if not stack.layers:
            yield from (_closed_form(stack, level, spacing, shape) for level in batch)
            continue
        reach = hypot((shape[0] + MARGIN) * spacing[0], (shape[1] + MARGIN) * spacing[1])
        table = depth_table(stack, batch, reach)
        for index, level in enumerate(batch):
            result = cell_integrals(table, index, clearance(stack, level), spacing, shape)
            if level.layer == 0:
                result += _closed_form(stack, level, spacing, shape)
            yield result


def _closed_form(
    stack: Stack, level: Level, spacing: tuple[float, float], shape: tuple[int, int]
) -> Field:
    """A half-space of the material at this level."""
    x = (np.arange(shape[0] + 1, dtype=np.float64) - 0.5) * spacing[0]
    y = (np.arange(shape[1] + 1, dtype=np.float64) - 0.5) * spacing[1]
    potentials = RectanglePotentials(x, y, level.depth)
    return half_space_response(potentials, material_at(stack, level), level.depth)
