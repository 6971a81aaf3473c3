"""The cells along the edge of a region, and the traction in their parts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from semi_analytical.edge.fit import Indices, Stencil
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.means import Exponent, mean_power, power
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import Mask, edge_shape

Field = NDArray[np.float64]

# Wider than for exact means: what is left of the error of one cell is to leave the others alone.
STENCIL = Stencil(4, 2.2)
# Layers of cells inside and outside the edge. Farther in a traction is a slope within a cell, to
# 1/500 of it; farther out it is zero.
INSIDE, OUTSIDE = 5.5, 1.5
# Layers up to which it is all that the fit says: what it says beside the slope fades out from here
# on, as an end of it would show in the pressure of the next cells.
WHOLE = 2.5
# So many times its slopes above zero, a part of a cell has the mean of a power by two terms of its
# series, to 2e-6.
SMOOTH = 4.0
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
    layer = distance_transform_edt(np.pad(region, 1))[1:-1, 1:-1]
    if np.max(layer) <= THICK:
        return None
    scale = np.max(means)
    shape = edge_shape(means / scale, region, STENCIL, rings=0, exponent=exponent, rounds=2)
    outside = distance_transform_edt(~region)
    i, j = np.nonzero((layer + outside <= INSIDE) & (outside <= OUTSIDE))
    phi, safe = shape.about_cells(i, j)
    of_cells = np.broadcast_to(exponent, means.shape)[i, j] if np.ndim(exponent) else exponent
    parts, covered = _in_parts(phi, of_cells)
    fade = np.clip((layer[i, j] - WHOLE) / (INSIDE - WHOLE), 0, 1)[:, None, None]
    parts = (1 - fade) * parts + fade * _slopes_alone(means / scale, i, j)
    inside = region.copy()
    inside[i[safe], j[safe]] = phi.f[safe] > 0
    return Rim(
        inside, i[safe], j[safe], scale * parts[safe], covered[safe], 1 - float(np.mean(safe))
    )


def _in_parts(phi: Quadratic, exponent: Exponent) -> tuple[Field, Field]:
    """Mean of phi_+^exponent over the parts of each cell (n, PARTS, PARTS), and the part of each
    where phi is positive (n,)."""
    x, y = np.meshgrid(part_centres(), part_centres(), indexing="ij")
    monomials = np.stack([x**0, x, y, x**2 / 2, x * y, y**2 / 2])
    bent = (phi.f_xx + phi.f_yy) / (24 * PARTS**2)
    factors = np.stack([phi.f + bent, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy])
    # Not by matrix products, whose rounding depends on the number of threads.
    f = np.einsum("kn,kab->nab", factors, monomials)
    # Over a part of a cell the slope hardly changes.
    f_x, f_y = (
        np.broadcast_to((slope / PARTS)[:, None, None], f.shape) for slope in (phi.f_x, phi.f_y)
    )
    a = exponent[:, None, None] if isinstance(exponent, np.ndarray) else exponent
    slope = np.abs(f_x) + np.abs(f_y)
    smooth = f > SMOOTH * slope
    bend = a * (a - 1) / 24 * (f_x**2 + f_y**2) / np.where(smooth, f, np.inf) ** 2
    parts = power(np.maximum(f, 0.0), a) * (1 + bend)
    covered = smooth.astype(float)
    cut = ~smooth & (f > -slope)
    of_cut = f[cut], f_x[cut], f_y[cut]
    parts[cut] = mean_power(*of_cut, np.broadcast_to(a, f.shape)[cut] if np.ndim(a) else a)
    covered[cut] = mean_power(*of_cut, 0.0)
    return parts, covered.mean(axis=(1, 2))


def _slopes_alone(means: Field, i: Indices, j: Indices) -> Field:
    """Parts (n, PARTS, PARTS) of a traction with the slopes of central differences."""
    along_x, along_y = (np.gradient(means, axis=axis)[i, j, None, None] for axis in (0, 1))
    x = part_centres()
    return np.asarray(means[i, j, None, None] + along_x * x[:, None] + along_y * x)
