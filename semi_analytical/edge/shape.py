"""Shape of the edge of a region: phi = p^(1/alpha), fitted to cell means of p inside it."""

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

CUT_WEIGHT = 0.2
LEAST_DATA = 10
# Largest rms of a fit in the fall of phi over a cell.
LARGEST_RMS = 0.25
# Cells inwards of the edge about which a fit may be asked for.
ASKED = 3.5
# Of a step to the edge, and of all of them, in cells.
LONGEST_STEP, FARTHEST = 1.0, 2.0
REFITS = 3
# From a cell to itself, to the cells that touch it at a side, and at a corner (2, 9, 1).
STEPS = np.array([[0, 1, -1, 0, 0, 1, 1, -1, -1], [0, 0, 0, 1, -1, 1, -1, 1, -1]])[..., None]
SIDES = 4


@dataclass(frozen=True)
class EdgeShape:
    """phi on the cells of a region, ready to be fitted anywhere near its edge.

    means      (nx, ny) cell means of p that it was made of
    phi        (nx, ny) cell means of phi, where weight > 0
    weight     (nx, ny) how much a cell is believed
    exponent   alpha, a number or (nx, ny)
    stencil    of the fits
    depth      (nx, ny) distance to the nearest cell outside of the region, zero there
    domain       that all are on
    """

    means: Field
    phi: Field
    weight: Field
    exponent: Exponent
    stencil: Stencil
    depth: Field
    domain: ReducedDomain = WINDOW

    @cached_property
    def nearest(self) -> Indices:
        """(2, nx, ny) indices of the nearest cell of the region."""
        found = distance_transform_edt(self.depth == 0, return_distances=False, return_indices=True)
        return np.asarray(found)

    def fits(self, i: Indices, j: Indices) -> Fits:
        """Fits about cells of the region, shape (n,)."""
        return fit_about(self.phi, self.weight, i, j, self.stencil, domain=self.domain)

    def nearest_to(self, x: Field, y: Field) -> Indices:
        """Cells of the region nearest to places (n,), indices (2, n)."""
        last = np.array(self.means.shape) - 1
        i, j = (np.clip(np.rint(at), 0, n).astype(int) for at, n in zip((x, y), last, strict=True))
        return self.nearest[:, i, j]

    def about(self, x: Field, y: Field) -> tuple[Quadratic, Mask]:
        """phi about any places near the edge, shape (n,), and whether to believe it.

        Outside of the region from the fit about its nearest cell: a window centred outside has its
        data on one side only, which costs two digits.
        """
        fits = self.fits(*self.nearest_to(x, y))
        return fits.quadratic.about(x, y), believed(fits)

    def about_cells(self, adjacent: "AdjacentCells", fits: Fits) -> tuple[Quadratic, Field]:
        """phi about cells of the region and cells that touch it, shape (n,), and the rms of the
        fits over the fall of phi over a cell, infinite where there is little data.

        fits  about `adjacent.fitted`
        """
        missed = np.where(fits.count < LEAST_DATA, np.inf, fits.rms)
        missed /= np.maximum(fits.quadratic.slope, np.finfo(float).tiny)
        each = fits.quadratic.chosen(adjacent.which).about(*adjacent.at)
        means = [
            np.bincount(adjacent.place, value * adjacent.share, adjacent.count).astype(float)
            for value in (*vars(each).values(), missed[adjacent.which])
        ]
        return Quadratic(*means[:-1]), means[-1]

    def edge_points(self, i: Indices, j: Indices) -> tuple[Quadratic, Mask]:
        """phi about the points of the edge nearest to cells (n,), and whether to believe it.

        By steps down the slope, with a fit about every place; f is zero up to rounding.
        """
        return self.points_near(i.astype(float), j.astype(float))

    def points_near(self, x: Field, y: Field) -> tuple[Quadratic, Mask]:
        """The same nearest to places (n,) not far from it."""
        at_x, at_y = x, y
        for _ in range(REFITS):
            here, safe = self.about(at_x, at_y)
            at_x, at_y = _downhill(here)
        on_it = here.about(at_x, at_y)
        for _ in range(REFITS):
            on_it = here.about(*_downhill(on_it))
        return on_it, safe & (np.hypot(on_it.x - x, on_it.y - y) < FARTHEST)


class AdjacentCells:
    """Cells of a region whose fits describe phi about other cells.

    A cell of the region has its own fit. A cell outside has the mean of the fits about the cells of
    the region that touch it at a side, else at a corner: the edge of a mirrored contact is the
    mirrored edge.

    fitted  (2, m) the cells that are fitted
    which   number of the fit of every pair of a cell and a fit
    place   number of the cell of every pair
    at      coordinates of the cell of every pair, along x and y
    share   weight of the fit of every pair
    count   number of the cells
    """

    def __init__(self, depth: Field, i: Indices, j: Indices) -> None:
        """depth  of the region, see `depth_of`; i, j  cells of the region or next to it (n,)"""
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


def _downhill(here: Quadratic) -> tuple[Field, Field]:
    """Places where the linear part of phi vanishes, at most a cell away."""
    squared = np.maximum(here.slope**2, np.finfo(float).tiny)
    step = here.f / squared
    step = step * np.minimum(1.0, LONGEST_STEP / np.maximum(np.abs(step) * here.slope, 1e-30))
    return here.x - step * here.f_x, here.y - step * here.f_y


def believed(fits: Fits) -> Mask:
    """Whether there is enough data, and it is near the fit."""
    few = fits.count < LEAST_DATA
    return np.asarray(~few & (fits.rms < LARGEST_RMS * fits.quadratic.slope))


def edge_shape(
    means: Field,
    region: Mask,
    stencil: Stencil,
    *,
    rings: int = 1,
    exponent: Exponent = 0.5,
    trusted: Mask | None = None,
    rounds: int = 3,
    depth: Field | None = None,
    domain: ReducedDomain = WINDOW,
    before: tuple[Field, Quadratic] | None = None,
) -> EdgeShape:
    """Shape of the edge of a region.

    means     (nx, ny) cell means of p, positive in the region
    region    (nx, ny) cells with a fit of their own; about others it is that of their nearest
    stencil   `NARROW` with one ring dropped; `WIDE` with two
    rings     outermost layers of cells that are no data, by distance to the nearest cell outside:
              1 where the means are exact or corrected (the cut cells), 2 where they are those of a
              solver that knows no edge (they carry its error), 0 for all, cut ones at a fifth
    exponent  alpha of p ~ s^alpha, s the distance from the edge; may vary slowly, (nx, ny)
    trusted   (nx, ny) cells of the region that may be data; None for all
    rounds    data of the first are means^(1/alpha), from cells beyond the cut ones; of the others
              `centre_value` with the slope of the last
    depth     of the region, where it is known: see `depth_of`
    before    `phi` of nearly the same means, and the fits to it along the edge, whose slopes are
              taken: no round of fits is needed
    domain      that all are given on
    Raises ValueError where no cell is left to be data.
    """
    means = np.where(region, means, 0.0)
    depth = depth_of(region, domain) if depth is None else depth
    usable = region if trusted is None else region & trusted
    data = usable & (depth >= rings + 0.5)
    inner = usable & (depth >= max(rings, 1) + 0.5)
    if not np.any(inner):
        raise ValueError(
            f"the region is {np.max(depth):.3g} cells deep, {rings} rings are dropped: no cell is "
            "left to fit its edge to; take smaller cells"
        )
    band = data & (depth < ASKED + 1.5 * stencil.reach)
    of_band = exponent[band] if isinstance(exponent, np.ndarray) else exponent
    phi, weight = power(means, np.divide(1, exponent)), inner.astype(float)
    # Farther in the differences of data tell the slope, which hardly matters there.
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
    """Distance of every cell of a region from the nearest outside (nx, ny), beyond the window too;
    zero outside."""
    frame = [(int(not mirrored), 1) for mirrored in domain.mirrors]
    depth = distance_transform_edt(np.pad(region, frame))
    return np.asarray(depth[frame[0][0] : -1, frame[1][0] : -1])
