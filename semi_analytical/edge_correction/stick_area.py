"""Area of the stick zone where bodies couple: parts of its border move out while others move in.

What is missing from full slip along n, the direction of slip, d = µp - q·n, vanishes at the border.
Where slip spreads it goes with the root of the distance, like the pressure of a smaller contact
(Cattaneo 1938); where stick spreads, as in pressing, it is of a higher order, s^(3/2): what has
just stuck is still at the limit. Of both laws each place has the one that fits, the root if both
do. Shear across n passes the border smoothly, and would hide it in the length of what is missing.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import distance_transform_edt

from contact_scene.array_types import Field, Mask, VectorField
from semi_analytical.edge.fit import NARROW, WIDE, Stencil
from semi_analytical.edge.shape import LARGEST_RMS, AdjacentCells, depth_of, edge_shape
from semi_analytical.edge_correction.shear_at_edge import LAYERS, direction_of_slip
from semi_analytical.normal.contact_area import stuck_cells
from semi_analytical.operator.box import box_around

# Exponent of the distance, stencil of its fit, and factor of what the fit misses when both laws are
# compared. A smoother fall needs more cells. On these it bends to what a border that turns sharply
# has beside a root: the fit must miss half as much.
LAWS = ((0.5, NARROW, 1.0), (1.5, WIDE, 2.0))
# Radius of a zone in cells that is thick enough to be fitted.
THICK = 3.0
# Layers inside and outside the border of cells that it may cut.
CUT = 1.5


@dataclass(frozen=True)
class _Parts:
    """Of the cells along the border, by one law: the part of each that sticks, and how far the fit
    misses its data in falls over a cell times a factor, infinite where it misses too much (n,)."""

    stuck: Field
    missed: Field


def stick_area(shear: VectorField, bound: Field, stick: Mask, *, spreads: bool = True) -> float:
    """Area of the stick zone in cells.

    shear  q (2, nx, ny), means over cells as they are with the edge of contact inside
    bound  friction limit µp (nx, ny), zero outside the contact
    stick  cells that stick (nx, ny)
    spreads  whether stick may have spread; without coupling it spreads only as the pressure changes
    Cells count whole where neither law fits; of a zone too thin for fits see `stuck_cells`.
    """
    if not np.any(stick):
        return 0.0
    near = box_around(stick, LAYERS + 1).slices  # all that tells the way of slip there
    shear, bound, stick = shear[:, *near], bound[near], stick[near]
    slips = (bound > 0) & ~stick
    depth = depth_of(stick)
    if not np.any(slips) or np.max(depth) < THICK:
        return stuck_cells(shear, bound, stick)
    along = np.sum(shear * direction_of_slip(shear, slips), axis=0)
    missing = np.where(stick, np.maximum(bound - along, 0.0), 0.0)
    outside = distance_transform_edt(~stick)
    i, j = np.nonzero((depth <= CUT) & (outside <= CUT))
    laws = LAWS if spreads else LAWS[:1]
    cells, missing = AdjacentCells(depth, i, j), missing / np.max(missing)
    by = [_parts(missing, stick, depth, cells, *law) for law in laws]
    missed = np.stack([parts.missed for parts in by])
    best = np.argmin(missed, axis=0)
    stuck = np.stack([parts.stuck for parts in by])[best, np.arange(len(i))]
    covered = stick.astype(float)
    told = np.isfinite(np.min(missed, axis=0))
    covered[i[told], j[told]] = stuck[told]
    return float(np.sum(covered))


def _parts(
    missing: Field,
    stick: Mask,
    depth: Field,
    cells: AdjacentCells,
    exponent: float,
    stencil: Stencil,
    factor: float,
) -> _Parts:
    """Of cells along the border."""
    shape = edge_shape(missing, stick, stencil, rings=0, exponent=exponent, rounds=2, depth=depth)
    phi, missed = shape.about_cells(cells, shape.fits(*cells.fitted))
    return _Parts(phi.cell_mean(0.0), np.where(missed < LARGEST_RMS, factor * missed, np.inf))
