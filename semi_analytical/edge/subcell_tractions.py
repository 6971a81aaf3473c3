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
from semi_analytical.edge.shape import LARGEST_RMS, AdjacentCells, EdgeShape, depth_of, edge_shape
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
class Band:
    """Cells along the edge of a region (nx, ny) of a domain."""

    region: Mask
    domain: ReducedDomain

    def __getstate__(self) -> dict[str, object]:
        """Leave out of checkpoints what is computed from the region."""
        return {"region": self.region, "domain": self.domain}

    @cached_property
    def depth(self) -> Field:
        """(nx, ny), see `depth_of`."""
        return depth_of(self.region, self.domain)

    @cached_property
    def fitted(self) -> tuple[Indices, Indices]:
        """Cells with subcells from fits."""
        framed = self.domain.framed(self.region, 1)
        touched = binary_dilation(framed, np.ones((3, 3)))[1:-1, 1:-1]
        i, j = np.nonzero(touched & (self.depth <= FITTED))
        return i, j

    @cached_property
    def adjacent(self) -> AdjacentCells:
        """Cells whose fits describe phi about the fitted cells."""
        return AdjacentCells(self.depth, *self.fitted)

    @cached_property
    def deep(self) -> tuple[Indices, Indices]:
        """Cells with subcells from second differences."""
        i, j = np.nonzero((self.depth > FITTED) & (self.depth <= INSIDE))
        return i, j


@dataclass(frozen=True)
class SubcellTractions:
    """Cells along the edge of a region with a reliable fit.

    region   (nx, ny) cells whose centre is inside the edge
    i, j     the cells (n,)
    parts    (n, PARTS, PARTS) mean of the traction over the subcells of each
    phi      about those of the cells that have subcells from fits, the first ones
    unsafe   part of all cells along the edge without a reliable fit
    band     of the cells that were fitted
    line     edge of a contact on a film
    known    (nx, ny) cell means of phi without a film, and the fits to them
    """

    region: Mask
    i: Indices
    j: Indices
    parts: Field
    phi: Quadratic
    unsafe: float
    band: Band
    line: EdgeLine | None = None
    known: tuple[Field, Quadratic] | None = None

    @property
    def domain(self) -> ReducedDomain:
        """That all fields are given on."""
        return self.band.domain

    @cached_property
    def area(self) -> float:
        """Of the region and its mirror images, in cells."""
        covered, fitted = self.band.region.astype(float), slice(len(self.phi.f))
        covered[self.i[fitted], self.j[fitted]] = self.phi.cell_mean(0.0)
        return self.domain.images * float(np.sum(covered))

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
    same = before is not None and np.array_equal(region, before.band.region)
    band = before.band if before is not None and same else Band(region, domain)
    depth = band.depth
    if np.max(depth) <= THICK:
        return None
    largest = np.max(means)
    scaled = means / largest
    shape: EdgeShape
    if film is None:
        shape = edge_shape(
            scaled, region, STENCIL, rings=0, exponent=exponent, depth=depth, domain=domain,
            before=before.known if before else None,
        )  # fmt: skip
    else:
        line = before.line if before else None
        stencil = STENCIL if isinstance(exponent, np.ndarray) else OF_FILM
        shape = film_shape(scaled, region, stencil, film, depth, domain, exponent, line)
    (i, j), (deep_i, deep_j) = band.fitted, band.deep
    fits = shape.fits(*band.adjacent.fitted)
    phi, missed = shape.about_cells(band.adjacent, fits)
    safe = missed < LARGEST_RMS
    unsafe = np.count_nonzero(~safe) / (len(safe) + len(deep_i))
    if unsafe:
        i, j, phi = i[safe], j[safe], phi.chosen(safe)
    parts = means_of_power(phi, exponent[i, j] if isinstance(exponent, np.ndarray) else exponent)
    if isinstance(shape, FilmShape):
        parts *= shape.parts_over_root(phi)
    fade = (INSIDE - depth[deep_i, deep_j]) / (INSIDE - FITTED)
    inside = region.copy()
    side = np.zeros(len(i)) if before is None else np.where(before.region[i, j], 1.0, -1.0)
    inside[i, j] = phi.f > -PASSED * side * phi.slope
    return SubcellTractions(
        region=inside,
        i=np.concatenate([i, deep_i]),
        j=np.concatenate([j, deep_j]),
        parts=np.concatenate(
            [parts * largest, by_differences(means, deep_i, deep_j, fade, domain)]
        ),
        phi=phi,
        unsafe=unsafe,
        band=band,
        line=shape.line if isinstance(shape, FilmShape) else None,
        known=None if isinstance(shape, FilmShape) else (shape.phi, fits.quadratic),
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
    factors = np.array([phi.f + bent, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy])
    f = factors.T @ MONOMIALS
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
    factors = np.array([f, *slopes, f_xx, fade * corners / 4, f_yy])
    return (factors.T @ MONOMIALS).reshape(-1, PARTS, PARTS)
