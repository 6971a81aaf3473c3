"""The part of the window that tractions are solved on: all of it, half of it or a quarter."""

from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
AnyField = TypeVar("AnyField", bound=NDArray[Any])
Pair = tuple[int, int]

# What rounding leaves between images of a gap, relative to the largest.
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class Parity:
    """Of a field on a part of the window.

    signs   about the planes x = 0 and y = 0: even (1), odd (-1), or not mirrored (0)
    turned  whether its amplitudes are counted a quarter of a wave further, so that those of all
            fields follow from each other by real numbers
    """

    signs: Pair
    turned: bool = False

    @property
    def phase(self) -> complex:
        """Spectrum over amplitude: sines are -i times as much, each."""
        phase: complex = (-1j) ** (self.signs.count(-1) + self.turned)
        return phase


@dataclass(frozen=True)
class Part:
    """All cells of the window, or those on one side of mirror planes: half of it, or the quarter
    x > 0, y > 0.

    Scalar fields, as the pressure, are even about mirror planes, and vectors are as a mirror shows
    them: the component across a plane is odd about it. Indices count from the planes.

    mirrored  whether x = 0 and y = 0 are mirror planes
    along     axis along which bodies that do not couple are pushed: about the plane across it their
              vectors are the opposite of what a mirror shows. None where that is no mirror plane,
              or nothing pushes along any
    """

    mirrored: tuple[bool, bool]
    along: int | None = None

    @property
    def quarter(self) -> bool:
        """Whether both are mirror planes."""
        return all(self.mirrored)

    @property
    def images(self) -> int:
        """How often the part is in the window."""
        x, y = self._sides
        return x * y

    @property
    def _sides(self) -> Pair:
        """Sides of the window over those of the part."""
        x, y = self.mirrored
        return 1 + x, 1 + y

    @property
    def scalar(self) -> Parity:
        """Of the pressure, the gap and u_z."""
        x, y = self.mirrored
        return Parity((int(x), int(y)))

    @property
    def turning(self) -> Parity:
        """Of what turns vectors: odd about both planes."""
        x, y = self.scalar.signs
        return Parity((-x, -y))

    @property
    def vector(self) -> tuple[Parity, Parity]:
        """Of the components x and y of vectors."""
        one, other = (self._parity(component) for component in (0, 1))
        return one, other

    def _parity(self, component: int) -> Parity:
        x, y = (
            int(mirrored) * (-1 if (axis == component) != (axis == self.along) else 1)
            for axis, mirrored in enumerate(self.mirrored)
        )
        return Parity((x, y), turned=0 in (x, y) and 1 in (x, y))

    @property
    def even(self) -> tuple[bool, bool]:
        """Whether the sums of vectors' components are as many times those on the part; those of odd
        ones vanish."""
        x, y = (-1 not in one.signs for one in self.vector)
        return x, y

    def cells(self, window: Pair) -> Pair:
        """How many there are of the cells of the window."""
        x, y = self._sides
        return window[0] // x, window[1] // y

    def window(self, cells: Pair) -> Pair:
        """How many cells these are with their images."""
        x, y = self._sides
        return x * cells[0], y * cells[1]

    def slices(self, window: Pair) -> tuple[slice, slice]:
        """Which of the cells of the window they are."""
        nx, ny = self.cells(window)
        return slice(window[0] - nx, None), slice(window[1] - ny, None)

    def of(self, field: AnyField) -> AnyField:
        """A field of the window (nx, ny) on the part."""
        if not any(self.mirrored):
            return field
        some: AnyField = np.ascontiguousarray(field[self.slices(field.shape)])  # type: ignore[assignment]
        return some

    def unfolded(self, field: AnyField, parity: Parity | None = None) -> AnyField:
        """A field of the part on the window (nx, ny), of a parity, else that of scalars."""
        for axis, sign in enumerate((parity or self.scalar).signs):
            if sign:
                image = np.flip(field, axis)
                image = image if sign > 0 else 0.0 - image  # zeros stay positive
                field = np.concatenate([image, field], axis)  # type: ignore[assignment]
        return field

    def unfolded_vector(self, field: Field) -> Field:
        """A vector field of the part (2, …) on the window (2, nx, ny)."""
        if not any(self.mirrored):
            return field
        components = zip(field, self.vector, strict=True)
        return np.stack([self.unfolded(one, parity) for one, parity in components])

    def resultant(self, field: Field) -> Field:
        """Sums of the components of a vector field over the whole window (2,)."""
        return np.where(self.even, self.images * np.sum(field, axis=(1, 2)), 0.0)

    def framed(self, field: NDArray[Any], width: int) -> NDArray[Any]:
        """A field of the part (nx, ny) in a frame of so many cells: its images beyond mirror
        planes, else nothing."""
        nx, ny = field.shape
        framed = np.zeros((nx + 2 * width, ny + 2 * width), dtype=field.dtype)
        framed[width : width + nx, width : width + ny] = field
        images = slice(2 * width - 1, width - 1, -1)
        if self.mirrored[0]:
            framed[:width] = framed[images]
        if self.mirrored[1]:
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
        if not self.mirrored[0]:
            slopes[0, 0] = field[1] - field[0]
        if not self.mirrored[1]:
            slopes[1, :, 0] = field[:, 1] - field[:, 0]
        return slopes


WHOLE = Part((False, False))
QUARTER = Part((True, True))


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
    return QUARTER
