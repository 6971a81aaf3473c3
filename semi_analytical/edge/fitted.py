"""phi about the cells along an edge."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.band import Band
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.film_shape import FilmShape, film_shape
from semi_analytical.edge.fit import WIDE, WIDER, Fits, Stencil, Windows
from semi_analytical.edge.means import Exponent, centre_value
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import CUT_WEIGHT, EdgeShape, believed, edge_shape
from semi_analytical.part import Part

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Wider than for exact means: what is left of the error of one cell is to leave the others alone.
STENCIL = Stencil(4, 2.2)
# Layers of cells in the windows about all that are fitted, and one more that they lose or win.
DATA = 10.5
# On films still wider: next to a plateau of the pressure narrow fits lead edges that waver.
OF_FILM = WIDER
# Pressures that are constant on cells are wrong in the two outermost layers, and told by the others
# end by so much of a cell too far out: the mean over all places and directions of edges in cells,
# to a tenth. Smaller regions have too few other layers.
OF_CELLS, WRONG_LAYERS, TOO_FAR, DEEP_ENOUGH = WIDE, 2, 0.032, 8.0
# Largest rms of such fits, in the fall of phi over a cell: where it is quadratic they leave 1e-3 of
# that, and ten times as much below cones and on films, whose edges they would miss.
CLOSE = 3e-3


@dataclass(frozen=True)
class Fitted:
    """What was fitted where.

    about    phi about the fitted cells of the band
    safe     whether to believe it
    phi      (nx, ny) its means over cells that it was fitted to
    slopes   (2, nx, ny) per cell
    cut      (nx, ny) cells that the edge cuts
    windows  of fits that may be made again; None of others
    film     with the law of a film the shape of the edge
    """

    band: Band
    about: Quadratic
    safe: Mask
    phi: Field
    slopes: Field
    cut: Mask
    windows: Windows | None = None
    film: FilmShape | None = None

    def area(self, part: Part) -> float:
        """Of the region and its images, in cells."""
        covered = self.band.region.astype(float)
        i, j = (at[self.safe] for at in self.band.fitted)
        covered[i, j] = self.about.chosen(self.safe).cell_mean(0.0)
        return part.images * float(np.sum(covered))


def first_fitted(
    means: Field, band: Band, exponent: Exponent, part: Part, *, on_cells: bool
) -> Fitted:
    """Where nothing is known yet; see `rim.rim`."""
    if on_cells and np.max(band.depth) >= DEEP_ENOUGH:
        shape = _shape(means, band, exponent, part, OF_CELLS, WRONG_LAYERS)
        fits = shape.fits(*band.inner)
        # Beside a region that is deep enough there may be one that is not.
        if np.all(believed(fits, CLOSE)):
            return _of(shape.phi, fits, band, part, TOO_FAR)
    shape = _shape(means, band, exponent, part, STENCIL, rings=0)
    return _of(shape.phi, shape.fits(*band.inner), band, part)


def _shape(
    means: Field, band: Band, exponent: Exponent, part: Part, stencil: Stencil, rings: int
) -> EdgeShape:
    return edge_shape(
        means,
        band.region,
        stencil,
        rings=rings,
        exponent=exponent,
        rounds=2,
        depth=band.depth,
        part=part,
    )


def fitted_again(
    means: Field, band: Band, before: Fitted, exponent: Exponent, part: Part
) -> Fitted:
    """Of about the same means and region: slopes within its cells are those before."""
    data = band.region & (band.depth < DATA)
    (f_x, f_y), near = before.slopes[:, data], before.phi[data]
    a = exponent[data] if isinstance(exponent, np.ndarray) else exponent
    phi = np.zeros_like(means)
    phi[data] = centre_value(means[data], f_x, f_y, a, near)
    windows = before.windows if band is before.band else None
    if windows is None:
        weight = np.where(before.cut, CUT_WEIGHT, 1.0) * band.region
        windows = Windows.about(weight, *band.inner, STENCIL, part=part)
    found = _of(phi, windows.fits(phi), band, part)
    # Told once: cells that are cut and then not would keep the rounds from settling.
    cut = before.cut if band is before.band else found.cut
    return replace(found, cut=cut, windows=windows)


def film_fitted(
    means: Field, band: Band, before: Fitted | None, law: FilmLaw, part: Part
) -> Fitted:
    """With the law of a film."""
    known = before.film if before else None
    line = known.line if known else None
    shape = film_shape(means, band.region, OF_FILM, law, band.depth, part, line)
    return replace(_of(shape.phi, shape.fits(*band.inner), band, part), film=shape)


def _of(phi: Field, fits: Fits, band: Band, part: Part, too_far: float = 0.0) -> Fitted:
    """The edge of fits to phi, which is so much of a cell too far out."""
    about, safe = band.touching.joined(fits, believed(fits))
    if too_far:
        about = replace(about, f=about.f - too_far * about.slope)
    slopes, cut = part.differences(phi), np.zeros(phi.shape, dtype=bool)
    at = band.fitted
    slopes[:, at[0], at[1]] = about.f_x, about.f_y
    cut[at] = about.cut
    return Fitted(band, about, safe, phi, slopes, cut)
