"""Areas of the contact and of the stick zone, resolved below the cell size by local fits.

Towards the edge of a smooth contact the pressure p falls like the square root of the distance, so
that p² passes through zero with a finite slope. A quadratic is fitted to p² in interior cells and
extrapolated over the edge cells. The covered fraction of an edge cell is the part where the fit is
positive. At the border of the stick zone the difference between friction limit and shear is the
pressure of a smaller contact and has the same behaviour (Cattaneo 1938; after a load reversal
Mindlin and Deresiewicz 1953).
"""

import numpy as np

from contact_scene.array_types import Field, Mask
from semi_analytical.edge.fit import Stencil, fit_about
from semi_analytical.edge.half_width import covered_strips
from semi_analytical.operator.domain import WINDOW, ReducedDomain

STENCIL = Stencil(4, 1.7)
LEAST_CELLS = 12
# Largest ratio of the fit at an edge cell to the mean of its data.
LEAST_FALL = 0.9


def covered_cells(values: Field, inside: Mask, domain: ReducedDomain = WINDOW) -> float:
    """Compute the area of a contact or stick zone in cells, with fractions of its edge cells.

    The fractions come from local fits to the squared values. An edge cell counts as 1 or 0 by its
    centre where the region is too thin for a fit, or where the values do not fall towards the edge
    (flat punch).

    values  traction that is positive inside the region and falls like a square root towards its
            edge (nx, ny)
    inside  cells whose centre is in the region (nx, ny)
    domain  domain of `values` and `inside`; the area excludes the mirror images
    """
    if inside.shape[1] == 1:
        return covered_strips(values[:, 0], inside[:, 0])
    framed = domain.add_frame(inside, 1)
    trusted = ~near(~framed)  # cells whose neighbours are inside, too
    i, j = np.nonzero(near(framed) & ~trusted)
    if len(i) == 0:
        return float(np.count_nonzero(inside))
    phi = np.square(values / np.max(values))
    fits = fit_about(phi, trusted.astype(float), i, j, STENCIL, domain=domain)
    centre_inside = inside[i, j]
    parts = np.clip(
        fits.quadratic.cell_mean(0.0),
        np.where(centre_inside, 0.5, 0),
        np.where(centre_inside, 1, 0.5),
    )
    believed = (fits.count >= LEAST_CELLS) & (fits.quadratic.mean < LEAST_FALL * fits.mean)
    whole = np.count_nonzero(trusted)
    return float(whole + np.sum(np.where(believed, parts, centre_inside)))


def stuck_cells(shear: Field, bound: Field, in_stick: Mask) -> float:
    """Compute the area of the stick zone in cells, from fits to the shear deficit.

    The deficit is the shear of gross slip minus the actual shear. Its direction of slip is that of
    the nearest slipping cell, because after a load reversal the shear just inside the stick zone
    still has the former direction.

    shear     shear q of the cells (2, nx, ny) [force/length^2]
    bound     friction limit µp of the cells, zero outside the contact area (nx, ny)
              [force/length^2]
    in_stick  sticking cells (nx, ny)
    """
    inside = _box_with_edge(bound > 0)
    shear, bound, in_stick = shear[(slice(None), *inside)], bound[inside], in_stick[inside]
    in_slip = (bound > 0) & ~in_stick
    if not np.any(in_slip):
        return covered_cells(bound, in_stick)
    from scipy.ndimage import distance_transform_edt  # the import takes as long as a contact

    nearest = distance_transform_edt(~in_slip, return_distances=False, return_indices=True)
    q = shear[:, nearest[0], nearest[1]]
    direction = q / np.sqrt(q[0] ** 2 + q[1] ** 2)
    missing = bound * direction - shear
    return covered_cells(np.sqrt(missing[0] ** 2 + missing[1] ** 2), in_stick)


def _box_with_edge(marked: Mask) -> tuple[slice, ...]:
    """Return the slices of the smallest rectangle of the given cells and their neighbours:
    fits there cost less than on the whole window."""
    at = (np.flatnonzero(np.any(marked, axis=axis)) for axis in (1, 0))
    return tuple(slice(max(0, i[0] - 1), i[-1] + 2) if len(i) else slice(0) for i in at)


def near(marked: Mask) -> Mask:
    """Return a mask of the cells of a set and of all cells that touch them, also at a corner.

    The mask has the shape (nx - 2, ny - 2): it omits the outermost layer of cells of the input.

    marked  cells of the set (nx, ny)
    """
    along = marked[:-2] | marked[1:-1] | marked[2:]
    return np.asarray(along[:, :-2] | along[:, 1:-1] | along[:, 2:])
