"""Tractions within the cells at the contact edge, for the stress at and near the edge.

Tractions that are uniform in each cell form a staircase along the edge, which affects the stress
nearby. A fit of φ yields the pressure p = √φ+ within cells at the edge. The shear is q = slip p.
The tractions of subcells are stored as deviations from the uniform traction of their cell. Lengths
are in cells and positions are cell indices.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import mean_power
from semi_analytical.edge.fit import Stencil, fit_about
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import EdgeShape, distance_to, edge_shape
from semi_analytical.stress.patch import PATCH

# Depth of the cells that are divided into subcells, and their largest distance from the contact.
TAKEN_APART = 3.5
CUT = 1.5
# Weight of the ratio of shear to pressure in slipping cells that are no data of the shape, and in
# sticking cells.
UNSURE = 0.05
STUCK = 1e-8


@dataclass(frozen=True)
class EdgedTractions:
    """Tractions (q_x, q_y, p) of a contact with their variation within the edge cells.

    The pressure near the edge is √φ with a fitted function φ.

    cells         given uniform tractions of the cells (3, nx, ny) [force/length^2]
    means         cell means of the tractions; in rejected rings those of the fit (3, nx, ny)
    shape         cell means of φ and fits near the edge
    ratio         shear over pressure (2, nx, ny)
    ratio_weight  weight of the ratio in fits (nx, ny)
    i, j          indices of the cells that are divided into subcells (k,)
    here          quadratics of φ about the divided cells
    slip          shear over pressure at the divided cells (2, k)
    """

    cells: Field
    means: Field
    shape: EdgeShape
    ratio: Field
    ratio_weight: Field
    i: Indices
    j: Indices
    here: Quadratic
    slip: Field

    def slip_at(self, x: Field, y: Field) -> Field:
        """Compute shear over pressure (2, n) at points near the contact edge, by linear fits.

        x, y  points as cell indices (n,)
        """
        return _slip_at(self.shape, self.ratio, self.ratio_weight, x, y)

    def subcell_deviations(self, count: int) -> Field:
        """Compute the traction of each subcell minus the uniform traction of its cell.

        The shape is (3, k, count, count) for k cells along the contact edge and the components
        (q_x, q_y, p). The sum of `cells` and the result is the traction.

        count  number of subcells along a cell side
        """
        at = part_centres(count)
        about = self.here.reshape_arrays((-1, 1, 1))
        small = about.about(about.x + at[:, None], about.y + at)
        mean = small.f + (small.f_xx + small.f_yy) / (24 * count**2)
        within = mean_power(mean, small.f_x / count, small.f_y / count, 0.5)
        by_fit = self.here.cell_mean(0.5)
        each = np.concatenate([self.slip, np.ones((1, len(self.i)))])
        beside = (self.means - self.cells)[:, self.i, self.j] - each * by_fit
        return np.asarray(each[..., None, None] * within + beside[..., None, None])

    @cached_property
    def framed_fields(self) -> tuple[Field, ...]:
        """Tractions `cells` and their slopes along x and y, each (3, nx + 2 PATCH, ny + 2 PATCH).

        The slopes are changes per cell. They are zero in cells without pressure, and in cells that
        are divided into subcells. PATCH layers of cells without traction surround the grid.
        """
        whole = self.cells[2] > 0
        whole[self.i, self.j] = False
        slopes = (whole * np.gradient(self.cells, axis=axis) for axis in (1, 2))
        frame = [(0, 0), (PATCH, PATCH), (PATCH, PATCH)]
        return tuple(np.pad(field, frame) for field in (self.cells, *slopes))


def part_centres(count: int) -> Field:
    """Compute the positions of the subcell centres along a cell side (count,), in cells.

    The cell centre has the position 0.

    count  number of subcells along a cell side
    """
    return (np.arange(count) + 0.5) / count - 0.5


def fit_edge_tractions(
    pressure: Field, shear: Field | None, stuck: Mask | None, stencil: Stencil, rings: int
) -> EdgedTractions:
    """Fit the pressure near the contact edge, and divide the cells along the edge into subcells.

    The result yields the stress near the edge.

    pressure  pressure of the cells (nx, ny) [force/length²]
    shear     shear of the cells (2, nx, ny) [force/length²]; None without shear
    stuck     cells of the contact that stick (nx, ny); None in gross slip
    stencil   window and weights of the fits
    rings     number of outermost layers of cells that are not data; from two on, the tractions of
              these layers are replaced by those of the fit

    Raises ValueError where no cell is available for the fit.
    """
    region = pressure > 0
    cells = np.zeros((3, *pressure.shape))
    cells[2] = pressure
    if shear is not None:
        cells[:2] = shear
    shape = edge_shape(pressure, region, stencil, rings=rings)
    away = distance_to(region)
    i, j = np.nonzero((shape.depth <= TAKEN_APART) & (away <= CUT))
    here, safe = shape.about(i.astype(float), j.astype(float))
    i, j, here = i[safe], j[safe], here.chosen(safe)
    ratio = np.divide(cells[:2], pressure, out=np.zeros_like(cells[:2]), where=region)
    slips = region if stuck is None else region & ~stuck
    weight = np.where(slips, np.where(shape.weight > 0, 1.0, UNSURE), STUCK) * region
    slip = _slip_at(shape, ratio, weight, here.x, here.y)
    means = cells.copy()
    if rings > 1:
        wrong = shape.depth[i, j] < rings + 0.5
        mean = here.cell_mean(0.5)[wrong]
        means[:, i[wrong], j[wrong]] = np.concatenate([slip[:, wrong] * mean, mean[None]])
    return EdgedTractions(cells, means, shape, ratio, weight, i, j, here, slip)


def _slip_at(shape: EdgeShape, ratio: Field, weight: Field, x: Field, y: Field) -> Field:
    """Fit the ratio of shear to pressure (2, n) linearly at points x, y in cell indices (n,)."""
    if not np.any(ratio):
        return np.zeros((2, len(x)))
    i, j = shape.nearest_to(x, y)
    fits = (fit_about(one, weight, i, j, shape.stencil, degree=1) for one in ratio)
    return np.stack([fit.quadratic.evaluate(x - i, y - j) for fit in fits])
