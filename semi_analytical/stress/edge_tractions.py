"""Tractions within the cells at the edge of a contact: p = √phi+, q = slip p.

On cells of uniform tractions the edge is a staircase of steps; beside it and below it stress feels
them. What a fit of phi knows of the inside of a cell is kept as small cells that differ from it.
Lengths are cells, places index coordinates.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import mean_power
from semi_analytical.edge.fit import Stencil, fit_about
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import EdgeShape, edge_shape

# Rings of cells that are taken apart, and how far outside of the contact one may be cut.
TAKEN_APART, CUT = 3.5, 1.5
# How much the ratio of shear to pressure is believed of slipping cells that are no data for the
# shape, and of cells that stick.
UNSURE, STUCK = 0.05, 1e-8


@dataclass(frozen=True)
class EdgedTractions:
    """Tractions (q_x, q_y, p) of a contact and what is known of them within the cells at its edge.

    cells         (3, nx, ny) uniform on the cells, as they were given
    means         (3, nx, ny) the same, or of the fit where those given are not believed
    shape         of the edge
    ratio         (2, nx, ny) shear over pressure, believed as far as ratio_weight (nx, ny) says
    i, j          (k,) cells that are taken apart
    here, slip    phi and shear over pressure (2, k) about them
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
        """Shear over pressure (2, n) at places (n,), by linear fits."""
        return _slip_at(self.shape, self.ratio, self.ratio_weight, x, y)

    def parts(self, count: int) -> Field:
        """Tractions of the count² small cells of those that are taken apart, less those of `cells`
        (3, k, count, count)."""
        at = part_centres(count)
        about = self.here.reshaped((-1, 1, 1))
        small = about.about(about.x + at[:, None], about.y + at)
        mean = small.f + (small.f_xx + small.f_yy) / (24 * count**2)
        within = mean_power(mean, small.f_x / count, small.f_y / count, 0.5)
        by_fit = self.here.cell_mean(0.5)
        each = np.concatenate([self.slip, np.ones((1, len(self.i)))])
        beside = (self.means - self.cells)[:, self.i, self.j] - each * by_fit
        return np.asarray(each[..., None, None] * within + beside[..., None, None])

    @property
    def slopes(self) -> tuple[Field, Field]:
        """Differences of `cells` along x and y per cell (3, nx, ny), zero where a cell is taken
        apart and outside of the contact."""
        whole = self.cells[2] > 0
        whole[self.i, self.j] = False
        by_x, by_y = (np.asarray(np.gradient(self.cells, axis=axis)) for axis in (1, 2))
        return by_x * whole, by_y * whole


def part_centres(count: int) -> Field:
    """Centres of small cells along a side, from the centre of the cell (count,)."""
    return (np.arange(count) + 0.5) / count - 0.5


def edged_tractions(
    pressure: Field, shear: Field | None, stuck: Mask | None, stencil: Stencil, rings: int
) -> EdgedTractions:
    """Tractions with their edge.

    pressure, shear  (nx, ny) and (2, nx, ny) on the cells [force/length²]
    stuck            (nx, ny) cells of the contact that stick; None where all slip
    stencil, rings   as in `edge_shape`; with two rings or more the tractions of those that are
                     dropped are not believed, and replaced by those of the fit
    Raises ValueError where there is no cell to fit the edge to.
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
    return np.stack([fit.quadratic.at(x - i, y - j) for fit in fits])
