"""Tractions within the cells at the edge of a contact: pressure p = √φ+, shear q = slip p.

Tractions that are uniform in each cell form a staircase along the edge, which affects the stress
nearby. A fit of φ yields the traction within cells at the edge, as deviations on subcells. Lengths
are in cells and positions in index coordinates.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import mean_power
from semi_analytical.edge.fit import Stencil, fit_about
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import EdgeShape, edge_shape

# Depth of the cells that are divided into subcells, and their largest distance from the contact.
TAKEN_APART, CUT = 3.5, 1.5
# Weight of the ratio of shear to pressure in slipping cells that are no data of the shape, and in
# sticking cells.
UNSURE, STUCK = 0.05, 1e-8


@dataclass(frozen=True)
class EdgedTractions:
    """Tractions (q_x, q_y, p) of a contact with their variation within the cells at its edge.

    cells         (3, nx, ny) given uniform tractions of the cells [force/length^2]
    means         (3, nx, ny) cell means; in rejected rings those of the fit
    shape         cell means of φ and fits near the edge
    ratio         (2, nx, ny) shear over pressure
    ratio_weight  (nx, ny) weight of the ratio in fits
    i, j          (k,) indices of the cells that are divided into subcells
    here          quadratics of φ about the divided cells
    slip          (2, k) shear over pressure at the divided cells
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
        """Compute the ratio of shear to pressure (2, n) at positions (n,) by linear fits."""
        return _slip_at(self.shape, self.ratio, self.ratio_weight, x, y)

    def subcell_deviations(self, count: int) -> Field:
        """Compute the traction of each subcell minus the uniform traction of its cell.

        The shape is (3, k, count, count) for k cells along the edge. The sum of `cells` and the
        result is the traction.

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

    @property
    def slopes(self) -> tuple[Field, Field]:
        """Slopes of the uniform tractions `cells` along x and y, each (3, nx, ny), per cell.

        The slopes are zero in divided cells and in cells without pressure.
        """
        whole = self.cells[2] > 0
        whole[self.i, self.j] = False
        by_x, by_y = (np.asarray(np.gradient(self.cells, axis=axis)) for axis in (1, 2))
        return by_x * whole, by_y * whole


def part_centres(count: int) -> Field:
    """Compute the subcell centres along a cell side, relative to the cell centre (count,), in
    cells."""
    return (np.arange(count) + 0.5) / count - 0.5


def fit_edge_tractions(
    pressure: Field, shear: Field | None, stuck: Mask | None, stencil: Stencil, rings: int
) -> EdgedTractions:
    """Fit the pressure near the contact edge, and divide the edge cells into subcells.

    pressure        (nx, ny) [force/length²]
    shear           (2, nx, ny) [force/length²]; None without shear
    stuck           (nx, ny) cells of the contact that stick; None in gross slip
    stencil, rings  as in `edge_shape`; with two rings or more, the tractions of rejected rings are
                    replaced by those of the fit

    Raises ValueError where no cell is available for the fit.
    """
    region = pressure > 0
    cells = np.zeros((3, *pressure.shape))
    cells[2] = pressure
    if shear is not None:
        cells[:2] = shear
    shape = edge_shape(pressure, region, stencil, rings=rings)
    away = distance_transform_edt(~region)
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
    if not np.any(ratio):
        return np.zeros((2, len(x)))
    i, j = shape.nearest_to(x, y)
    fits = (fit_about(one, weight, i, j, shape.stencil, degree=1) for one in ratio)
    return np.stack([fit.quadratic.evaluate(x - i, y - j) for fit in fits])
