"""Grids whose centre is at a prescribed position of a cell."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.grid import SurfaceGrid

# Positions of the contact's axis in a cell, in cell sides; others are equal by symmetry.
OFFSETS = ((0.0, 0.0), (0.5, 0.5), (0.5, 0.0), (0.25, 0.25), (0.1, 0.35), (0.4, 0.15))
# Two offsets with different divisions of circles: their joint errors scatter a third as much as
# those of one grid of each size.
UNLIKE = ((0.5, 0.0), (0.25, 0.25))


@dataclass(frozen=True)
class ShiftedGrid(SurfaceGrid):
    """Grid with an offset between its centre and the axis of the contact.

    offset  of the grid's centre from the contact's axis, in cells
    """

    offset: tuple[float, float] = (0.0, 0.0)

    @property
    def x(self) -> NDArray[np.float64]:
        """Cell centres along x [length]."""
        return np.asarray(super().x + self.offset[0] * self.spacing[0])

    @property
    def y(self) -> NDArray[np.float64]:
        """Cell centres along y [length]."""
        return np.asarray(super().y + self.offset[1] * self.spacing[1])
