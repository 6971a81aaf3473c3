"""The cells along the edge of a region, and the traction in their parts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.fit import Indices, Stencil
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.means import Exponent, mean_of_smooth, mean_power
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import Mask, edge_shape, layers_of

Field = NDArray[np.float64]

# Wider than for exact means: what is left of the error of one cell is to leave the others alone.
STENCIL = Stencil(4, 2.2)
# Layers of cells inside and outside the edge. Farther in a traction is a slope within a cell, to
# 1/500 of it; farther out it is zero.
INSIDE, OUTSIDE = 5.5, 1.5
# Layers up to which it is all that the fit says: what it says beside the slope fades out from here
# on, as an end of it would show in the pressure of the next cells.
WHOLE = 2.5
# So many times its slopes above zero, a part of a cell has the mean of a power by its series.
SMOOTH = 1.5
# Cells whose parts are found at a time: as many as stay in the cache.
CHUNK = 256
X, Y = (at.ravel() for at in np.meshgrid(part_centres(), part_centres(), indexing="ij"))
MONOMIALS = np.stack([X**0, X, Y, X**2 / 2, X * Y, Y**2 / 2])
# Radius of a region in cells that is thick enough to be fitted.
THICK = 1.9


@dataclass(frozen=True)
class Rim:
    """Cells along the edge of a region that are fitted well.

    region   (nx, ny) cells whose centre is inside the edge
    i, j     the cells (n,)
    parts    (n, PARTS, PARTS) mean of the traction in the parts of each
    covered  (n,) part of each inside the edge
    unsafe   part of all cells along the edge that are not fitted well
    """

    region: Mask
    i: Indices
    j: Indices
    parts: Field
    covered: Field
    unsafe: float

    @property
    def outer(self) -> Mask:
        """(nx, ny) cells that the region reaches into, and whose centre is outside."""
        reached = np.zeros(self.region.shape, dtype=bool)
        reached[self.i, self.j] = self.covered > 0
        return reached & ~self.region

    @property
    def means(self) -> Field:
        """(nx, ny) mean of the traction over each of the cells, zero elsewhere."""
        means = np.zeros(self.region.shape)
        means[self.i, self.j] = self.parts.mean(axis=(1, 2))
        return means

    @property
    def area(self) -> float:
        """Of the region, in cells."""
        covered = self.region.astype(float)
        covered[self.i, self.j] = self.covered
        return float(np.sum(covered))


def rim(
    means: Field, loaded: Mask, before: Rim | None = None, exponent: Exponent = 0.5
) -> Rim | None:
    """The rim of a region of tractions; None where it is too thin to have one.

    means     (nx, ny) mean of the traction over each cell [force/length^2]
    loaded    (nx, ny) cells where it is positive
    before    the rim of about the same region: cells outside it are no data, but what comes of it
    exponent  the traction goes with this power of the distance from the edge
    """
    region = loaded if before is None else loaded & ~before.outer
    layer, nearest = layers = layers_of(region)
    if np.max(layer) <= THICK:
        return None
    scale = np.max(means)
    shape = edge_shape(
        means / scale, region, STENCIL, rings=0, exponent=exponent, rounds=2, layers=layers
    )
    outside = np.hypot(*(nearest - np.indices(region.shape)))
    i, j = np.nonzero((layer + outside <= INSIDE) & (outside <= OUTSIDE))
    phi, safe = shape.about_cells(i, j)
    # Those that the edge cuts first, and then those where no part is cut.
    order = np.flatnonzero(safe)[np.argsort(layer[i[safe], j[safe]], kind="stable")]
    i, j, phi = i[order], j[order], phi.chosen(order)
    of_cells = np.broadcast_to(exponent, means.shape)[i, j] if np.ndim(exponent) else exponent
    parts, covered = _in_parts(phi, of_cells)
    parts *= scale
    fading = np.nonzero(layer[i, j] > WHOLE)[0]
    fade = (layer[i[fading], j[fading]] - WHOLE)[:, None, None] / (INSIDE - WHOLE)
    parts[fading] += fade * (_slopes_alone(means, i[fading], j[fading]) - parts[fading])
    inside = region.copy()
    inside[i, j] = phi.f > 0
    return Rim(inside, i, j, parts, covered, 1 - float(np.mean(safe)))


def _in_parts(phi: Quadratic, exponent: Exponent) -> tuple[Field, Field]:
    """Mean of phi_+^exponent over the parts of each cell (n, PARTS, PARTS), and the part of each
    where phi is positive (n,)."""
    parts, covered = np.empty((len(phi.f), PARTS**2)), np.empty(len(phi.f))
    for first in range(0, len(covered), CHUNK):
        some = slice(first, first + CHUNK)
        a = exponent[some] if isinstance(exponent, np.ndarray) else exponent
        covered[some] = _some_in_parts(phi.chosen(some), a, parts[some])
    return parts.reshape(-1, PARTS, PARTS), covered


def _some_in_parts(phi: Quadratic, exponent: Exponent, parts: Field) -> Field:
    """The same of some cells, the former into parts (n, PARTS²)."""
    bent = (phi.f_xx + phi.f_yy) / (24 * PARTS**2)
    factors = np.stack([phi.f + bent, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy], axis=1)
    f = factors @ MONOMIALS
    # Over a part of a cell the slope hardly changes.
    f_x, f_y = phi.f_x[:, None] / PARTS, phi.f_y[:, None] / PARTS
    slope = np.abs(f_x) + np.abs(f_y)
    a = exponent[:, None] if isinstance(exponent, np.ndarray) else exponent
    parts[:] = mean_of_smooth(np.maximum(f, SMOOTH * slope), f_x, f_y, a)
    if np.all(f >= SMOOTH * slope):
        return np.ones(len(f))
    covered = (f > 0).astype(float)
    parts *= covered
    cell, part = np.nonzero((f > -slope / 2) & (f < SMOOTH * slope))
    of_cut = f[cell, part], f_x[cell, 0], f_y[cell, 0]
    parts[cell, part] = mean_power(*of_cut, a[cell, 0] if isinstance(a, np.ndarray) else a)
    covered[cell, part] = mean_power(*of_cut, 0.0)
    return np.asarray(covered.mean(axis=1))


def _slopes_alone(means: Field, i: Indices, j: Indices) -> Field:
    """Parts (n, PARTS, PARTS) of a traction with the slopes of central differences."""
    along_x, along_y = (np.gradient(means, axis=axis)[i, j, None, None] for axis in (0, 1))
    x = part_centres()
    return np.asarray(means[i, j, None, None] + along_x * x[:, None] + along_y * x)
