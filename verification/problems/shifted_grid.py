"""Grids of cells with a prescribed position of the contact axis within a cell."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.grid import SurfaceGrid

# Positions of the contact axis in a cell, in cell sides. Symmetric positions are omitted.
OFFSETS = ((0.0, 0.0), (0.5, 0.5), (0.5, 0.0), (0.25, 0.25), (0.1, 0.35), (0.4, 0.15))
# Two offsets for which the contact edge cuts the cells differently. Their mean errors scatter
# 1/3 as much as those of one grid per size.
UNLIKE = ((0.5, 0.0), (0.25, 0.25))


@dataclass(frozen=True)
class ShiftedGrid(SurfaceGrid):
    """Grid of cells whose centre is shifted from the axis of the contact.

    offset  position of the grid centre relative to the contact axis, in cell sides along x and y
    """

    offset: tuple[float, float] = (0.0, 0.0)

    @property
    def x(self) -> NDArray[np.float64]:
        """Coordinates x of the cell centres, relative to the contact axis [length]."""
        return np.asarray(super().x + self.offset[0] * self.spacing[0])

    @property
    def y(self) -> NDArray[np.float64]:
        """Coordinates y of the cell centres, relative to the contact axis [length]."""
        return np.asarray(super().y + self.offset[1] * self.spacing[1])
