"""The cells along the edge of a region, and the traction in their parts."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.band import Band
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.fit import Indices
from semi_analytical.edge.fitted import Fitted, film_fitted, first_fitted, fitted_again
from semi_analytical.edge.means import Exponent
from semi_analytical.edge.parts import by_differences, means_of_power
from semi_analytical.part import WHOLE, Part

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Radius of a region in cells that is thick enough to be fitted.
THICK = 1.9
# By so much of a cell the edge must have passed the centre of one for it to change sides: those
# that go to and fro would keep rounds from settling, and take new fits.
PASSED = 0.01


@dataclass(frozen=True)
class AlongEdge:
    """What is kept of a rim.

    i, j, parts, part  see `Rim`
    """

    i: Indices
    j: Indices
    parts: Field
    part: Part


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

    @cached_property
    def outer(self) -> Mask:
        """(nx, ny) cells that the region reaches into, and whose centre is outside."""
        return (self.means > 0) & ~self.region

    @cached_property
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
        return AlongEdge(self.i, self.j, self.parts, self.part)


def rim(
    means: Field,
    loaded: Mask,
    before: Rim | None = None,
    exponent: Exponent = 0.5,
    part: Part = WHOLE,
    film: FilmLaw | None = None,
    *,
    on_cells: bool = False,
    anew: bool = False,
) -> Rim | None:
    """The rim of a region of tractions; None where it is too thin to have one.

    means     (nx, ny) mean of the traction over each cell [force/length^2]
    loaded    (nx, ny) cells where it is positive
    before    the rim of about the same region: cells outside it are no data, but what comes of it
    exponent  the traction goes with this power of the distance from the edge
    part      of the window that all are given on
    film      instead of the power ½: the law of a pressure on layered bodies
    on_cells  whether the means are those of a pressure that is constant on cells, not yet corrected
    anew      whether to find slopes within the cells by fits to the others first, not in the rim
              before: dearer, and where pressure and shear move the edge together that settles
    """
    fitted = _fitted(means, loaded, before, exponent, part, film, on_cells=on_cells, anew=anew)
    if fitted is None:
        return None
    (i, j), phi, safe = fitted.band.fitted, fitted.about, fitted.safe
    deep = by_differences(means, fitted.band, part)
    unsafe = np.count_nonzero(~safe) / (len(safe) + len(deep))
    i, j, phi = i[safe], j[safe], phi.chosen(safe)
    parts = means_of_power(phi, exponent[i, j] if isinstance(exponent, np.ndarray) else exponent)
    if fitted.film is not None:
        parts *= fitted.film.parts_over_root(phi)
    parts *= np.max(means)
    inside = fitted.band.region.copy()
    was = np.zeros(len(i)) if before is None else np.where(before.region[i, j], 1.0, -1.0)
    inside[i, j] = phi.f > -PASSED * was * phi.slope
    deep_i, deep_j = fitted.band.deep
    return Rim(
        region=inside,
        i=np.concatenate([i, deep_i]),
        j=np.concatenate([j, deep_j]),
        parts=np.concatenate([parts, deep]),
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
    on_cells: bool = False,
    anew: bool = False,
) -> Fitted | None:
    """phi in the cells along the edge; see `rim`."""
    last = before.fitted if before else None
    region = loaded if before is None else loaded & ~before.outer
    same = last is not None and np.array_equal(region, last.band.region)
    band = last.band if last and same else Band.of(region, part)
    if np.max(band.depth) <= THICK:
        return None
    scaled = means / np.max(means)
    if film is not None:
        return film_fitted(scaled, band, last, film, part)
    if last is None or anew:
        return first_fitted(scaled, band, exponent, part, on_cells=on_cells)
    return fitted_again(scaled, band, last, exponent, part)
