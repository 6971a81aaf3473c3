"""Surface grid of rectangular cells, each with uniform tractions."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class SurfaceGrid:
    """Grid of rectangular cells on a window centred at the origin of the contact plane.

    A grid of one row contains strips: the cells of a line contact, per unit length along y.

    cells   number of cells along x and y, at least 2 each, or 1 along y
    window  side lengths of the window [length], positive

    Raises ValueError for other values.
    """

    cells: tuple[int, int]
    window: tuple[float, float]

    def __post_init__(self) -> None:
        if self.cells[0] < 2 or self.cells[1] < 1:
            raise ValueError(f"cells is {self.cells}: use at least 2 along each side")
        if not all(0 < side < np.inf for side in self.window):
            raise ValueError(f"window is {self.window}: use two positive lengths")

    @property
    def of_strips(self) -> bool:
        """True if the grid has one row of cells, which are the strips of a line contact."""
        return self.cells[1] == 1

    @property
    def spacing(self) -> tuple[float, float]:
        """Side lengths of a cell along x and y [length]."""
        return self.window[0] / self.cells[0], self.window[1] / self.cells[1]

    @property
    def cell_side(self) -> float:
        """Larger side of a cell; of a strip its width [length]."""
        return self.spacing[0] if self.of_strips else max(self.spacing)

    @property
    def cell_area(self) -> float:
        """Area of one cell [length^2]."""
        return self.spacing[0] * self.spacing[1]

    @property
    def x(self) -> NDArray[np.float64]:
        """Coordinates x of the cell centres, symmetric about zero, shape (nx,) [length]."""
        return _cell_centres(self.cells[0], self.spacing[0])

    @property
    def y(self) -> NDArray[np.float64]:
        """Coordinates y of the cell centres, symmetric about zero, shape (ny,) [length]."""
        return _cell_centres(self.cells[1], self.spacing[1])

    @property
    def even(self) -> bool:
        """True if the cells are symmetric about x = 0 and y = 0, with both planes between cells.

        The coordinates of the cells must be exactly symmetric. A symmetry reduction requires such a
        grid.
        """
        if any(count % 2 for count in self.cells):
            return False
        return all(bool((at == -at[::-1]).all()) for at in (self.x, self.y))

    def coordinates(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the coordinates x and y of all cell centres, each of shape (nx, ny) [length]."""
        return np.repeat(self.x[:, None], self.cells[1], axis=1), np.tile(
            self.y, (self.cells[0], 1)
        )

    def refined(self, factor: int = 2) -> "SurfaceGrid":
        """Return a finer grid on an equal window, with the numbers of cells multiplied by a factor.

        factor  factor of the numbers of cells along x and y; one row of strips remains one row
        """
        rows = 1 if self.of_strips else self.cells[1] * factor
        return SurfaceGrid((self.cells[0] * factor, rows), self.window)

    def coarsened(self) -> "SurfaceGrid":
        """Return a coarser grid on an equal window, with half the cells per side.

        Raises ValueError for odd numbers of cells.
        """
        if self.cells[0] % 2 or self.cells[1] % 2:
            raise ValueError(f"{self.cells} cells cannot be halved: both counts must be even")
        return SurfaceGrid((self.cells[0] // 2, self.cells[1] // 2), self.window)


def _cell_centres(count: int, spacing: float) -> NDArray[np.float64]:
    return (np.arange(count, dtype=np.float64) - (count - 1) / 2) * spacing
