"""The part of the window that tractions are solved on: all of it, or a quarter."""

from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
AnyField = TypeVar("AnyField", bound=NDArray[Any])

# What rounding leaves between images of a gap, relative to the largest.
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class Part:
    """All cells of the window, or its quarter x > 0, y > 0 where fields are even about both planes.

    Indices of the quarter count from the planes.

    along  component of vectors that is even about both planes as well; the other is odd about both.
           None where no vectors are told by the quarter
    """

    quarter: bool
    along: int | None = None

    @property
    def images(self) -> int:
        """How often the part is in the window."""
        return 4 if self.quarter else 1

    @property
    def even(self) -> tuple[bool, bool]:
        """Whether the sums of vectors' components are as many times those on the part; those of odd
        ones vanish."""
        return (True, True) if self.along is None else (self.along == 0, self.along == 1)

    def cells(self, window: tuple[int, int]) -> tuple[int, int]:
        """How many there are of the cells of the window."""
        return (window[0] // 2, window[1] // 2) if self.quarter else window

    def slices(self, window: tuple[int, int]) -> tuple[slice, slice]:
        """Which of the cells of the window they are."""
        nx, ny = self.cells(window)
        return slice(window[0] - nx, None), slice(window[1] - ny, None)

    def of(self, field: Field) -> Field:
        """A field of the window (nx, ny) on the part."""
        return np.ascontiguousarray(field[self.slices(field.shape)]) if self.quarter else field

    def unfolded(self, field: AnyField, sign: int = 1) -> AnyField:
        """A field of the part on the window (nx, ny), even about both planes or odd about both."""
        if not self.quarter:
            return field
        nx, ny = field.shape
        whole = np.empty_like(field, shape=(2 * nx, 2 * ny))
        image = field if sign > 0 else 0.0 - field  # zeros stay positive
        whole[nx:, ny:], whole[:nx, :ny] = field, field[::-1, ::-1]
        whole[:nx, ny:], whole[nx:, :ny] = image[::-1], image[:, ::-1]
        return whole

    def unfolded_vector(self, field: Field) -> Field:
        """A vector field of the part (2, …) on the window (2, nx, ny)."""
        if not self.quarter:
            return field
        signs = (1 if even else -1 for even in self.even)
        return np.stack([self.unfolded(one, sign) for one, sign in zip(field, signs, strict=True)])

    def resultant(self, field: Field) -> Field:
        """Sums of the components of a vector field over the whole window (2,)."""
        return np.where(self.even, self.images * np.sum(field, axis=(1, 2)), 0.0)

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
        framed, slopes = self.framed(field, 1), np.empty((2, *field.shape))
        np.subtract(framed[2:, 1:-1], framed[:-2, 1:-1], out=slopes[0])
        np.subtract(framed[1:-1, 2:], framed[1:-1, :-2], out=slopes[1])
        slopes /= 2
        slopes[0, -1], slopes[1, :, -1] = field[-1] - field[-2], field[:, -1] - field[:, -2]
        if not self.quarter:
            slopes[0, 0], slopes[1, :, 0] = field[1] - field[0], field[:, 1] - field[:, 0]
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
