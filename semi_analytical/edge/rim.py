"""The cells along the edge of a region, and the traction in their parts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.film_shape import FilmShape, film_shape
from semi_analytical.edge.fit import WIDER, Indices, Stencil
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.means import Exponent, mean_of_smooth, mean_power
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import EdgeShape, Former, Mask, depth_of, edge_shape
from semi_analytical.part import WHOLE, Part

Field = NDArray[np.float64]

# Wider than for exact means: what is left of the error of one cell is to leave the others alone.
STENCIL = Stencil(4, 2.2)
# On films still wider: next to a plateau of the pressure narrow fits lead edges that waver.
OF_FILM = WIDER
# Layers of cells inside and outside the edge. Farther in a traction is a slope within a cell, to
# 1/500 of it; farther out it is zero.
INSIDE, OUTSIDE = 5.5, 1.5
# Layers up to which it is what the fit says; farther in second differences tell as much. They fade
# out, as an end of them would show in the pressure of the next cells.
FITTED = 2.5
# So many times its slopes above zero, a part of a cell has the mean of a power by its series.
SMOOTH = 1.5
# Cells whose parts are found at a time: as many as stay in the cache.
CHUNK = 512
X, Y = (at.ravel() for at in np.meshgrid(part_centres(), part_centres(), indexing="ij"))
MONOMIALS = np.stack([X**0, X, Y, X**2 / 2, X * Y, Y**2 / 2])
# Mean of X²/2 over the parts of a cell.
HALF_SQUARE = np.mean(X**2) / 2
# Radius of a region in cells that is thick enough to be fitted.
THICK = 1.9


class Band(NamedTuple):
    """Cells along the edge of a region (nx, ny), by their distance from the nearest outside.

    depth   (nx, ny) that distance
    fitted  cells (i, j) inside and outside that are fitted
    deep    those farther in, and how much of their second differences they have
    """

    region: Mask
    depth: Field
    fitted: tuple[Indices, Indices]
    deep: tuple[Indices, Indices]
    fade: Field


class Fitted(NamedTuple):
    """What was fitted where: phi about the fitted cells of the band, whether to believe it, and
    what the next fit of about the same region starts from; with the law of a film its shape."""

    band: Band
    about: Quadratic
    safe: Mask
    former: Former
    film: FilmShape | None = None

    def area(self, part: Part) -> float:
        """Of the region and its images, in cells."""
        covered = self.band.region.astype(float)
        i, j = (at[self.safe] for at in self.band.fitted)
        covered[i, j] = self.about.chosen(self.safe).cell_mean(0.0)
        return part.images * float(np.sum(covered))


@dataclass(frozen=True)
class AlongEdge:
    """What is kept of a rim.

    i, j, parts, part, area  see `Rim`
    """

    i: Indices
    j: Indices
    parts: Field
    part: Part
    area: float


@dataclass(frozen=True)
class Rim:
    """Cells along the edge of a region that are fitted well.

    region   (nx, ny) cells whose centre is inside the edge
    i, j     the cells (n,)
    parts    (n, PARTS, PARTS) mean of the traction in the parts of each
    unsafe   part of all cells along the edge that are not fitted well
    part     of the window that all are on
    fitted   what it was made of
    """

    region: Mask
    i: Indices
    j: Indices
    parts: Field
    unsafe: float
    part: Part
    fitted: Fitted

    @property
    def outer(self) -> Mask:
        """(nx, ny) cells that the region reaches into, and whose centre is outside."""
        reached = np.zeros(self.region.shape, dtype=bool)
        reached[self.i, self.j] = np.any(self.parts > 0, axis=(1, 2))
        return reached & ~self.region

    @property
    def means(self) -> Field:
        """(nx, ny) mean of the traction over each of the cells, zero elsewhere."""
        means = np.zeros(self.region.shape)
        means[self.i, self.j] = self.parts.mean(axis=(1, 2))
        return means

    @property
    def area(self) -> float:
        """Of the region and its images, in cells."""
        return self.fitted.area(self.part)

    @property
    def kept(self) -> AlongEdge:
        """Without what only the next fit needs."""
        return AlongEdge(self.i, self.j, self.parts, self.part, self.area)


def rim(
    means: Field,
    loaded: Mask,
    before: Rim | None = None,
    exponent: Exponent = 0.5,
    part: Part = WHOLE,
    film: FilmLaw | None = None,
    *,
    anew: bool = False,
) -> Rim | None:
    """The rim of a region of tractions; None where it is too thin to have one.

    means     (nx, ny) mean of the traction over each cell [force/length^2]
    loaded    (nx, ny) cells where it is positive
    before    the rim of about the same region: cells outside it are no data, but what comes of it
    exponent  the traction goes with this power of the distance from the edge
    part      of the window that all are given on
    film      instead of the power ½: the law of a pressure on layered bodies
    anew      whether to find slopes within the cells by fits to the others first, not in the rim
              before: dearer, and where pressure and shear move the edge together that settles
    """
    fitted = _fitted(means, loaded, before, exponent, part, film, anew=anew)
    if fitted is None:
        return None
    (i, j), phi, safe = fitted.band.fitted, fitted.about, fitted.safe
    deep = _by_differences(means, fitted.band, part)
    unsafe = np.count_nonzero(~safe) / (len(safe) + len(deep))
    i, j, phi = i[safe], j[safe], phi.chosen(safe)
    parts = _in_parts(phi, exponent[i, j] if isinstance(exponent, np.ndarray) else exponent)
    if fitted.film is not None:
        parts *= fitted.film.parts_over_root(phi)
    inside = fitted.band.region.copy()
    inside[i, j] = phi.f > 0
    deep_i, deep_j = fitted.band.deep
    return Rim(
        region=inside,
        i=np.concatenate([i, deep_i]),
        j=np.concatenate([j, deep_j]),
        parts=np.concatenate([np.max(means) * parts, deep]),
        unsafe=unsafe,
        part=part,
        fitted=fitted,
    )


def area_within(means: Field, edge: Rim, exponent: Exponent = 0.5) -> float:
    """Area in cells of a region that a rim is about, when its tractions are these means (nx, ny):
    all around it, in the whole window."""
    shape = edge.fitted.film
    law = None if shape is None else shape.law
    fitted = _fitted(means, means > 0, edge, exponent, edge.part, law)
    return edge.area if fitted is None else fitted.area(edge.part)


def _fitted(
    means: Field,
    loaded: Mask,
    before: Rim | None,
    exponent: Exponent,
    part: Part,
    film: FilmLaw | None,
    *,
    anew: bool = False,
) -> Fitted | None:
    """phi in the cells along the edge; see `rim`."""
    region = loaded if before is None else loaded & ~before.outer
    same = before is not None and np.array_equal(region, before.fitted.band.region)
    band = before.fitted.band if before and same else _band(region, part)
    if np.max(band.depth) <= THICK:
        return None
    known = None if anew else before
    shape, on_film = _shape(means / np.max(means), band, known, exponent, part, film)
    i, j = band.fitted
    phi, safe = shape.about_cells(i, j)
    # Told once: cells that are cut and then not would keep the rounds from settling.
    cut = before.fitted.former.cut if before and same else _marked(region.shape, i, j, phi.cut)
    slopes = part.differences(shape.phi)
    slopes[:, i, j] = phi.f_x, phi.f_y
    return Fitted(band, phi, safe, Former(slopes, cut), on_film)


def _shape(
    means: Field,
    band: Band,
    before: Rim | None,
    exponent: Exponent,
    part: Part,
    film: FilmLaw | None,
) -> tuple[EdgeShape, FilmShape | None]:
    """Shape of the edge, and again where it is that on a film."""
    if film is not None:
        known = before.fitted.film if before else None
        line = known.line if known else None
        shape = film_shape(means, band.region, OF_FILM, film, band.depth, part, line)
        return shape, shape
    of_power = edge_shape(
        means,
        band.region,
        STENCIL,
        rings=0,
        exponent=exponent,
        rounds=2,
        depth=band.depth,
        part=part,
        former=before.fitted.former if before else None,
    )
    return of_power, None


def _band(region: Mask, part: Part) -> Band:
    depth = depth_of(region, part)
    around = part.framed(region, 1)
    along = around[:-2] | around[1:-1] | around[2:]
    touched = along[:, :-2] | along[:, 1:-1] | along[:, 2:]
    i, j = np.nonzero(touched & (depth <= FITTED))
    # Those that the edge cuts first, and then those where no part is cut.
    order = np.argsort(depth[i, j], kind="stable")
    deep_i, deep_j = np.nonzero((depth > FITTED) & (depth <= INSIDE))
    fade = (INSIDE - depth[deep_i, deep_j]) / (INSIDE - FITTED)
    return Band(region, depth, (i[order], j[order]), (deep_i, deep_j), fade)


def _by_differences(means: Field, band: Band, part: Part) -> Field:
    """Parts (n, PARTS, PARTS) of the traction in the deep cells."""
    i, j = (at + 1 for at in band.deep)
    p = part.framed(means, 1)
    centre, fade = p[i, j], band.fade
    lower, upper, left, right = p[i - 1, j], p[i + 1, j], p[i, j - 1], p[i, j + 1]
    corners = p[i + 1, j + 1] + p[i - 1, j - 1] - p[i + 1, j - 1] - p[i - 1, j + 1]
    f_xx, f_yy = fade * (lower + upper - 2 * centre), fade * (left + right - 2 * centre)
    f = centre - HALF_SQUARE * (f_xx + f_yy)
    slopes = (upper - lower) / 2, (right - left) / 2
    factors = np.stack([f, *slopes, f_xx, fade * corners / 4, f_yy], axis=1)
    return (factors @ MONOMIALS).reshape(-1, PARTS, PARTS)


def _marked(cells: tuple[int, ...], i: Indices, j: Indices, which: Mask) -> Mask:
    """Cells (nx, ny) of those that are marked."""
    marked = np.zeros(cells, dtype=bool)
    marked[i, j] = which
    return marked


def _in_parts(phi: Quadratic, exponent: Exponent) -> Field:
    """Mean of phi_+^exponent over the parts of each cell (n, PARTS, PARTS)."""
    parts = np.empty((len(phi.f), PARTS**2))
    for first in range(0, len(parts), CHUNK):
        some = slice(first, first + CHUNK)
        a = exponent[some] if isinstance(exponent, np.ndarray) else exponent
        _some_in_parts(phi.chosen(some), a, parts[some])
    return parts.reshape(-1, PARTS, PARTS)


def _some_in_parts(phi: Quadratic, exponent: Exponent, parts: Field) -> None:
    """The same of some cells, into parts (n, PARTS²)."""
    bent = (phi.f_xx + phi.f_yy) / (24 * PARTS**2)
    factors = np.stack([phi.f + bent, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy], axis=1)
    f = factors @ MONOMIALS
    # Over a part of a cell the slope hardly changes.
    f_x, f_y = phi.f_x[:, None] / PARTS, phi.f_y[:, None] / PARTS
    slope = np.abs(f_x) + np.abs(f_y)
    a = exponent[:, None] if isinstance(exponent, np.ndarray) else exponent
    parts[:] = mean_of_smooth(np.maximum(f, SMOOTH * slope), f_x, f_y, a)
    not_smooth = f < SMOOTH * slope
    if not np.any(not_smooth):
        return
    parts *= f > 0
    cell, part = np.nonzero(not_smooth & (f > -slope / 2))
    of_cut = f[cell, part], f_x[cell, 0], f_y[cell, 0]
    parts[cell, part] = mean_power(*of_cut, a[cell, 0] if isinstance(a, np.ndarray) else a)
