"""Shape of φ = p^(1/α) near the edge of a region, from fits to the cell means of p.

The region is a contact area or a stick zone. φ passes smoothly through zero at the edge.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.ndimage import distance_transform_edt

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import (
    Exponent,
    centre_value,
    power,
)
from semi_analytical.edge.fit import Fits, Stencil, fit_about
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Weight of cells that the edge cuts.
CUT_WEIGHT = 0.2
# Least number of data of a reliable fit.
LEAST_DATA = 10
# Largest rms of a reliable fit over the change of φ across a cell.
LARGEST_RMS = 0.25
# Depth in cells up to which fits can be evaluated.
MAX_FIT_DEPTH = 3.5
# Largest step towards the edge, and largest distance of the edge point, in cells.
LONGEST_STEP, FARTHEST = 1.0, 2.0
REFITS = 3
# Offsets to the cell itself, to side neighbours and to corner neighbours (2, 9, 1).
STEPS = np.array([[0, 1, -1, 0, 0, 1, 1, -1, -1], [0, 0, 0, 1, -1, 1, -1, 1, -1]])[..., None]
SIDES = 4


@dataclass(frozen=True)
class EdgeShape:
    """Cell means of φ = p^(1/α) in a region, and fits to these means near the edge of the region.

    means     (nx, ny) cell means of p
    phi       (nx, ny) cell means of φ; valid for positive weights
    weight    (nx, ny) weights of the cells in fits
    exponent  α, a number or (nx, ny)
    stencil   window and weights of the fits
    depth     (nx, ny) distance to the nearest cell outside the region in cells, zero outside
    domain    domain of all fields
    """

    means: Field
    phi: Field
    weight: Field
    exponent: Exponent
    stencil: Stencil
    depth: Field
    domain: ReducedDomain = WINDOW

    @cached_property
    def nearest_cells(self) -> Indices:
        """Indices (2, nx, ny) of the cell of the contact or stick region that is nearest to each
        cell."""
        found = distance_transform_edt(self.depth == 0, return_distances=False, return_indices=True)
        return np.asarray(found)

    def fits(self, i: Indices, j: Indices) -> Fits:
        """Fit quadratics to the cell means of φ about cells of the region.

        φ = p^(1/α) is a smooth function that vanishes at the edge of the region, with the traction
        p.

        i, j  indices of the cells (n,)
        """
        return fit_about(self.phi, self.weight, i, j, self.stencil, domain=self.domain)

    def nearest_to(self, x: Field, y: Field) -> Indices:
        """Return the indices (2, n) of the cells of the region that are nearest to places (x,
        y), shape (n,)."""
        last = np.array(self.means.shape) - 1
        i, j = (np.clip(np.rint(at), 0, n).astype(int) for at, n in zip((x, y), last, strict=True))
        return self.nearest_cells[:, i, j]

    def about(self, x: Field, y: Field) -> tuple[Quadratic, Mask]:
        """Expand φ about places near the edge of the region, by local fits.

        φ = p^(1/α) is a smooth function that vanishes at the edge, with the traction p. At places
        outside the region the fit about the nearest cell of the region is used. A fit centred
        outside has one-sided data and a hundredfold error.

        x, y     places in index coordinates (n,)
        returns  quadratics of φ about the places, and True for reliable fits (n,)
        """
        fits = self.fits(*self.nearest_to(x, y))
        return fits.quadratic.about(x, y), reliable(fits)

    def about_cells(self, adjacent: "AdjacentCells", fits: Fits) -> tuple[Quadratic, Field]:
        """Expand φ about cells of the region and about cells adjacent to the region, shape (n,).

        φ = p^(1/α) is a smooth function that vanishes at the edge of the region, with the traction
        p. The second result is the rms residual of the fits over the change of φ across a cell. It
        is infinite for fits with few data.

        adjacent  cells, and the fits that determine φ there
        fits      fits about `adjacent.fitted`
        """
        error = np.where(fits.count < LEAST_DATA, np.inf, fits.rms)
        error /= np.maximum(fits.quadratic.slope, np.finfo(float).tiny)
        each = fits.quadratic.chosen(adjacent.which).about(*adjacent.at)
        means = [
            np.bincount(adjacent.place, value * adjacent.share, adjacent.count).astype(float)
            for value in (*vars(each).values(), error[adjacent.which])
        ]
        return Quadratic(*means[:-1]), means[-1]

    def edge_points(self, x: Field | Indices, y: Field | Indices) -> tuple[Quadratic, Mask]:
        """Find the edge points nearest to given places, and expand φ about these points, shape
        (n,).

        φ = p^(1/α) vanishes at the edge, with the traction p. Newton steps along the gradient find
        the edge points, with new fits in the first REFITS steps. At the edge points φ is zero up to
        rounding. The second result is True for reliable fits.

        x, y  places in index coordinates (n,)
        """
        at_x, at_y = x.astype(float), y.astype(float)
        for _ in range(REFITS):
            here, safe = self.about(at_x, at_y)
            at_x, at_y = _step_to_edge(here)
        on_it = here.about(at_x, at_y)
        for _ in range(REFITS):
            on_it = here.about(*_step_to_edge(on_it))
        return on_it, safe & (np.hypot(on_it.x - x, on_it.y - y) < FARTHEST)


class AdjacentCells:
    """Assignment of fits of φ to cells in a region or next to its edge, as pairs of a cell and a
    fit.

    A cell of the region uses the fit about itself. A cell outside uses the mean of the fits about
    its side neighbours in the region, or without side neighbours about its corner neighbours. This
    rule preserves mirror symmetry.

    fitted  (2, m) indices of the cells about which fits are needed
    which   index of the fit of each pair
    place   index of the cell of each pair
    at      coordinates of the cell of each pair, along x and y
    share   weight of the fit of each pair
    count   number of cells
    """

    def __init__(self, depth: Field, i: Indices, j: Indices) -> None:
        """Find the fits that determine φ at cells (i, j) in a region or next to its edge.

        depth  depth of the region (nx, ny), see `depth_of`
        """
        last = np.array(depth.shape)[:, None, None] - 1
        at = np.stack([i, j])[:, None] + STEPS
        inside = np.all((at >= 0) & (at <= last), axis=0)
        inside &= depth[tuple(np.clip(at, 0, last))] > 0
        inside[1:, inside[0]] = False
        inside[1 + SIDES :, np.any(inside[: 1 + SIDES], axis=0)] = False
        step, self.place = np.nonzero(inside)
        number = np.ravel_multi_index(tuple(at[:, step, self.place]), depth.shape)
        cells, self.which = np.unique(number, return_inverse=True)
        self.fitted = np.unravel_index(cells, depth.shape)
        self.at = i[self.place].astype(float), j[self.place].astype(float)
        self.share = 1 / np.sum(inside, axis=0)[self.place]
        self.count = len(i)


def _step_to_edge(here: Quadratic) -> tuple[Field, Field]:
    """Move places towards the edge of the region, where φ = 0, by one Newton step of at most one
    cell.

    Return the new coordinates x and y.

    here  quadratic fits of φ about the present places
    """
    squared = np.maximum(here.slope**2, np.finfo(float).tiny)
    step = here.f / squared
    step = step * np.minimum(1.0, LONGEST_STEP / np.maximum(np.abs(step) * here.slope, 1e-30))
    return here.x - step * here.f_x, here.y - step * here.f_y


def reliable(fits: Fits) -> Mask:
    """Return True for fits of φ that have enough data and small residuals, compared with the
    slope."""
    few = fits.count < LEAST_DATA
    return np.asarray(~few & (fits.rms < LARGEST_RMS * fits.quadratic.slope))


def edge_shape(
    means: Field,
    region: Mask,
    stencil: Stencil,
    *,
    rings: int = 1,
    exponent: Exponent = 0.5,
    rounds: int = 3,
    depth: Field | None = None,
    domain: ReducedDomain = WINDOW,
    before: tuple[Field, Quadratic] | None = None,
) -> EdgeShape:
    """Determine the cell means of φ = p^(1/α) in a region from the cell means of p.

    Cells that the edge cuts use the slopes of preceding fits, because there φ is not a power of the
    mean.

    means     (nx, ny) cell means of p, positive in the region
    region    (nx, ny) cells of the region
    stencil   stencil of the fits: `NARROW` for one ring, `WIDE` for two
    rings     number of outermost layers of cells that are not data: 1 for exact or corrected means,
              2 for means of a solver without edge correction; with 0 all cells are data, cut cells
              with CUT_WEIGHT
    exponent  α in p ~ s^α, s the distance from the edge; a number or a smooth field (nx, ny)
    rounds    number of computations of φ: the first is means^(1/α) without cut cells; the others
              use `centre_value` with the slopes of the preceding fits
    depth     depth of the region if known, see `depth_of`
    domain    domain of all fields
    before    φ of a previous iteration and fits along the edge; they replace the first fits

    Raises ValueError if no cell remains as data.
    """
    means = np.where(region, means, 0.0)
    depth = depth_of(region, domain) if depth is None else depth
    data = region & (depth >= rings + 0.5)
    inner = region & (depth >= max(rings, 1) + 0.5)
    if not np.any(inner):
        raise ValueError(
            f"the region is {np.max(depth):.3g} cells deep, of which {rings} rings are not data: "
            "no cell remains for the fit of its edge. Use smaller cells"
        )
    band = data & (depth < MAX_FIT_DEPTH + 1.5 * stencil.reach)
    of_band = exponent[band] if isinstance(exponent, np.ndarray) else exponent
    phi, weight = power(means, np.divide(1, exponent)), inner.astype(float)
    # Deeper cells use differences of φ as slopes, because φ hardly depends on them there.
    i, j = np.nonzero(band & (depth < max(rings, 1) + 2))
    near = None if before is None else before[0][band]
    if before is not None:
        phi, rounds = before[0], 2
    for _ in range(rounds - 1):
        if before is None:
            fit = fit_about(phi, weight, i, j, stencil, domain=domain).quadratic
        else:
            fit = before[1]
            i, j = fit.x.astype(int), fit.y.astype(int)
        slopes = domain.differences(phi)
        slopes[:, i, j] = fit.f_x, fit.f_y
        phi = phi.copy()
        phi[band] = centre_value(means[band], slopes[0][band], slopes[1][band], of_band, near)
        weight = data.astype(float)
        weight[i, j] *= np.where(fit.cut, CUT_WEIGHT, 1.0)
    return EdgeShape(means, phi, weight, exponent, stencil, depth, domain)


def depth_of(region: Mask, domain: ReducedDomain = WINDOW) -> Field:
    """Compute the distance of each cell of a region from the nearest cell outside (nx, ny), in
    cells.

    Cells beyond the window count as outside. The result is zero at cells outside the region.
    """
    return np.asarray(distance_transform_edt(domain.add_frame(region, 1))[1:-1, 1:-1])
