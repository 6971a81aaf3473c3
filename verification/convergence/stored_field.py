"""Tractions that levels of refinement, or solvers, are compared by."""

from __future__ import annotations

import base64

import numpy as np
from numpy.typing import NDArray

from contact_scene.description import Description

PRESSURE, SHEAR = "pressure", "shear"
STORED = np.dtype("<f4")  # differences of less than 1e-6 are below every tolerance in use

Field = NDArray[np.float64]


class StoredField(Description):
    """A traction on patches of equal area, short enough for a record.

    Any solver may sample its field so: on the cells of a window, or on rings and sectors of a disc.
    Fields of several levels must cover the same part of the surface.
    """

    patches: tuple[int, int]
    values: str
    """Base64 of little-endian float32, index [component, i, j]."""

    scale: float
    """What changes are relative to: the mean of the pressure or of the friction limit."""

    @classmethod
    def of(cls, field: Field, scale: float) -> StoredField:
        """Store a field (components, n, m)."""
        _, n, m = field.shape
        data = np.ascontiguousarray(field, dtype=STORED).tobytes()
        return cls(patches=(n, m), values=base64.b64encode(data).decode("ascii"), scale=scale)

    def field(self) -> Field:
        """The field (components, n, m)."""
        data = np.frombuffer(base64.b64decode(self.values), dtype=STORED)
        return data.reshape(-1, *self.patches).astype(float)


def change(coarse: StoredField, fine: StoredField) -> float | None:
    """∫|f_coarse - f_fine| over ∫ of the scale, at the centres of the coarse patches [1].

    None where the scale vanishes: a shear without friction.
    """
    if fine.scale == 0:
        return None
    difference = coarse.field() - at_centres(coarse.patches, fine.field())
    return float(np.mean(np.sqrt(np.sum(difference**2, axis=0))) / fine.scale)


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
