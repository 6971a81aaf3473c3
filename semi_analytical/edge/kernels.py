"""Displacement kernels of tractions that vary within cells.

Within a cell a traction is the sum of its mean, a slope, and a remainder. Slopes act on all cells,
through the first moments of the influence coefficients. Remainders act only on cells at most REACH
away, through a table of PARTS x PARTS subcells of a cell. Both kernels follow from influence
coefficients at the spacing of the subcells, for all bodies. PARTS is odd, so that cell centres are
subcell centres. `semi_analytical.edge.displacement` uses the kernels.
"""

from dataclasses import dataclass
from functools import cache, cached_property

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.influence.coefficients import PARITY, InfluenceCoefficients

PARTS = 11
# Distance in cells up to which remainders cause displacements.
REACH = 2
# Distance in cells up to which moments are sums over subcells; beyond, they are derivatives of the
# influence coefficients with an error of 5e-4.
NEAR = 8
# Number of offsets of influence coefficients at the spacing of subcells.
PART_OFFSETS = NEAR * PARTS + PARTS // 2 + 1


def part_centres() -> Field:
    """Return the positions of the subcell centres along one side of a cell (PARTS,), in cells.

    The cell centre has the position 0.
    """
    return (np.arange(PARTS) - PARTS // 2) / PARTS


@dataclass(frozen=True)
class EdgeKernels:
    """Kernels of the surface displacement by tractions that vary within cells, for one component.

    The component is a pair of a displacement direction and a traction direction. Offsets are
    distances in cells from the loaded cell to the displaced cell centre.

    component  name of the component, e.g. "zz" for the normal displacement by a pressure
    cells      influence coefficients at the spacing of the cells
    parts      influence coefficients at the spacing of the subcells, at PART_OFFSETS offsets
    """

    component: str
    cells: InfluenceCoefficients
    parts: InfluenceCoefficients

    @property
    def parity(self) -> tuple[int, int]:
        """Parities of the influence coefficients along x and y: 1 for even, -1 for odd."""
        return PARITY[self.component]

    @property
    def even(self) -> bool:
        """True if the influence coefficients have equal parities along x and y.

        Then each first moment of the coefficients is odd along one axis, and its spectrum is
        imaginary.
        """
        return self.parity[0] == self.parity[1]

    @cached_property
    def moments(self) -> Field:
        """Displacement by linear tractions on the cell at the origin (2, nx, ny) [length^3/force].

        The tractions are x (first row) and y (second row), in cells from the cell centre. Entry (i,
        j) is the displacement at the centre of the cell with the offset i, j >= 0.
        """
        A = self.cells[self.component]
        moments = np.stack(
            [-_coefficient_slope(A, axis, self.parity[axis]) / 12 for axis in (0, 1)]
        )
        nx, ny = (min(n, NEAR + 1) for n in A.shape)
        moments[:, :nx, :ny] = self.near_moments[:, :nx, :ny]
        return moments

    @cached_property
    def near_moments(self) -> Field:
        """Displacement at near cell centres by linear tractions on the cell at the origin.

        The shape is (2, NEAR + 1, NEAR + 1), for the tractions x and y and offsets from 0 to NEAR
        cells along each axis. The displacements are sums over the subcells of the loaded cell
        [length^3/force].
        """
        K = self.parts[self.component][:PART_OFFSETS, :PART_OFFSETS]
        along_x, along_y = (_subcell_sums(1, parity) for parity in self.parity)
        across_x, across_y = (_subcell_sums(0, parity) for parity in self.parity)
        by_both = along_x @ K @ across_y.T, across_x @ K @ along_y.T
        # Constant subcells have a smaller moment than a linear function.
        return np.stack(by_both) / (1 - 1 / PARTS**2)

    @cached_property
    def near(self) -> Field:
        """Displacement at near cell centres by unit traction on one subcell [length^3/force].

        The shape is (2 REACH + 1, 2 REACH + 1, PARTS, PARTS). The first two axes are the offsets
        -REACH … REACH of the displaced cell. The last two axes are the loaded subcell of the cell
        at the origin.
        """
        K = self.parts[self.component]
        i = PARTS * np.arange(-REACH, REACH + 1)[:, None] - np.arange(PARTS) + PARTS // 2
        sign_x, sign_y = (np.where(i < 0, parity, 1) for parity in self.parity)
        near = K[np.abs(i)[:, None, :, None], np.abs(i)[:, None]]
        return np.asarray(sign_x[:, None, :, None] * sign_y[:, None] * near)


@cache
def _subcell_sums(moment: int, parity: int) -> Field:
    """Return the matrix that sums coefficients of weighted subcells over a side of a cell.

    It maps influence coefficients at subcell offsets >= 0 to sums at cell offsets >= 0, with the
    shape (NEAR + 1, PART_OFFSETS). Coefficients at negative offsets follow from the parity.

    moment  exponent of the weights: 1 for the positions of the subcells along the side, 0 for ones
    parity  parity of the coefficients along this side: 1 even, -1 odd
    """
    offsets = PARTS * np.arange(NEAR + 1)[:, None] - np.arange(PARTS) + PARTS // 2
    sums = np.zeros((NEAR + 1, PART_OFFSETS))
    rows = np.broadcast_to(np.arange(NEAR + 1)[:, None], offsets.shape)
    weights = part_centres() ** moment * np.where(offsets < 0, parity, 1)
    np.add.at(sums, (rows, np.abs(offsets)), weights)
    return sums


def _coefficient_slope(values: Field, axis: int, parity: int) -> Field:
    """Compute the derivative along an axis of coefficients at offsets >= 0, by fourth-order
    differences. Over -12 it is the displacement by a linear traction on a distant cell."""
    v = values.T if axis else values
    v = np.concatenate([parity * v[2:0:-1], v])
    inner = (8 * (v[3:-1] - v[1:-3]) - (v[4:] - v[:-4])) / 12
    slope = np.concatenate([inner, [(v[-1] - v[-3]) / 2, v[-1] - v[-2]]])
    return slope.T if axis else slope
