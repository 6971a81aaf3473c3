"""Displacement kernels of tractions that vary within cells.

Within a cell a traction is the sum of its mean, a slope, and a remainder. The remainder displaces
only cells at most REACH away. Slopes act through the first moments of the influence coefficients.
Remainders act through a table of PARTS x PARTS subcells of a cell. Both kernels follow from
influence coefficients at the spacing of the subcells, for all bodies. PARTS is odd, so that cell
centres are subcell centres.
"""

from dataclasses import dataclass
from functools import cached_property

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

    The position 0 is the cell centre.
    """
    return (np.arange(PARTS) - PARTS // 2) / PARTS


@dataclass(frozen=True)
class EdgeKernels:
    """Displacement kernels of slopes and remainders for one component of the influence
    coefficients.

    component  name of the component, e.g. "zz", as in `InfluenceCoefficients`
    cells      influence coefficients of the cells
    parts      influence coefficients at PART_OFFSETS offsets of the subcells
    """

    component: str
    cells: InfluenceCoefficients
    parts: InfluenceCoefficients

    @property
    def parity(self) -> tuple[int, int]:
        """Parity of the influence coefficients along x and y: 1 for even, -1 for odd."""
        return PARITY[self.component]

    @property
    def even(self) -> bool:
        """True if the influence coefficients have equal parities along x and y."""
        return self.parity[0] == self.parity[1]

    @cached_property
    def moments(self) -> Field:
        """Displacement by linear tractions x and y on the cell at the origin (2, nx, ny)
        [length^3/force].

        Entry (i, j) belongs to the offset (i, j) >= 0. The tractions x and y are in cells.
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
        """Displacement by linear tractions x and y at NEAR + 1 offsets along each axis, from
        subcell sums.

        The shape is (2, NEAR + 1, NEAR + 1).
        """
        K = self.parts[self.component][:PART_OFFSETS, :PART_OFFSETS]
        x, one = part_centres(), np.ones(PARTS)
        along_x, along_y = (_subcell_sums(x, parity) for parity in self.parity)
        across_x, across_y = (_subcell_sums(one, parity) for parity in self.parity)
        by_both = along_x @ K @ across_y.T, across_x @ K @ along_y.T
        # Constant subcells have a smaller moment than a linear function.
        return np.stack(by_both) / (1 - 1 / PARTS**2)

    @cached_property
    def near(self) -> Field:
        """Displacement by unit traction on each subcell of the cell at the origin [length^3/force].

        The shape is (2 REACH + 1, 2 REACH + 1, PARTS, PARTS), for cell offsets -REACH … REACH.
        """
        K = self.parts[self.component]
        i = PARTS * np.arange(-REACH, REACH + 1)[:, None] - np.arange(PARTS) + PARTS // 2
        sign_x, sign_y = (np.where(i < 0, parity, 1) for parity in self.parity)
        near = K[np.abs(i)[:, None, :, None], np.abs(i)[:, None]]
        return np.asarray(sign_x[:, None, :, None] * sign_y[:, None] * near)


def _subcell_sums(weights: Field, parity: int) -> Field:
    """Return the matrix that sums weighted subcell coefficients over a cell (NEAR + 1,
    PART_OFFSETS).

    The matrix maps values at subcell offsets >= 0 to sums at cell offsets >= 0. Negative offsets
    use the parity.

    weights  weight of each subcell along one side of the cell (PARTS,)
    """
    offsets = PARTS * np.arange(NEAR + 1)[:, None] - np.arange(PARTS) + PARTS // 2
    sums = np.zeros((NEAR + 1, PART_OFFSETS))
    rows = np.broadcast_to(np.arange(NEAR + 1)[:, None], offsets.shape)
    np.add.at(sums, (rows, np.abs(offsets)), weights * np.where(offsets < 0, parity, 1))
    return sums


def _coefficient_slope(values: Field, axis: int, parity: int) -> Field:
    """Compute the derivative of influence coefficients along one axis, per cell.

    The first moments of the coefficients follow from it. Differences are of fourth order, at the
    far end of lower order.

    values  coefficients at offsets >= 0 (nx, ny)
    axis    0 for x, 1 for y
    parity  parity of the coefficients along the axis: 1 even, -1 odd
    """
    v = np.moveaxis(values, axis, 0)
    v = np.concatenate([parity * v[2:0:-1], v])
    slope = np.gradient(v, axis=0)
    slope[2:-2] = (8 * (v[3:-1] - v[1:-3]) - (v[4:] - v[:-4])) / 12
    return np.moveaxis(slope[2:], 0, axis)
