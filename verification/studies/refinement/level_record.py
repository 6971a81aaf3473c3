"""What one level of refinement gave, whoever solved it."""

from __future__ import annotations

import base64

import numpy as np
from numpy.typing import NDArray

from contact_scene.description import Description

STORED = np.dtype("<f4")  # differences of less than 1e-6 are below every tolerance in use

Field = NDArray[np.float64]


class StoredField(Description):
    """A vector field on the cells of a window, short enough for a record.

    Any solver may sample its field so; fields of several levels must cover the same window.
    """

    cells: tuple[int, int]
    values: str
    """Base64 of little-endian float32, index [component, i, j]."""

    @classmethod
    def of(cls, field: Field) -> StoredField:
        """Store a field (2, nx, ny)."""
        _, nx, ny = field.shape
        data = np.ascontiguousarray(field, dtype=STORED).tobytes()
        return cls(cells=(nx, ny), values=base64.b64encode(data).decode("ascii"))

    def field(self) -> Field:
        """The field (2, nx, ny)."""
        data = np.frombuffer(base64.b64decode(self.values), dtype=STORED)
        return data.reshape(2, *self.cells).astype(float)


class LevelRecord(Description):
    """The end of the studied step on one level."""

    size: float
    """h: cell side [length], or one over the number of increments."""

    cells: tuple[int, int]
    increments: tuple[int, ...]
    values: dict[str, float]
    """Scalars by the names of `summary.json`, components with x or y; the undefined left out."""

    shear: StoredField | None
    limit: float
    """Mean of the friction limit µp over the window [force/length²]."""

    largest_residual: float
    iterations: int
    convolutions: int | None
    seconds: float


def shear_change(coarse: LevelRecord, fine: LevelRecord) -> float | None:
    """∫|q_coarse - q_fine| over ∫µp_fine, at the centres of the coarse cells [1].

    None without shear or without friction.
    """
    if coarse.shear is None or fine.shear is None or fine.limit == 0:
        return None
    difference = coarse.shear.field() - at_centres(coarse.cells, fine.shear.field())
    return float(np.mean(np.hypot(*difference)) / fine.limit)


def at_centres(cells: tuple[int, int], field: Field) -> Field:
    """A field (…, nx, ny) at the centres of other cells of the same window, bilinearly.

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
