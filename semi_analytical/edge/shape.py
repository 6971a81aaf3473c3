"""Shape of φ = p^(1/α) near the edge of a region, from fits to the cell means of p.

The region is a contact area with the pressure p, or a stick zone with the shear deficit p. Near the
edge p ~ s^α at the distance s from the edge, so that φ passes smoothly through zero. The edge
correction computes subcell tractions from these fits.
"""

from dataclasses import dataclass

import numpy as np

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
# Largest depth that is distinguished, in cells. Fits use shallower cells.
DEEP = 13
# Largest step towards the edge, and largest distance of the edge point, in cells.
LONGEST_STEP = 1.0
FARTHEST = 2.0
REFITS = 3
# Offsets to the cell itself, to side neighbours and to corner neighbours (2, 9, 1).
STEPS = np.array([[0, 1, -1, 0, 0, 1, 1, -1, -1], [0, 0, 0, 1, -1, 1, -1, 1, -1]])[..., None]
SIDES = 4
# Offsets to the cells at most AROUND cells away, the nearest first (2, 1, number).
AROUND = 8
OFFSETS = np.mgrid[-AROUND : AROUND + 1, -AROUND : AROUND + 1].reshape(2, 1, -1)
OFFSETS = OFFSETS[..., np.sum(OFFSETS[:, 0] ** 2, axis=0) <= AROUND**2]
OFFSETS = OFFSETS[..., np.lexsort((*OFFSETS[:, 0], np.sum(OFFSETS[:, 0] ** 2, axis=0)))]


@dataclass(frozen=True)
class EdgeShape:
    """Cell means of φ = p^(1/α) in a region, and fits to these means near the edge of the region.

    p is the pressure of a contact area or the shear deficit of a stick zone, and p ~ s^α at the
    distance s from the edge. φ is smooth and vanishes at the edge.

    means     cell means of p (nx, ny)
    phi       cell means of φ (nx, ny); valid in cells of positive weight
    weight    weights of the cells in fits (nx, ny)
    exponent  exponent α, a number or (nx, ny)
    stencil   window and weights of the fits
    depth     distance of each cell from the nearest cell outside the region (nx, ny), in cells, at
              most DEEP; zero outside
    domain    domain of all fields: full window or reduced domain
    """

    means: Field
    phi: Field
    weight: Field
    exponent: Exponent
    stencil: Stencil
    depth: Field
    domain: ReducedDomain = WINDOW

    def fits(self, i: Indices, j: Indices) -> Fits:
        """Fit quadratics to the cell means of φ = p^(1/α) about cells of the region.

        i, j  indices of the central cells of the fits (n,)
        """
        return fit_about(self.phi, self.weight, i, j, self.stencil, domain=self.domain)

    def nearest_to(self, x: Field, y: Field) -> Indices:
        """Return the cells (2, n) of the region that are nearest to given points.

        If all cells of the region are more than AROUND cells away, the cell at the point itself is
        returned.

        x, y  points as cell indices, not necessarily whole numbers (n,)
        """
        last = np.array(self.means.shape) - 1
        i, j = (np.clip(np.rint(at), 0, n).astype(int) for at, n in zip((x, y), last, strict=True))
        cells, inside = np.stack([i, j]), np.pad(self.depth > 0, AROUND)
        outside = self.depth[i, j] == 0
        around = cells[:, outside, None] + OFFSETS
        found = np.argmax(inside[tuple(around + AROUND)], axis=1)
        cells[:, outside] = np.take_along_axis(around, found[None, :, None], axis=2)[..., 0]
        return cells

    def about(self, x: Field, y: Field) -> tuple[Quadratic, Mask]:
        """Compute the expansion of φ = p^(1/α) about points near the edge, by local fits.

        A point outside the region uses the fit about the nearest cell of the region, because a fit
        centred outside has data on one side only and a hundredfold error.

        x, y     points as cell indices (n,)
        returns  quadratics of φ expanded about the points, and a mask that is True for reliable
                 fits (n,)
        """
        fits = self.fits(*self.nearest_to(x, y))
        return fits.quadratic.about(x, y), reliable(fits)

    def about_cells(self, adjacent: "AdjacentCells", fits: Fits) -> tuple[Quadratic, Field]:
        """Compute the expansion of φ = p^(1/α) about n cells in the region or next to its edge.

        The second result (n,) is the rms residual of the fits over the change of φ across a cell.
        This ratio is infinite for fits with few data.

        adjacent  the n cells, and the assignment of fits to them
        fits      quadratics fitted about the cells `adjacent.fitted`
        """
        error = np.where(fits.count < LEAST_DATA, np.inf, fits.rms)
        error /= np.maximum(fits.quadratic.slope, np.finfo(float).tiny)
        each = fits.quadratic.chosen(adjacent.which).about(*adjacent.at)
        values = np.stack([*vars(each).values(), error[adjacent.which]])
        rows = adjacent.count * np.arange(len(values))[:, None]
        sums = np.bincount((rows + adjacent.place).ravel(), (values * adjacent.share).ravel())
        *means, error = sums.astype(float).reshape(len(values), adjacent.count)
        return Quadratic(*means), error

    def edge_points(self, x: Field | Indices, y: Field | Indices) -> tuple[Quadratic, Mask]:
        """Find the edge points nearest to n given points, and fit φ = p^(1/α) about them.

        Newton steps along the gradient of φ find the edge points, with new fits in the first REFITS
        steps. The second result is a mask, True for reliable fits at edge points less than FARTHEST
        cells away. Used to compute stresses at the contact edge.

        x, y  given points as cell indices (n,)
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
    """Assignment of local fits of φ to cells in or next to a region, as pairs of cell and fit.

    φ is a function of the traction that vanishes at the edge of the region. A cell of the region
    uses the fit about itself. A cell outside uses the mean of the fits about its side neighbours in
    the region, or without side neighbours about its corner neighbours. This rule preserves mirror
    symmetry.

    fitted  indices of the cells about which fits are needed (2, m)
    which   index of the fit of each pair
    place   index of the cell of each pair
    at      coordinates of the cell of each pair, along x and y
    share   weight of the fit of each pair
    count   number of cells
    """

    def __init__(self, depth: Field, i: Indices, j: Indices) -> None:
        """Find the fits that determine φ in given cells in a region or next to its edge.

        depth  distance of each cell from the nearest cell outside the region, in cells (nx, ny)
        i, j   indices of the given cells (n,)
        """
        region = WINDOW.add_frame(depth > 0, 1)
        across = region.shape[1]
        number = (i + 1) * across + j + 1 + (across * STEPS[0] + STEPS[1])
        inside = region.take(number)
        inside[1:, inside[0]] = False
        inside[1 + SIDES :, np.any(inside[: 1 + SIDES], axis=0)] = False
        step, self.place = np.nonzero(inside)
        cells, self.which = np.unique(number[step, self.place], return_inverse=True)
        self.fitted = cells // across - 1, cells % across - 1
        self.at = i[self.place].astype(float), j[self.place].astype(float)
        self.share = 1 / np.sum(inside, axis=0)[self.place]
        self.count = len(i)


def _step_to_edge(here: Quadratic) -> tuple[Field, Field]:
    """Move points towards φ = 0 along its gradient by one Newton step of at most a cell:
    new x and y."""
    squared = np.maximum(here.slope**2, np.finfo(float).tiny)
    step = here.f / squared
    step = step * np.minimum(1.0, LONGEST_STEP / np.maximum(np.abs(step) * here.slope, 1e-30))
    return here.x - step * here.f_x, here.y - step * here.f_y


def reliable(fits: Fits) -> Mask:
    """Return a mask (n,) that is True for reliable fits of φ near the edge of a region.

    A reliable fit has at least LEAST_DATA data, and its rms residual is less than LARGEST_RMS of
    the change of φ across a cell.

    fits  fits of φ about n cells
    """
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

    p is the pressure in a contact area or the shear deficit in a stick zone. Cells that the edge
    cuts use the slopes of preceding fits, because there φ is not a power of the mean.

    means     cell means of p, positive in the region (nx, ny)
    region    cells of the region (nx, ny)
    stencil   stencil of the fits: `NARROW` for one ring, `WIDE` for two
    rings     number of outermost layers of cells that are not data: 1 for exact or corrected means,
              2 for means of a solver without edge correction; with 0 all cells are data, cut cells
              with CUT_WEIGHT
    exponent  α in p ~ s^α, s the distance from the edge; a number or a smooth field (nx, ny)
    rounds    number of computations of φ: the first is means^(1/α) without cut cells; the others
              use `centre_value` with the slopes of the preceding fits
    depth     distance of each cell from the nearest cell outside the region, in cells; computed if
              None
    domain    domain of all fields: full window or reduced domain
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
    weight = inner.astype(float)
    if before is None:
        phi, near = power(means, np.divide(1, exponent)), None
        # Deeper cells use differences of φ as slopes, because φ hardly depends on them there.
        i, j = np.nonzero(band & (depth < max(rings, 1) + 2))
    else:
        phi, fit = before
        near, rounds = phi[band], 2
        i, j = fit.x.astype(int), fit.y.astype(int)
    for _ in range(rounds - 1):
        if before is None:
            fit = fit_about(phi, weight, i, j, stencil, domain=domain).quadratic
        slopes = domain.differences(phi)
        slopes[:, i, j] = fit.f_x, fit.f_y
        phi = phi.copy()
        phi[band] = centre_value(means[band], slopes[0][band], slopes[1][band], of_band, near)
        weight = data.astype(float)
        weight[i, j] *= np.where(fit.cut, CUT_WEIGHT, 1.0)
    return EdgeShape(means, phi, weight, exponent, stencil, depth, domain)


def depth_of(region: Mask, domain: ReducedDomain = WINDOW) -> Field:
    """Compute the distance of each cell of a region from the nearest cell outside the region.

    The distance (nx, ny) is in cells, between cell centres, at most DEEP, and zero outside the
    region. Cells beyond the window count as outside.

    region  cells of the region (nx, ny)
    domain  domain of `region`: full window or reduced domain
    """
    return distance_to(~domain.add_frame(region, 1))[1:-1, 1:-1]


def distance_to(cells: Mask) -> Field:
    """Compute the distance of each cell from the nearest cell of a set, between cell centres.

    The distance (nx, ny) is in cells. Larger distances than DEEP are replaced by DEEP.

    cells  cells of the set (nx, ny)
    """
    squared = np.where(cells, 0, DEEP**2).astype(np.int16)
    for _ in range(2):  # along x, then along y
        nearest = squared.copy()
        for k in range(1, DEEP):
            np.minimum(nearest[k:], squared[:-k] + k**2, out=nearest[k:])
            np.minimum(nearest[:-k], squared[k:] + k**2, out=nearest[:-k])
        squared = nearest.T.copy()
    return np.sqrt(squared, dtype=float)


def inscribed_radius(region: Mask, domain: ReducedDomain) -> float:
    """Compute the radius of the largest circle inside a region, in cells.

    The radius is the largest distance of a cell from the nearest cell outside.

    region  cells of the region (nx, ny)
    domain  domain of `region`: full window or reduced domain
    """
    from scipy.ndimage import distance_transform_edt  # the import takes as long as a contact

    return float(np.max(distance_transform_edt(domain.add_frame(region, 1))))
