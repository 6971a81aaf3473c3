"""Areas of contact and stick zone with sub-cell accuracy.

Towards the edge of a smooth contact the pressure falls like the square root of the distance, so
that p^2 passes through zero with a finite slope. A quadratic is fitted to p^2 in interior cells and
extrapolated over the edge cells. The covered fraction of an edge cell is the part where the fit is
positive. At the edge of the stick zone the difference between friction limit and shear behaves
equally: it is the pressure of a smaller contact (Cattaneo 1938; after a load reversal Mindlin and
Deresiewicz 1953).
"""

import numpy as np
from scipy.ndimage import distance_transform_edt

from contact_scene.array_types import Field, Indices, Mask
from semi_analytical.edge.clipped_power_means import mean_power
from semi_analytical.operator.domain import WINDOW, ReducedDomain

REACH = 4
FRAME = REACH + 1  # a cell is used for fits if its neighbours are inside
LENGTH = 1.7
LEAST_CELLS = 12
AT_ONCE = 4096  # fits per batch, of four kilobytes each: a long contact has tens of thousands
# Stencil of a fit: offsets along x and y, weights, the terms of a quadratic (cells, 6), and the
# products of all pairs of terms (cells, 36).
DI, DJ = (shift.ravel() for shift in np.mgrid[-REACH : REACH + 1, -REACH : REACH + 1])
NEARNESS = np.exp(-(DI**2 + DJ**2) / (2 * LENGTH**2))
BASIS = np.stack([np.ones_like(DI), DI, DJ, DI * DI, DI * DJ, DJ * DJ], axis=-1).astype(float)
PRODUCTS = (BASIS[:, :, None] * BASIS[:, None, :]).reshape(-1, 36)
# Regularisation of the normal equations, relative to their trace.
RIDGE = 1e-9 * np.eye(6)
# Largest ratio of the fit at an edge cell to the mean of its data.
LEAST_FALL = 0.9


def covered_cells(values: Field, inside: Mask, domain: ReducedDomain = WINDOW) -> float:
    """Compute the area of a region in cells, with the covered fractions of its edge cells.

    values  (nx, ny), positive inside, falling like a square root towards the edge
    inside  cells whose centre is in the region
    domain  domain of both; the area excludes the mirror images
    An edge cell counts as 1 or 0 by its centre where the region is too thin for a fit, or where the
    values do not fall towards the edge (flat punch).
    """
    framed = domain.framed(inside, FRAME)
    trusted = np.zeros_like(framed)
    trusted[1:-1, 1:-1] = ~_near(~framed)
    core = slice(FRAME, -FRAME)
    near = _near(framed)[FRAME - 1 : 1 - FRAME, FRAME - 1 : 1 - FRAME]
    i, j = np.nonzero(near & ~trusted[core, core])
    if len(i) == 0:
        return float(np.count_nonzero(inside))
    phi = domain.framed(np.square(values / np.max(values)), FRAME)
    pieces = range(0, len(i), AT_ONCE)
    fits = [_fit(phi, trusted, i[k : k + AT_ONCE], j[k : k + AT_ONCE]) for k in pieces]
    f, f_x, f_y, mean, count = np.concatenate(fits, axis=1)
    centre_inside = inside[i, j]
    parts = np.clip(
        mean_power(f, f_x, f_y, 0.0),
        np.where(centre_inside, 0.5, 0),
        np.where(centre_inside, 1, 0.5),
    )
    believed = (count >= LEAST_CELLS) & (f < LEAST_FALL * mean)
    whole = np.count_nonzero(trusted[core, core])
    return float(whole + np.sum(np.where(believed, parts, centre_inside)))


def stuck_cells(shear: Field, bound: Field, in_stick: Mask) -> float:
    """Compute the area of the stick zone in cells.

    shear     q (2, nx, ny)
    bound     friction limit µp (nx, ny), zero outside the contact
    in_stick  cells that stick
    The difference to full slip is formed with the slip direction of the nearest slipping cell:
    after a load reversal the shear just inside the stick zone has the former direction.
    """
    inside = _box_with_edge(bound > 0)
    shear, bound, in_stick = shear[(slice(None), *inside)], bound[inside], in_stick[inside]
    in_slip = (bound > 0) & ~in_stick
    if not np.any(in_slip):
        return covered_cells(bound, in_stick)
    nearest = distance_transform_edt(~in_slip, return_distances=False, return_indices=True)
    q = shear[:, nearest[0], nearest[1]]
    direction = q / np.sqrt(q[0] ** 2 + q[1] ** 2)
    missing = bound * direction - shear
    return covered_cells(np.sqrt(missing[0] ** 2 + missing[1] ** 2), in_stick)


def _box_with_edge(marked: Mask) -> tuple[slice, ...]:
    """Return the smallest rectangle that contains the marked cells and their neighbours."""
    at = (np.flatnonzero(np.any(marked, axis=axis)) for axis in (1, 0))
    return tuple(slice(max(0, i[0] - 1), i[-1] + 2) if len(i) else slice(0) for i in at)


def _near(marked: Mask) -> Mask:
    """Return the cells that are marked or adjacent to a marked cell, without the border (nx - 2, ny
    - 2)."""
    along = marked[:-2] | marked[1:-1] | marked[2:]
    return np.asarray(along[:, :-2] | along[:, 1:-1] | along[:, 2:])


def _fit(phi: Field, trusted: Mask, i: Indices, j: Indices) -> Field:
    """Fit weighted quadratics about the cells (i, j).

    Returns value and gradient (x, y) per cell, mean of the data, and number of data (5, cells). phi
    and trusted include the frame.
    """
    rows = phi.shape[1]
    at = ((i + FRAME) * rows + j + FRAME)[:, None] + (DI * rows + DJ)
    use = np.take(trusted, at)
    weight = use * NEARNESS
    normal = (weight @ PRODUCTS).reshape(-1, 6, 6)
    right = (weight * np.take(phi, at)) @ BASIS
    mean = right[:, 0] / np.maximum(normal[:, 0, 0], 1e-30)
    # The regularisation determines coefficients that the data leave undetermined.
    normal += RIDGE * (np.trace(normal, axis1=1, axis2=2)[:, None, None] + 1e-30)
    f, f_x, f_y = np.linalg.solve(normal, right[..., None])[:, :3, 0].T
    return np.stack([f, f_x, f_y, mean, use.sum(axis=1)])
