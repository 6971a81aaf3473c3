"""Traction in the subcells along the edge of a region, from fits of phi there."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.ndimage import binary_dilation

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import (
    Exponent,
    mean_of_cut,
    mean_of_smooth,
)
from semi_analytical.edge.edge_geometry import EdgeLine
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.film_shape import FilmShape, film_shape
from semi_analytical.edge.fit import WIDER, Stencil
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import LARGEST_RMS, EdgeShape, depth_of, edge_shape
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Least radius of a region in cells that can be fitted.
THICK = 1.9
# Layers inside the edge with subcells from fits, and with subcells from second differences, which
# fade out towards the last layer. Farther in a traction is a slope within a cell, to 1/500 of it.
FITTED, INSIDE = 2.5, 5.5
# Wider than for exact means: the error of one cell shall not spread to the others. Next to a
# plateau of the pressure on a film narrow fits give edges that waver; but where friction slips at
# the edge, the exponent holds within the slip zone, which is often narrow.
STENCIL, OF_FILM = Stencil(4, 2.2), WIDER
# By this part of a cell the edge must have passed the centre of a cell to change its side:
# otherwise cells alternate between both sides and the iteration does not settle.
PASSED = 0.01

# So many times its slopes above zero, a part of a cell has the mean of a power by its series.
SMOOTH = 1.5
# Cells whose parts are found at a time: as many as stay in the cache.
CHUNK = 512
X, Y = (at.ravel() for at in np.meshgrid(part_centres(), part_centres(), indexing="ij"))
MONOMIALS = np.stack([X**0, X, Y, X**2 / 2, X * Y, Y**2 / 2])
# Mean of X²/2 over the parts of a cell.
HALF_SQUARE = np.mean(X**2) / 2


@dataclass(frozen=True)
class SubcellTractions:
    """Cells along the edge of a region with a reliable fit.

    region   (nx, ny) cells whose centre is inside the edge
    i, j     the cells (n,)
    parts    (n, PARTS, PARTS) mean of the traction over the subcells of each
    area     of the region and its mirror images, in cells
    unsafe   part of all cells along the edge without a reliable fit
    domain     that all fields are given on
    line     edge of a contact on a film
    phi      (nx, ny) cell means of phi without a film
    """

    region: Mask
    i: Indices
    j: Indices
    parts: Field
    area: float
    unsafe: float
    domain: ReducedDomain
    line: EdgeLine | None = None
    phi: Field | None = None

    @cached_property
    def outer(self) -> Mask:
        """(nx, ny) cells that the region reaches into and whose centre is outside."""
        return (self.means > 0) & ~self.region

    @cached_property
    def means(self) -> Field:
        """(nx, ny) mean of the traction over each of the cells, zero elsewhere."""
        means = np.zeros(self.region.shape)
        means[self.i, self.j] = self.parts.mean(axis=(1, 2))
        return means


def rim(
    means: Field,
    loaded: Mask,
    before: SubcellTractions | None = None,
    exponent: Exponent = 0.5,
    domain: ReducedDomain = WINDOW,
    film: FilmLaw | None = None,
) -> SubcellTractions | None:
    """Fit the rim of a region of tractions; None where the region is too thin.

    means     (nx, ny) mean of the traction over each cell [force/length^2]
    loaded    (nx, ny) cells where it is positive
    before    rim of the preceding iteration: cells outside it are not fitted to
    exponent  power of the distance from the edge with which the traction falls
    domain      that all fields are given on
    film      law of a pressure on layered bodies, a factor of that power
    """
    region = loaded if before is None else loaded & before.region
    depth = depth_of(region, domain)
    if np.max(depth) <= THICK:
        return None
    largest = np.max(means)
    scaled = means / largest
    shape: EdgeShape
    if film is None:
        shape = edge_shape(
            scaled, region, STENCIL, rings=0, exponent=exponent, depth=depth, domain=domain,
            before=before.phi if before else None,
        )  # fmt: skip
    else:
        line = before.line if before else None
        stencil = STENCIL if isinstance(exponent, np.ndarray) else OF_FILM
        shape = film_shape(scaled, region, stencil, film, depth, domain, exponent, line)
    touched = binary_dilation(domain.framed(region, 1), np.ones((3, 3)))[1:-1, 1:-1]
    i, j = np.nonzero(touched & (depth <= FITTED))
    deep_i, deep_j = np.nonzero((depth > FITTED) & (depth <= INSIDE))
    phi, missed = shape.about_cells(i, j)
    safe = missed < LARGEST_RMS
    i, j, phi = i[safe], j[safe], phi.chosen(safe)
    parts = means_of_power(phi, exponent[i, j] if isinstance(exponent, np.ndarray) else exponent)
    if isinstance(shape, FilmShape):
        parts *= shape.parts_over_root(phi)
    fade = (INSIDE - depth[deep_i, deep_j]) / (INSIDE - FITTED)
    inside, covered = region.copy(), region.astype(float)
    side = np.zeros(len(i)) if before is None else np.where(before.region[i, j], 1.0, -1.0)
    inside[i, j] = phi.f > -PASSED * side * phi.slope
    covered[i, j] = phi.cell_mean(0.0)
    return SubcellTractions(
        region=inside,
        i=np.concatenate([i, deep_i]),
        j=np.concatenate([j, deep_j]),
        parts=np.concatenate(
            [parts * largest, by_differences(means, deep_i, deep_j, fade, domain)]
        ),
        area=domain.images * float(np.sum(covered)),
        unsafe=np.count_nonzero(~safe) / (len(safe) + len(deep_i)),
        domain=domain,
        line=shape.line if isinstance(shape, FilmShape) else None,
        phi=None if isinstance(shape, FilmShape) else shape.phi,
    )


def means_of_power(phi: Quadratic, exponent: Exponent) -> Field:
    """Mean of phi_+^exponent over the parts of each cell (n, PARTS, PARTS)."""
    parts = np.empty((len(phi.f), PARTS**2))
    for first in range(0, len(parts), CHUNK):
        some = slice(first, first + CHUNK)
        a = exponent[some, None] if isinstance(exponent, np.ndarray) else exponent
        parts[some] = _means_of_power(phi.chosen(some), a)
    return parts.reshape(-1, PARTS, PARTS)


def _means_of_power(phi: Quadratic, a: Exponent) -> Field:
    """The same of some cells (n, PARTS²); the exponent a number or (n, 1)."""
    bent = (phi.f_xx + phi.f_yy) / (24 * PARTS**2)
    factors = np.stack([phi.f + bent, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy], axis=1)
    f = factors @ MONOMIALS
    # Over a part of a cell the slope hardly changes.
    f_x, f_y = np.abs(phi.f_x[:, None]) / PARTS, np.abs(phi.f_y[:, None]) / PARTS
    slope = f_x + f_y
    smooth = f >= SMOOTH * slope
    if np.all(smooth):
        return mean_of_smooth(f, f_x, f_y, a)
    parts = mean_of_smooth(np.where(smooth, f, slope), f_x, f_y, a)
    parts *= smooth
    cell, part = np.nonzero(~smooth & (f > -slope / 2))
    of_cell = (f_x[cell, 0], f_y[cell, 0], a[cell, 0] if isinstance(a, np.ndarray) else a)
    parts[cell, part] = mean_of_cut(f[cell, part], *of_cell)
    return parts


def by_differences(
    means: Field, i: Indices, j: Indices, fade: Field, domain: ReducedDomain
) -> Field:
    """Parts (n, PARTS, PARTS) of a traction, given by means (nx, ny), in the cells (i, j).

    fade  weight of the second differences (n,)
    """
    i, j = i + 1, j + 1
    p = domain.framed(means, 1)
    centre = p[i, j]
    lower, upper, left, right = p[i - 1, j], p[i + 1, j], p[i, j - 1], p[i, j + 1]
    corners = p[i + 1, j + 1] + p[i - 1, j - 1] - p[i + 1, j - 1] - p[i - 1, j + 1]
    f_xx, f_yy = fade * (lower + upper - 2 * centre), fade * (left + right - 2 * centre)
    f = centre - HALF_SQUARE * (f_xx + f_yy)
    slopes = (upper - lower) / 2, (right - left) / 2
    factors = np.stack([f, *slopes, f_xx, fade * corners / 4, f_yy], axis=1)
    return (factors @ MONOMIALS).reshape(-1, PARTS, PARTS)
