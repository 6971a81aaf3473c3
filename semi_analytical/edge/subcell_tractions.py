"""Tractions in the subcells of cells along the edge of a region, from fits of φ = p^(1/α).

The region is a contact area with the pressure p, or a stick zone with the shear deficit p. The edge
correction computes displacements from these subcell tractions.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import (
    Exponent,
    mean_of_cut,
    mean_of_smooth,
)
from semi_analytical.edge.contact_area import near
from semi_analytical.edge.edge_geometry import EdgeLine
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.film_shape import FilmShape, film_shape
from semi_analytical.edge.fit import NEXT, WIDER, Stencil, window_indices
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import LARGEST_RMS, AdjacentCells, EdgeShape, depth_of, edge_shape
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Least radius in cells of a region that can be fitted.
THICK = 1.9
# Depths up to which subcells come from fits, and from second differences with weights that
# decrease to zero. Deeper cells have slopes only, with an error of 1/500.
FITTED = 2.5
INSIDE = 5.5
# Stencils wider than for exact means damp the spread of errors between cells. On films narrow fits
# near a plateau of the pressure yield oscillating edges. A variable exponent is valid in the slip
# zone only, which is often narrow.
STENCIL = Stencil(4, 2.2)
OF_FILM = WIDER
# Distance in cells by which the edge must pass a cell centre before the cell changes sides.
# Without this margin cells alternate between both sides and the iteration does not converge.
PASSED = 0.01

# Value over the sum of the slopes of a subcell above which the binomial series is used.
SMOOTH = 1.5
# Number of cells at a time, limited by the processor cache.
CHUNK = 512
X, Y = (at.ravel() for at in np.meshgrid(part_centres(), part_centres(), indexing="ij"))
MONOMIALS = np.stack([X**0, X, Y, X**2 / 2, X * Y, Y**2 / 2])
# Mean of X²/2 over the subcells of a cell.
HALF_SQUARE = np.mean(X**2) / 2


@dataclass(frozen=True)
class EdgeCells:
    """Cells along the edge of a contact area or stick zone, by the method for their subcells.

    region  cells of the contact area or stick zone (nx, ny)
    domain  domain of the region: full window or reduced domain
    """

    region: Mask
    domain: ReducedDomain

    def __getstate__(self) -> dict[str, object]:
        """Return the state for a checkpoint, without fields that follow from the region."""
        return {"region": self.region, "domain": self.domain}

    @cached_property
    def depth(self) -> Field:
        """Distance of each cell of the region from the nearest cell outside (nx, ny), in cells.

        The distance is at most DEEP of `shape`, and zero outside the region.
        """
        return depth_of(self.region, self.domain)

    @cached_property
    def fitted(self) -> tuple[Indices, Indices]:
        """Indices of the cells nearest to the edge, whose subcell tractions come from fits of φ.

        φ is a function of the traction that vanishes at the edge. Cells next to the region are
        included, because the edge may cut them.
        """
        touched = near(self.domain.add_frame(self.region, 1))
        i, j = np.nonzero(touched & (self.depth <= FITTED))
        return i, j

    @cached_property
    def adjacent(self) -> AdjacentCells:
        """Local fits of φ that determine φ in each of the `fitted` cells.

        φ is a function of the traction that vanishes at the edge of the region. A cell inside the
        region has the fit about itself, and a cell next to the region those about its neighbours.
        """
        return AdjacentCells(self.depth, *self.fitted)

    @cached_property
    def deep(self) -> tuple[Indices, Indices]:
        """Indices of the cells farther inside, with subcell tractions by differences of cell means.

        Their depth is above FITTED and at most INSIDE.
        """
        i, j = np.nonzero((self.depth > FITTED) & (self.depth <= INSIDE))
        return i, j


@dataclass(frozen=True)
class SubcellTractions:
    """Tractions in the subcells of cells along the edge of a contact area or stick zone.

    Each of these cells has PARTS x PARTS subcells. The traction is the pressure or the shear
    deficit. φ is a power of the traction that vanishes smoothly at the edge.

    region  cells whose centre is inside the edge (nx, ny)
    i, j    indices of the cells (n,): fitted cells first, then deeper cells
    parts   mean of the traction over each subcell (n, PARTS, PARTS) [force/length^2]
    phi     quadratics of φ about the fitted cells
    unsafe  fraction of the cells along the edge without a reliable fit
    cells   edge cells of the region before the fit
    line    points of the edge of a contact of layered bodies; None for a power of the distance
    fits    cell means of φ (nx, ny), and the fits to them; None for layered bodies
    """

    region: Mask
    i: Indices
    j: Indices
    parts: Field
    phi: Quadratic
    unsafe: float
    cells: EdgeCells
    line: EdgeLine | None = None
    fits: tuple[Field, Quadratic] | None = None

    @property
    def domain(self) -> ReducedDomain:
        """Domain of all fields of these tractions: full window or reduced domain."""
        return self.cells.domain

    @property
    def covered(self) -> Field:
        """Fraction of each cell inside the edge of the contact area or stick zone (nx, ny)."""
        covered, fitted = self.cells.region.astype(float), slice(len(self.phi.f))
        covered[self.i[fitted], self.j[fitted]] = self.phi.cell_mean(0.0)
        return covered

    @cached_property
    def area(self) -> float:
        """Area inside the edge of the contact area or stick zone, in cells, with its mirror images.

        Cells that the edge cuts count by their covered fraction.
        """
        return self.domain.images * float(np.sum(self.covered))

    @cached_property
    def outer(self) -> Mask:
        """Mask (nx, ny) of the partly covered cells whose centre lies outside the edge."""
        return (self.means > 0) & ~self.region

    @cached_property
    def means(self) -> Field:
        """Mean of the traction over each cell along the edge (nx, ny) [force/length^2].

        The means of the other cells are zero.
        """
        means = np.zeros(self.region.shape)
        means[self.i, self.j] = self.parts.mean(axis=(1, 2))
        return means


def fit_edge(
    means: Field,
    loaded: Mask,
    before: SubcellTractions | None = None,
    exponent: Exponent = 0.5,
    domain: ReducedDomain = WINDOW,
    film: FilmLaw | None = None,
) -> SubcellTractions | None:
    """Fit the edge of a contact area or stick zone, and compute the subcell tractions there.

    None is returned if no cell of the region is deeper than THICK, which is too thin for a fit.

    means     mean of the pressure or shear deficit over each cell (nx, ny) [force/length^2]
    loaded    cells with a positive traction (nx, ny)
    before    fitted edge of the previous iteration; cells whose centre is outside that edge are not
              data
    exponent  exponent α of the traction p ~ s^α at the distance s from the edge; a number or (nx,
              ny)
    domain    domain of all fields: full window or reduced domain
    film      law of the pressure near the edge of layered bodies; None for a power of the distance
    """
    region = loaded if before is None else loaded & before.region
    same = before is not None and np.array_equal(region, before.cells.region)
    cells = before.cells if before is not None and same else EdgeCells(region, domain)
    depth = cells.depth
    if np.max(depth) <= THICK:
        return None
    largest = np.max(means)
    scaled = means / largest
    shape: EdgeShape
    if film is None:
        # Fits of other cells lag behind: φ and its weights are theirs, and a change alternates.
        shape = edge_shape(
            scaled,
            region,
            STENCIL,
            rings=0,
            exponent=exponent,
            depth=depth,
            domain=domain,
            before=before.fits if before and same else None,
        )
    else:
        line = before.line if before else None
        stencil = STENCIL if isinstance(exponent, np.ndarray) else OF_FILM
        shape = film_shape(scaled, region, stencil, film, depth, domain, exponent, line)
    (i, j), (deep_i, deep_j) = cells.fitted, cells.deep
    fits = shape.fits(*cells.adjacent.fitted)
    phi, error = shape.about_cells(cells.adjacent, fits)
    safe = error < LARGEST_RMS
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
            [parts * largest, tractions_by_differences(means, deep_i, deep_j, fade, domain)]
        ),
        phi=phi,
        unsafe=unsafe,
        cells=cells,
        line=shape.line if isinstance(shape, FilmShape) else None,
        fits=None if isinstance(shape, FilmShape) else (shape.phi, fits.quadratic),
    )


def means_of_power(phi: Quadratic, exponent: Exponent) -> Field:
    """Compute the mean of φ_+^exponent over each subcell of n cells (n, PARTS, PARTS).

    φ is the function that vanishes at the contact edge, so that the means are those of the
    traction. Negative φ counts as zero. Cells are processed in chunks of CHUNK.

    phi       quadratics of φ about the cells (n,)
    exponent  exponent α of the traction p = φ^α, a number or (n,)
    """
    parts = np.empty((len(phi.f), PARTS**2))
    for first in range(0, len(parts), CHUNK):
        some = slice(first, first + CHUNK)
        a = exponent[some, None] if isinstance(exponent, np.ndarray) else exponent
        parts[some] = _means_of_power(phi.chosen(some), a)
    return parts.reshape(-1, PARTS, PARTS)


def _means_of_power(phi: Quadratic, a: Exponent) -> Field:
    """Compute the mean of φ_+^a over each subcell of the cells of one chunk (n, PARTS²).

    φ is the function that vanishes at the contact edge, so that the means are those of the
    traction. Negative φ counts as zero.

    phi  quadratics of φ about the cells (n,)
    a    exponent of the traction p = φ^a, a number or (n, 1)
    """
    bent = (phi.f_xx + phi.f_yy) / (24 * PARTS**2)
    factors = np.array([phi.f + bent, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy])
    f = factors.T @ MONOMIALS
    # The slope is taken as constant over a cell: it is that at the cell centre.
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


def tractions_by_differences(
    means: Field, i: Indices, j: Indices, fade: Field, domain: ReducedDomain
) -> Field:
    """Compute the traction in each subcell of cells away from the edge (n, PARTS, PARTS).

    The traction in a cell is a quadratic, whose coefficients follow from differences of the means
    over the cell and its neighbours.

    means   cell means of the traction (nx, ny)
    i, j    indices of the cells (n,)
    fade    weight of the second differences, from 1 near the edge to 0 inside (n,)
    domain  domain of `means`: full window or reduced domain
    """
    framed = domain.add_frame(means, 1)
    about = framed.take(window_indices(i, j, NEXT, framed.shape[1]))
    first, lower, second, left, centre, right, third, upper, last = about.T
    corners = last + first - third - second
    f_xx, f_yy = fade * (lower + upper - 2 * centre), fade * (left + right - 2 * centre)
    f = centre - HALF_SQUARE * (f_xx + f_yy)
    slopes = (upper - lower) / 2, (right - left) / 2
    factors = np.array([f, *slopes, f_xx, fade * corners / 4, f_yy])
    return (factors.T @ MONOMIALS).reshape(-1, PARTS, PARTS)
