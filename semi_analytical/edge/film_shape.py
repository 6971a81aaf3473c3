"""Fits of φ near the contact edge of layered bodies, with the pressure law of `edge.film`.

φ is a power of the pressure that vanishes smoothly at the edge. Cell means of the pressure are
divided by the ratio of the law to √s and then fitted like those of a root. The ratio depends on the
distance s from the edge, hence on the fit. Newton's method solves for the ratio and the fit: the
fits include the derivative of the data with respect to φ at the edge.
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
    LocalEdge,
)
from semi_analytical.edge.film import FilmLaw
from semi_analytical.edge.fit import Fits, Stencil, fit_about
from semi_analytical.edge.kernels import PARTS, part_centres
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.edge.shape import CUT_WEIGHT, MAX_FIT_DEPTH, EdgeShape, inscribed_radius
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Depth of the cells along the edge, in cells.
ALONG = 1.5
# Newton steps without and with an edge of the previous iteration.
STEPS = 5
STEPS_AGAIN = 2
# Least logarithmic derivative of the ratio. At the first plateau of the pressure on a film the data
# hardly depend on the edge, and Newton's method would overshoot.
MIN_SENSITIVITY = -0.7
# Largest coefficient c of the law, over the curvature of the inscribed circle.
MAX_COEFFICIENT = 4.0
# Distance from the edge over the width of a subcell beyond which the value at its centre is used.
FAR = 5.0


@dataclass(frozen=True, kw_only=True)
class FilmShape(EdgeShape):
    """Cell means of φ in a contact of layered bodies, and fits to them near the contact edge.

    φ is a power of the pressure divided by the ratio of the pressure law to √s, with the distance s
    from the edge. φ vanishes smoothly at the edge.

    sensitivity  derivative of the data `phi` with respect to φ at the nearest edge point (nx, ny)
    line         contact edge from which `phi` was computed
    law          law of the pressure near the edge
    """

    sensitivity: Field
    line: EdgeLine
    law: FilmLaw

    def fits(self, i: Indices, j: Indices) -> Fits:
        """Fit quadratics to the cell means of φ about cells near the contact edge.

        φ vanishes smoothly at the edge. The data depend on the position of the edge. Their model is
        therefore φ at the cell plus `sensitivity` times φ at the nearest edge point.

        i, j  indices of the central cells of the fits (n,)
        """
        foot = self.line.geometry_at_cells(i, j).foot / np.array(self.line.stretched)[:, None]
        return fit_about(
            self.phi,
            self.weight,
            i,
            j,
            self.stencil,
            domain=self.domain,
            sensitivity=(self.sensitivity, foot),
        )

    def parts_over_root(self, phi: Quadratic) -> Field:
        """Compute the ratio of the edge pressure law to √s in each subcell of n cells.

        The result has the shape (n, PARTS, PARTS); s is the distance from the contact edge. Within
        FAR subcell widths of the edge, the ratio is that of the mean of the law over the subcell to
        the mean of √s. Farther inside, it is the ratio at the subcell centre; farther outside, it
        is 1.

        phi  quadratic fits of φ about the cells (n,)
        """
        x, law = part_centres(), self.law
        at_x = phi.x[:, None] + np.repeat(x, PARTS)
        at_y = phi.y[:, None] + np.tile(x, PARTS)
        own = EdgeLine.from_fits(phi, law.stretched)
        local = own.geometry_at_places(np.arange(len(phi.f))[:, None], at_x, at_y)
        of_cells = self.line.geometry_at_cells(
            np.rint(phi.x).astype(int), np.rint(phi.y).astype(int)
        )
        c = np.broadcast_to(_law_coefficient(of_cells, self.depth, law)[:, None], at_x.shape)
        sides = np.array(law.stretched)[:, None, None] / PARTS * local.normal
        s, width = local.distance, np.sum(np.abs(sides), axis=0)
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
    """Determine φ near the contact edge of layered bodies, and the edge itself, by Newton's method.

    φ is a power of the pressure over the ratio of the pressure law to √s, s the distance from the
    edge. The ratio depends on the edge, and the edge is the zero line of φ.

    means     cell means of the pressure, positive in the contact area (nx, ny)
    region    cells of the contact area (nx, ny)
    stencil   window and weights of the fits
    law       law of the pressure near the edge
    depth     distance of each cell from the nearest cell outside the contact area, in cells (nx,
              ny)
    domain    domain of all fields: full window or reduced domain
    exponent  α in p = (ratio of the law to √s) φ^α
    before    edge of the previous iteration; None in the first one
    """
    problem = _Problem(np.where(region, means, 0.0), region, stencil, law, depth, domain, exponent)
    along = np.nonzero(region & (depth < ALONG))
    line = problem.initial_edge(*along) if before is None else before
    for _ in range(STEPS if before is None else STEPS_AGAIN):
        shape = problem.about(line)
        line = EdgeLine.from_fits(shape.fits(*along).quadratic, law.stretched)
        if before is None:  # second derivatives are not yet reliable
            line = line.use_median_curvature()
        line = line.append_images(domain)
    return problem.about(line)


@dataclass(frozen=True)
class _Problem:
    """Data of the fit of φ near the contact edge of layered bodies, fixed during Newton's method.

    φ is a power of the pressure that vanishes smoothly at the contact edge.

    means     cell means of the pressure, zero outside the contact area (nx, ny)
    region    cells of the contact area (nx, ny)
    stencil   window and weights of the fits
    law       law of the pressure near the edge
    depth     distance of each cell from the nearest cell outside the contact area, in cells (nx,
              ny)
    domain    domain of all fields: full window or reduced domain
    exponent  α in p = (ratio of the law to √s) φ^α, s the distance from the edge
    """

    means: Field
    region: Mask
    stencil: Stencil
    law: FilmLaw
    depth: Field
    domain: ReducedDomain
    exponent: Exponent

    def initial_edge(self, i: Indices, j: Indices) -> EdgeLine:
        """Return the initial guess of the contact edge of layered bodies, from fits to inner cells.

        The depth of a cell serves as its distance from the edge. Cells along the edge are not data,
        because their φ depends on the unknown position of the edge.

        i, j  indices of the cells along the edge (n,)
        """
        size = np.sqrt(np.prod(self.law.stretched))
        s = np.maximum(self.depth - 0.5, 0.5) * size
        radius = inscribed_radius(self.region, self.domain) * size
        curved = np.full(s.shape, -9 / 8 / radius)  # Hertz contact
        phi = power(self.means / self.law.over_root(s, curved), np.divide(1, self.exponent))
        inner = (self.region & (self.depth >= ALONG)).astype(float)
        fits = fit_about(phi, inner, i, j, self.stencil, domain=self.domain)
        line = EdgeLine.from_fits(fits.quadratic, self.law.stretched)
        return line.use_median_curvature().append_images(self.domain)

    def about(self, line: EdgeLine) -> FilmShape:
        """Compute the cell means of φ for a given contact edge, and their sensitivity to the edge.

        φ = (pressure over the ratio of the edge law of layered bodies to √s)^(1/α), with the
        distance s from the given edge.

        line  points of the given contact edge
        """
        phi, sensitivity = np.zeros((2, *self.means.shape))
        weight = self.region.astype(float)
        i, j = np.nonzero(self.region & (self.depth < MAX_FIT_DEPTH + 1.5 * self.stencil.reach))
        local = line.geometry_at_cells(i, j)
        along_x, along_y = np.array(self.law.stretched)[:, None] * local.normal
        c = _law_coefficient(local, self.depth, self.law)
        ratio, rate = self.law.means_over_root(local.distance, along_x, along_y, c)
        slope, a = local.slope_at_place, self.exponent
        a_here = a[i, j] if isinstance(a, np.ndarray) else a
        means = self.means[i, j] / ratio
        phi[i, j] = centre_value(means, slope * along_x, slope * along_y, a_here)
        sensitivity[i, j] = np.maximum(rate, MIN_SENSITIVITY) * slope / local.slope
        cut = np.abs(local.distance) < (np.abs(along_x) + np.abs(along_y)) / 2
        weight[i, j] = np.where(cut, CUT_WEIGHT, 1.0)
        return FilmShape(
            means=self.means,
            phi=phi,
            weight=weight,
            exponent=a,
            stencil=self.stencil,
            depth=self.depth,
            domain=self.domain,
            sensitivity=sensitivity,
            line=line,
            law=self.law,
        )


def _law_coefficient(local: LocalEdge, depth: Field, law: FilmLaw) -> Field:
    """Compute c = ¾ (b - κ) for φ = g s (1 + b s) at the distance s from an edge of curvature κ,
    limited by the largest distance `depth` of a cell from the outside."""
    limit = MAX_COEFFICIENT / (np.max(depth) * min(law.stretched))
    return np.clip(0.75 * (local.bend / (2 * local.slope) - local.curvature), -limit, limit)
