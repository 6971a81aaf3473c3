"""The part of the window that pressures are solved on: all of it, or a quarter."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

# What rounding leaves between images of a gap, relative to the largest.
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class Part:
    """All cells of the window, or its quarter x > 0, y > 0 where fields are even about both planes.

    Indices of the quarter count from the planes.
    """

    quarter: bool

    @property
    def images(self) -> int:
        """How often the part is in the window."""
        return 4 if self.quarter else 1

    def of(self, field: Field) -> Field:
        """A field of the window (nx, ny) on the part."""
        if not self.quarter:
            return field
        nx, ny = field.shape
        return np.ascontiguousarray(field[nx // 2 :, ny // 2 :])

    def unfolded(self, field: Field) -> Field:
        """A field of the part on the window (nx, ny)."""
        if not self.quarter:
            return field
        half = np.concatenate([field[::-1], field])
        return np.concatenate([half[:, ::-1], half], axis=1)

    def framed(self, field: NDArray[Any], width: int) -> NDArray[Any]:
        """A field of the part (nx, ny) in a frame of so many cells: its images beyond mirror
        planes, else nothing."""
        nx, ny = field.shape
        framed = np.zeros((nx + 2 * width, ny + 2 * width), dtype=field.dtype)
        framed[width : width + nx, width : width + ny] = field
        if self.quarter:
            images = slice(2 * width - 1, width - 1, -1)
            framed[:width] = framed[images]
            framed[:, :width] = framed[:, images]
        return framed

    def differences(self, field: Field) -> Field:
        """Slopes per cell of a field of the part along both axes (2, nx, ny): central differences,
        but at the ends of the window."""
        slopes = np.stack([np.gradient(field, axis=axis) for axis in (0, 1)])
        if self.quarter:
            slopes[0, 0] = (field[1] - field[0]) / 2
            slopes[1, :, 0] = (field[:, 1] - field[:, 0]) / 2
        return slopes


WHOLE = Part(quarter=False)


def part_of(gap: Field, *, even: bool) -> Part:
    """The part on which to solve below a gap (nx, ny): with a cell on a plane, the whole.

    even    whether the gap is known to be the same at (±x, ±y)
    raises  ValueError if it is not, to rounding
    """
    if not even or any(count % 2 for count in gap.shape):
        return WHOLE
    for image in (gap[::-1], gap[:, ::-1]):
        if np.array_equal(gap, image):  # as a rule, and soon known
            continue
        largest = np.max(np.abs(gap), where=np.isfinite(gap), initial=0.0)
        if not np.allclose(gap, image, rtol=0.0, atol=ROUND_OFF * largest):
            raise ValueError("the indenter says that it is even about x = 0 and y = 0: it is not")
    return Part(quarter=True)
