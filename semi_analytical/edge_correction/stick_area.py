"""Area of the stick zone of coupled bodies, from fits of the shear deficit along its border.

Let n be the direction of slip. The deficit d = µp - q·n of the shear q from the friction limit µp
vanishes at the border of the stick zone. With s the distance from the border, d ~ s^(1/2) where the
slip zone grows, like the pressure of a smaller contact (Cattaneo 1938). Where the stick zone grows,
as in normal loading, d ~ s^(3/2), because newly sticking cells are still at the friction limit.
Each border cell uses the law with the smaller residual. The shear normal to n is smooth across the
border and is therefore excluded from d.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, VectorField
from semi_analytical.edge.contact_area import near, stuck_cells
from semi_analytical.edge.fit import NARROW, WIDE, Stencil
from semi_analytical.edge.shape import LARGEST_RMS, AdjacentCells, depth_of, edge_shape
from semi_analytical.edge_correction.shear_at_edge import LAYERS, direction_of_slip
from semi_analytical.operator.box import box_around
from semi_analytical.operator.domain import WINDOW, ReducedDomain

# Exponent of the distance, stencil of the fit, and factor of the residual in the comparison. The
# exponent 3/2 requires a wider stencil. Its fits can follow a root at a strongly curved border, so
# their residual must be half as large.
LAWS = ((0.5, NARROW, 1.0), (1.5, WIDE, 2.0))
# Least radius in cells of a zone that can be fitted.
THICK = 3.0
# Distance in cells from the border, inside, of cells that it may cut.
CUT = 1.5


@dataclass(frozen=True)
class _LawFit:
    """Fit of one power law to the shear deficit in the n cells along the border of the stick zone.

    The deficit is the friction limit minus the shear. Fits of two power laws are compared.

    stuck     sticking fraction of each cell (n,)
    residual  rms residual of the fit over the change of the fitted function across a cell, times
              the factor of the law in LAWS; infinite for unreliable fits (n,)
    """

    stuck: Field
    residual: Field


def stick_area(
    shear: VectorField,
    bound: Field,
    stick: Mask,
    *,
    spreads: bool = True,
    domain: ReducedDomain = WINDOW,
) -> float:
    """Compute the area of the stick zone in cells, with the sticking fractions of its border cells.

    The fractions come from fits of two power laws to the shear deficit. A cell of the stick zone
    counts as 1 if neither law fits there. Zones that are too thin for fits use `stuck_cells`.

    shear    cell means of the shear q at the corrected pressure (2, nx, ny)
    bound    friction limit µp, zero outside the contact area (nx, ny)
    stick    sticking cells (nx, ny)
    spreads  True if the stick zone may have grown; without coupling the zone grows only with the
             pressure
    domain   reduced domain of the solution: mirror images of a border cell share one fit
    """
    if not np.any(stick):
        return 0.0
    if stick.shape[1] == 1:
        return stuck_cells(shear, bound, stick)
    box = box_around(stick, LAYERS + 1).slices  # cells that determine the direction of slip
    shear, bound, stick = shear[:, *box], bound[box], stick[box]
    slips, depth = (bound > 0) & ~stick, depth_of(stick)
    if not np.any(slips) or np.max(depth) < THICK:
        return stuck_cells(shear, bound, stick)
    # The box is symmetric about the mirror planes. Cells of one side are counted; the margin on the
    # other side contains the data of their fits.
    planes = [stick.shape[axis] // 2 * domain.mirrors[axis] for axis in (0, 1)]
    margins = [min(plane, LAYERS) for plane in planes]
    part = tuple(slice(at - width, None) for at, width in zip(planes, margins, strict=True))
    counted = tuple(slice(width, None) for width in margins)
    shear, bound, depth = shear[:, *part], bound[part], depth[part]
    stick, slips = stick[part], slips[part]
    along = np.sum(shear * direction_of_slip(shear, slips), axis=0)
    deficit = np.where(stick, np.maximum(bound - along, 0.0), 0.0)
    border = np.zeros_like(stick)
    border[counted] = ((depth <= CUT) & near(np.pad(stick, 1)))[counted]
    i, j = np.nonzero(border)
    laws = LAWS if spreads else LAWS[:1]
    cells, deficit = AdjacentCells(depth, i, j), deficit / np.max(deficit)
    fits = [_fit_power_law(deficit, stick, depth, cells, *law) for law in laws]
    residual = np.stack([fit.residual for fit in fits])
    best = np.argmin(residual, axis=0)
    stuck = np.stack([fit.stuck for fit in fits])[best, np.arange(len(i))]
    covered = stick.astype(float)
    fitted = np.isfinite(np.min(residual, axis=0))
    covered[i[fitted], j[fitted]] = stuck[fitted]
    return domain.images * float(np.sum(covered[counted]))


def _fit_power_law(
    deficit: Field,
    stick: Mask,
    depth: Field,
    cells: AdjacentCells,
    exponent: float,
    stencil: Stencil,
    factor: float,
) -> _LawFit:
    """Fit one power law to the shear deficit over its largest value (nx, ny),
    at the border of the stick zone. Deficit: friction limit minus shear along slip."""
    shape = edge_shape(deficit, stick, stencil, rings=0, exponent=exponent, rounds=2, depth=depth)
    phi, error = shape.about_cells(cells, shape.fits(*cells.fitted))
    return _LawFit(phi.cell_mean(0.0), np.where(error < LARGEST_RMS, factor * error, np.inf))
