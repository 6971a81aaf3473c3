"""Shape of the edge of a contact of layered bodies: `shape` with the law of `film`.

Over what the law has over the root cell means are those of a root, and fitted like those. But that
ratio is told by the distance from the edge: as the edge moves, so does what is fitted. Fits at the
edge know that (Newton's method), and a few of them after one another find both.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import (
    Exponent,
    centre_value,
    power,
)
from semi_analytical.edge.edge_geometry import (
    EdgeLine,
    Seen,
)
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.fit import Fits, Stencil, fit_about
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import ASKED, CUT_WEIGHT, EdgeShape
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Layers of cells along the edge.
ALONG = 1.5
TURNS, TURNS_AGAIN = 5, 2
# Of how far data lean on the edge: where the pressure has its first plateau they would hardly tell
# where that is, and Newton's method overshoots.
MAX_LEANING = -0.7
# Of the curvature c of the law, over that of the largest circle inside: what no smooth edge has.
MAX_BENT = 4.0
# A part of a cell so many times its width inside the edge sees the law change but little.
FAR = 5.0


@dataclass(frozen=True, kw_only=True)
class FilmShape(EdgeShape):
    """Of a layered contact.

    leaning  (nx, ny) derivative of `phi` with respect to that at the edge
    line     the edge that `phi` was made with
    law      of the pressure
    """

    leaning: Field
    line: EdgeLine
    law: FilmLaw

    def fits(self, i: Indices, j: Indices) -> Fits:
        """Fits about cells of the region, shape (n,), to phi(x) + leaning phi(edge)."""
        foot = self.line.seen_from(i, j).foot / np.array(self.line.stretched)[:, None]
        return fit_about(
            self.phi,
            self.weight,
            i,
            j,
            self.stencil,
            domain=self.domain,
            leaning=(self.leaning, foot),
        )

    def parts_over_root(self, phi: Quadratic) -> Field:
        """The means of the law over those of the root in the parts of cells (n, PARTS, PARTS).

        phi  about the cells
        """
        x, law = part_centres(), self.law
        at_x = phi.x[:, None] + np.repeat(x, PARTS)
        at_y = phi.y[:, None] + np.tile(x, PARTS)
        own = EdgeLine.of(phi, law.stretched)
        seen = own.seen_by(np.arange(len(phi.f))[:, None], at_x, at_y)
        of_cells = self.line.seen_from(np.rint(phi.x).astype(int), np.rint(phi.y).astype(int))
        c = np.broadcast_to(bent(of_cells, self.depth, law)[:, None], at_x.shape)
        sides = np.array(law.stretched)[:, None, None] / PARTS * seen.normal
        s, width = seen.distance, np.sum(np.abs(sides), axis=0)
        ratio = np.ones(s.shape)
        near, far = np.abs(s) <= FAR * width, s > FAR * width
        ratio[far] = law.over_root(s[far], c[far])
        ratio[near] = law.means_over_root(s[near], sides[0][near], sides[1][near], c[near])[0]
        return ratio.reshape(-1, PARTS, PARTS)


def film_shape(
    means: Field,
    region: Mask,
    stencil: Stencil,
    law: FilmLaw,
    depth: Field,
    domain: ReducedDomain = WINDOW,
    exponent: Exponent = 0.5,
    before: EdgeLine | None = None,
) -> FilmShape:
    """Shape of the edge of a region.

    means     (nx, ny) cell means of p, positive in the region
    depth     of the region, see `shape.depth_of`
    domain      that all are given on
    exponent  alpha: p is the ratio of the law to the root of the distance, times phi^alpha
    before    edge of about the same region
    """
    problem = _Problem(np.where(region, means, 0.0), region, stencil, law, depth, domain, exponent)
    along = np.nonzero(region & (depth < ALONG))
    line = problem.first(*along) if before is None else before
    for _ in range(TURNS if before is None else TURNS_AGAIN):
        shape = problem.about(line)
        line = EdgeLine.of(shape.fits(*along).quadratic, law.stretched)
        if before is None:
            line = line.evened()
        line = line.with_images(domain)
    return problem.about(line)


@dataclass(frozen=True)
class _Problem:
    means: Field
    region: Mask
    stencil: Stencil
    law: FilmLaw
    depth: Field
    domain: ReducedDomain
    exponent: Exponent

    @property
    def band(self) -> tuple[Indices, Indices]:
        """Cells whose distance from the edge is told by it."""
        i, j = np.nonzero(self.region & (self.depth < ASKED + 1.5 * self.stencil.reach))
        return i, j

    @property
    def by_depth(self) -> Field:
        """phi of all cells, the distance told by their layer."""
        size = np.sqrt(np.prod(self.law.stretched))
        s = np.maximum(self.depth - 0.5, 0.5) * size
        curved = np.full(s.shape, -9 / 8 / (np.max(self.depth) * size))  # Hertz's
        return power(self.means / self.law.over_root(s, curved), np.divide(1, self.exponent))

    def first(self, i: Indices, j: Indices) -> EdgeLine:
        """A guess, from cells that are not cut."""
        inner = (self.region & (self.depth >= ALONG)).astype(float)
        fits = fit_about(self.by_depth, inner, i, j, self.stencil, domain=self.domain)
        return EdgeLine.of(fits.quadratic, self.law.stretched).evened().with_images(self.domain)

    def about(self, line: EdgeLine) -> FilmShape:
        """With distances from a line."""
        phi, weight = self.by_depth, self.region.astype(float)
        leaning = np.zeros_like(phi)
        i, j = self.band
        seen = line.seen_from(i, j)
        along_x, along_y = np.array(self.law.stretched)[:, None] * seen.normal
        c = bent(seen, self.depth, self.law)
        ratio, leans = self.law.means_over_root(seen.distance, along_x, along_y, c)
        slope, a = seen.slope_here, self.exponent
        of_band = a[i, j] if isinstance(a, np.ndarray) else a
        means = self.means[i, j] / ratio
        phi[i, j] = centre_value(means, slope * along_x, slope * along_y, of_band)
        leaning[i, j] = np.maximum(leans, MAX_LEANING) * slope / seen.slope
        cut = np.abs(seen.distance) < (np.abs(along_x) + np.abs(along_y)) / 2
        weight[i, j] = np.where(cut, CUT_WEIGHT, 1.0)
        return FilmShape(
            means=self.means,
            phi=phi,
            weight=weight,
            exponent=a,
            stencil=self.stencil,
            depth=self.depth,
            domain=self.domain,
            leaning=leaning,
            line=line,
            law=self.law,
        )


def bent(seen: Seen, depth: Field, law: FilmLaw) -> Field:
    """c of the law: of φ = g s (1 + b s) along an edge of curvature κ it is ¾ (b - κ).

    depth  layers of the region (nx, ny)
    """
    limit = MAX_BENT / (np.max(depth) * min(law.stretched))
    return np.clip(0.75 * (seen.bend / (2 * seen.slope) - seen.curvature), -limit, limit)
