"""Interpolation of a field between the cell centres of two grids."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]


def at_centres(cells: tuple[int, int], field: Field) -> Field:
    """A field (…, n, m) at the centres of other cells of the same window, bilinearly.

    Means over the other cells would not do: where they cut cells of the field in two, these count
    with the wrong part of their slope, an error of first order all over the surface.
    """
    along_x = _weights(cells[0], field.shape[-2])
    along_y = _weights(cells[1], field.shape[-1])
    return np.asarray(along_x @ field @ along_y.T)


def _weights(to: int, of: int) -> Field:
    """Weights (to, of) of linear interpolation between the centres of `of` equal intervals, at
    those of `to` others; constant beyond the outermost."""
    position = np.clip((np.arange(to) + 0.5) * of / to - 0.5, 0, of - 1)
    left = np.minimum(position.astype(int), max(of - 2, 0))
    weights = np.zeros((to, of))
    rows = np.arange(to)
    weights[rows, left] = 1 - (position - left)
    weights[rows, np.minimum(left + 1, of - 1)] += position - left
    return weights
