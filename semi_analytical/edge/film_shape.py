"""Edge shape of contacts of layered bodies: the fits of `shape` with the pressure law of `film`.

Cell means of the pressure are divided by the ratio of the law to √s and then fitted like those of a
root. The ratio depends on the distance s from the edge, hence on the fit. Newton's method solves
for the ratio and the fit: the fits include the derivative of the data with respect to φ at the
edge.
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
from semi_analytical.edge.shape import CUT_WEIGHT, MAX_FIT_DEPTH, EdgeShape
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Depth of the cells along the edge, in cells.
ALONG = 1.5
# Newton steps without and with an edge of the previous iteration.
STEPS, STEPS_AGAIN = 5, 2
# Least logarithmic derivative of the ratio. At the first plateau of the pressure on a film the data
# hardly depend on the edge, and Newton's method would overshoot.
MIN_SENSITIVITY = -0.7
# Largest coefficient c of the law, over the curvature of the inscribed circle.
MAX_COEFFICIENT = 4.0
# Distance from the edge over the width of a subcell beyond which the value at its centre is used.
FAR = 5.0


@dataclass(frozen=True, kw_only=True)
class FilmShape(EdgeShape):
    """Edge shape of a contact of layered bodies: cell means of φ and fits near the edge.

    sensitivity  (nx, ny) derivative of the data `phi` with respect to φ at the nearest edge point
    line         contact edge from which `phi` was computed
    law          law of the pressure near the edge
    """

    sensitivity: Field
    line: EdgeLine
    law: FilmLaw

    def fits(self, i: Indices, j: Indices) -> Fits:
        """Fit φ near cells (i, j) of the region, shape (n,), with the derivative of the data.

        The model of the data is φ at the cell plus `sensitivity` times φ at the nearest edge point.
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
        """Compute the ratios of the pressure law to √s in the subcells of cells (n, PARTS, PARTS).

        phi  quadratic fits of φ about the cells
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
    """Determine the edge shape of a contact region of layered bodies by Newton's method.

    means     (nx, ny) cell means of the pressure, positive in the region
    region    (nx, ny) cells of the region
    stencil   window and weights of the fits
    law       law of the pressure near the edge
    depth     depth of the region, see `shape.depth_of`
    domain    domain of all fields
    exponent  α in p = (ratio of the law to the root) φ^α
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
    means: Field
    region: Mask
    stencil: Stencil
    law: FilmLaw
    depth: Field
    domain: ReducedDomain
    exponent: Exponent

    @property
    def means_by_depth(self) -> Field:
        """Cell means of φ, with the depth of each cell as its distance from the edge (nx, ny).

        Initial guess of φ, and φ of the cells far from the edge.
        """
        size = np.sqrt(np.prod(self.law.stretched))
        s = np.maximum(self.depth - 0.5, 0.5) * size
        curved = np.full(s.shape, -9 / 8 / (np.max(self.depth) * size))  # Hertz contact
        return power(self.means / self.law.over_root(s, curved), np.divide(1, self.exponent))

    def initial_edge(self, i: Indices, j: Indices) -> EdgeLine:
        """Return the initial guess of the contact edge, fitted to cells away from the edge.

        Cells along the edge are excluded, because their φ depends on the unknown position of the
        edge.

        i, j  indices of the cells along the edge (n,)
        """
        inner = (self.region & (self.depth >= ALONG)).astype(float)
        fits = fit_about(self.means_by_depth, inner, i, j, self.stencil, domain=self.domain)
        line = EdgeLine.from_fits(fits.quadratic, self.law.stretched)
        return line.use_median_curvature().append_images(self.domain)

    def about(self, line: EdgeLine) -> FilmShape:
        """Compute the cell means of φ and their sensitivity to the edge, for a given contact edge.

        φ = (pressure over the ratio of the edge law to √s)^(1/α). The distances s are those from
        the given edge.

        line  points of the given contact edge
        """
        phi, weight = self.means_by_depth, self.region.astype(float)
        sensitivity = np.zeros_like(phi)
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
    """Return the coefficient c of the pressure law at cells near the edge of curvature κ.

    c = ¾ (b - κ) for φ = g s (1 + b s) at the distance s from the edge.

    local  geometry of the edge near the cells
    depth  depth of the region in cells (nx, ny); the inscribed radius limits c
    """
    limit = MAX_COEFFICIENT / (np.max(depth) * min(law.stretched))
    return np.clip(0.75 * (local.bend / (2 * local.slope) - local.curvature), -limit, limit)
