"""Symmetry reduction of the contact problem to a half or quarter of the window.

The full window is the domain without mirror planes. Fields are restricted to the reduced domain,
and extended to the window by their mirror images.
"""

from dataclasses import dataclass, fields, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field
from semi_analytical.grid import SurfaceGrid

AnyField = NDArray[Any]
Record = TypeVar("Record")
Pair = tuple[int, int]
# Sign of a field's mirror image about the planes x = 0 and y = 0; 0 without a mirror plane.
Parity = tuple[int, int]

# Round-off between mirror images of a gap, relative to its largest value.
ROUND_OFF = 1e-9


@dataclass(frozen=True)
class ReducedDomain:
    """Domain of the computation: the full window, or its half or quarter between mirror planes.

    The domain is x > 0, y > 0, or both. Scalar fields (pressure, gap, u_z) are even about mirror
    planes. Cell indices count from the planes.

    mirrors  True for x = 0 and for y = 0 if the plane is a mirror plane
    shear    for each plane, 1 if reflection preserves the shear field, -1 if it reverses the field
    """

    mirrors: tuple[bool, bool] = (False, False)
    shear: Pair = (1, 1)

    @property
    def planes(self) -> tuple[int, ...]:
        """Axes (0 for x, 1 for y) that are normal to a mirror plane."""
        return tuple(axis for axis, mirrored in enumerate(self.mirrors) if mirrored)

    @property
    def _side_ratios(self) -> Pair:
        """Length of the window over length of the domain, along x and y: 2 with a mirror plane,
        else 1."""
        x, y = self.mirrors
        return 1 + x, 1 + y

    @property
    def images(self) -> int:
        """Number of mirror images of the domain that make up the window: 1, 2 or 4."""
        x, y = self._side_ratios
        return x * y

    @property
    def scalar(self) -> Parity:
        """Parity of scalar fields about the planes x = 0 and y = 0.

        The parity is 1 (even) about a mirror plane, and 0 about a plane that is not a mirror plane.
        """
        x, y = self.mirrors
        return int(x), int(y)

    @property
    def vector(self) -> tuple[Parity, Parity]:
        """Parities of the x and y components of tangential fields about x = 0 and y = 0.

        1 is even, -1 is odd, 0 means that the plane is not a mirror plane.
        """
        (x, y), (s_x, s_y) = self.scalar, self.shear
        return (-s_x * x, s_y * y), (s_x * x, -s_y * y)

    @property
    def binned_slip(self) -> Parity:
        """Parity about x = 0 and y = 0 of the shear changes in bins of slip compliance.

        The preconditioner of the tangential problem uses these bins. A bin holds changes of the
        shear along t, the slip direction turned by 90 degrees. A mirror image of t is opposite to
        the turned mirror image of the slip. The parity is therefore -1 (odd) about a mirror plane,
        and 0 without one.
        """
        x, y = self.scalar
        return -x, -y

    @property
    def summed(self) -> tuple[bool, bool]:
        """True for x and y if the sum of this component of tangential fields can be non-zero.

        Components that are odd about a mirror plane have the sum 0.
        """
        x, y = (-1 not in parity for parity in self.vector)
        return x, y

    def cells(self, window: Pair) -> Pair:
        """Return the number of cells of the reduced domain along x and y.

        window  number of cells of the full window along x and y
        """
        x, y = self._side_ratios
        return window[0] // x, window[1] // y

    def window(self, cells: Pair) -> Pair:
        """Return the number of cells of the full window along x and y.

        cells  number of cells of the reduced domain along x and y
        """
        x, y = self._side_ratios
        return x * cells[0], y * cells[1]

    def restrict(self, field: AnyField) -> AnyField:
        """Restrict a field of the full window to the reduced domain.

        field  field on the window (…, nx, ny)
        """
        nx, ny = self.cells((field.shape[-2], field.shape[-1]))
        return np.ascontiguousarray(field[..., field.shape[-2] - nx :, field.shape[-1] - ny :])

    def extend(self, field: AnyField) -> AnyField:
        """Extend a field from the reduced domain to the full window by its mirror images.

        The mirror images have the parities `scalar` and `vector`.

        field  scalar field (nx, ny) or tangential field (2, nx, ny)
        """
        if not any(self.mirrors):
            return field
        if field.ndim == 2:
            return _extend_by_parity(field, self.scalar)
        return np.stack(
            [_extend_by_parity(*given) for given in zip(field, self.vector, strict=True)]
        )

    def extend_fields(self, record: Record) -> Record:
        """Return a copy of a dataclass with its fields extended to the full window.

        Arrays of two axes are scalar fields, arrays of three axes tangential fields. Other
        attributes do not change.

        record  dataclass instance, such as a solved state
        """
        found = {one.name: getattr(record, one.name) for one in fields(record)}  # type: ignore[arg-type]
        arrays = {n: v for n, v in found.items() if isinstance(v, np.ndarray) and v.ndim > 1}
        return replace(record, **{name: self.extend(v) for name, v in arrays.items()})  # type: ignore[type-var]

    def resultant(self, field: Field) -> Field:
        """Compute the sum of each component of a tangential field over the domain (2,).

        Odd components have the sum 0 over the window, and this value is returned.

        field  tangential field (2, nx, ny)
        """
        return np.where(self.summed, np.sum(field, axis=(1, 2)), 0.0)

    def rim(self, values: AnyField) -> AnyField:
        """Return the values of a field in the cells at the border of the window, as a flat array.

        Cells at a mirror plane are not at the border. Used to detect contacts that reach the
        border.

        values  field on the domain (nx, ny)
        """
        (x, y), (nx, ny) = self.mirrors, values.shape
        rows, columns = [0] * (not x) + [nx - 1], [0] * (not y) + [ny - 1]
        if ny == 1:  # strips have no border along y
            columns = []
        return np.concatenate([values[rows].ravel(), values[:, columns].ravel()])

    def add_frame(self, field: AnyField, width: int) -> AnyField:
        """Add a frame of cells around a field: mirror images beyond mirror planes, else zeros.

        field  scalar field (nx, ny)
        width  number of cells of the frame on each side
        """
        nx, ny = field.shape
        framed = np.zeros((nx + 2 * width, ny + 2 * width), dtype=field.dtype)
        framed[width : width + nx, width : width + ny] = field
        images = slice(2 * width - 1, width - 1, -1)
        if self.mirrors[0]:
            framed[:width] = framed[images]
        if self.mirrors[1]:
            framed[:, :width] = framed[:, images]
        return framed

    def fold_frame(self, framed: Field, width: int) -> Field:
        """Remove the frame of cells around a displacement field of a reduced domain.

        The displacement beyond a mirror plane is added to that of the mirror cell in the domain.
        The operation is the adjoint of `add_frame`.

        framed  displacement with its frame (nx + 2 width, ny + 2 width)
        width   number of cells of the frame on each side
        """
        framed, images = framed.copy(), slice(width - 1, None, -1)
        if self.mirrors[0]:
            framed[width : 2 * width] += framed[images]
        if self.mirrors[1]:
            framed[:, width : 2 * width] += framed[:, images]
        return framed[width:-width, width:-width]

    def differences(self, field: Field) -> Field:
        """Compute the slopes of a scalar field along x and y (2, nx, ny), as changes per cell.

        Differences are central, and one-sided at the border of the window.

        field  scalar field (nx, ny)
        """
        framed, slopes = self.add_frame(field, 1), np.empty((2, *field.shape))
        np.subtract(framed[2:, 1:-1], framed[:-2, 1:-1], out=slopes[0])
        np.subtract(framed[1:-1, 2:], framed[1:-1, :-2], out=slopes[1])
        slopes /= 2
        slopes[0, -1], slopes[1, :, -1] = field[-1] - field[-2], field[:, -1] - field[:, -2]
        if not self.mirrors[0]:
            slopes[0, 0] = field[1] - field[0]
        if not self.mirrors[1]:
            slopes[1, :, 0] = field[:, 1] - field[:, 0]
        return slopes

    def require_even(self, gap: Field) -> None:
        """Raise ValueError unless a gap is even about the mirror planes of the reduced domain.

        gap  gap on the full window (nx, ny); may be infinite
        """
        for axis in self.planes:
            image = np.flip(gap, axis)
            if np.array_equal(gap, image):  # the usual case, and fast
                continue
            largest = np.max(np.abs(gap), where=np.isfinite(gap), initial=0.0)
            if not np.allclose(gap, image, rtol=0.0, atol=ROUND_OFF * largest):
                raise ValueError(
                    "the indenter declares symmetry about x = 0 and y = 0, but its gap differs"
                )


def _extend_by_parity(field: AnyField, parity: Parity) -> AnyField:
    """Extend a field by its mirror images beyond the planes x = 0 and y = 0.

    field   field on the reduced domain (nx, ny)
    parity  sign of the mirror image about each plane; 0 without a mirror plane
    """
    for axis, sign in enumerate(parity):
        if sign:
            image = np.flip(field, axis)
            image = image if sign > 0 else 0.0 - image  # zeros stay positive
            field = np.concatenate([image, field], axis)
    return field


WINDOW = ReducedDomain()
QUARTER = ReducedDomain((True, True))


@dataclass(frozen=True)
class ReducedGrid:
    """Grid of the cells of a reduced domain; the area of a cell includes its mirror images.

    A sum over the domain times the cell area is thus the integral over the window.

    window  grid of the full window
    domain  reduced domain
    """

    window: SurfaceGrid
    domain: ReducedDomain = WINDOW

    @property
    def cells(self) -> Pair:
        """Number of cells of the domain along x and y."""
        return self.domain.cells(self.window.cells)

    @property
    def spacing(self) -> tuple[float, float]:
        """Cell sides along x and y [length]."""
        return self.window.spacing

    @property
    def cell_area(self) -> float:
        """Area of a cell and its mirror images [length^2]."""
        return self.window.cell_area * self.domain.images

    def coordinates(self) -> tuple[Field, Field]:
        """Return the cell centres X, Y, each of shape (nx, ny) [length]."""
        x, y = self.window.coordinates()
        return self.domain.restrict(x), self.domain.restrict(y)
