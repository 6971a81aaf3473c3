"""Box of cells around a contact, outside of which the tractions are zero.

Convolutions on a smaller box cost less.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Sides are multiples of this number: boxes can be halved, and few shapes occur.
QUANTUM = 16


@dataclass(frozen=True)
class Box:
    """Rectangle of cells around a contact, outside of which all tractions are zero.

    first  indices of the first cell along x and y
    shape  number of cells along x and y
    """

    first: tuple[int, int]
    shape: tuple[int, int]

    @classmethod
    def whole(cls, cells: tuple[int, int]) -> "Box":
        """Return the box that contains all cells of a window or reduced domain.

        cells  number of cells along x and y
        """
        return cls((0, 0), cells)

    @property
    def slices(self) -> tuple[slice, slice]:
        """Slices that select the box from fields whose last two axes are the cells."""
        (i, j), (nx, ny) = self.first, self.shape
        return slice(i, i + nx), slice(j, j + ny)

    def embed(self, values: Field, cells: tuple[int, int]) -> Field:
        """Extend a field from the box to the domain, with zeros outside of the box.

        values  field on the box (…, *shape)
        cells   number of cells of the domain along x and y
        """
        field = np.zeros((*values.shape[:-2], *cells))
        field[..., self.slices[0], self.slices[1]] = values
        return field

    def mask(self, cells: tuple[int, int]) -> Mask:
        """Return a mask (nx, ny) that is True in the cells of the box.

        cells  number of cells nx, ny of the domain along x and y
        """
        inside = np.zeros(cells, dtype=bool)
        inside[self.slices] = True
        return inside


def box_around(cells: Mask, margin: int, domain: ReducedDomain = WINDOW) -> Box:
    """Return the smallest box around cells with a margin, with sides in multiples of QUANTUM.

    Convolutions are restricted to this box. A side that does not fit becomes the side of the
    window. On a reduced domain the box surrounds the cells and their mirror images and is then
    restricted to the domain.

    cells   cells that the box must contain, such as those in contact (nx, ny)
    margin  number of cells around them
    domain  domain of `cells`: full window or reduced domain
    """
    sides = [
        (_half_box_side if mirrored else _box_side)(np.any(cells, axis=1 - axis), margin)
        for axis, mirrored in enumerate(domain.mirrors)
    ]
    return Box((sides[0][0], sides[1][0]), (sides[0][1], sides[1][1]))


def _box_side(marked: Mask, margin: int) -> tuple[int, int]:
    """Compute the first index and the number of cells of a box of cells along one axis.

    The box contains given cells and a margin. Its number of cells is a multiple of QUANTUM.

    marked  True at indices along the axis with cells that the box must contain
    margin  number of cells on both sides of them
    """
    at = np.nonzero(marked)[0]
    available = len(marked)
    needed = at[-1] - at[0] + 1 + 2 * margin
    length = -(-needed // QUANTUM) * QUANTUM
    if length >= available:
        return 0, available
    middle_first = (at[0] + at[-1] + 1 - length) // 2
    return int(np.clip(middle_first, 0, available - length)), int(length)


def _half_box_side(marked: Mask, margin: int) -> tuple[int, int]:
    """Return first index and number of cells of a box that begins at a mirror plane before cell
    0."""
    _, length = _box_side(np.concatenate([marked[::-1], marked]), margin)
    return 0, length // 2
