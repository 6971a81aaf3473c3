"""Stress at the contact edge and near it, from tractions that vary within the edge cells.

Near the edge the pressure is √φ, with a quadratic φ. The observer is the point at which the stress
is computed. At the surface, √φ in a box of cells about the observer is integrated along rays.
Farther cells at the edge are divided into subcells with point forces. All other cells act by mean
and slope.
"""

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.frf.stack import HalfSpace
from semi_analytical.stress.components import STRESS
from semi_analytical.stress.edge_rays import stress_by_root
from semi_analytical.stress.edge_tractions import EdgedTractions, part_centres
from semi_analytical.stress.patch import PATCH, stress_from_beyond
from semi_analytical.stress.point_force import stress_by_force
from semi_analytical.stress.rectangle import half_space_response

Spacing = tuple[float, float]

# Half side in cells of the box in which phi is one quadratic.
BOX = 2
# Subcells along a side of a cell: beyond the box, and in the box at a depth of one cell.
PARTS = 4
PARTS_AT_A_CELL = 6
# Batch sizes: observers, and pairs of observer and subcell.
OBSERVERS = 64
SEEN = 1 << 15


def stress_at_surface(
    edged: EdgedTractions, phi: Quadratic, plane: Field, material: HalfSpace, spacing: Spacing
) -> Field:
    """Compute the surface stress (6, n) [force/length^2] at n points near the contact edge.

    edged     tractions with their variation within the edge cells
    phi       quadratics of φ about the n points, whose positions are cell indices; the pressure is
              √φ
    plane     surface stress at the cell centres caused by the uniform tractions `edged.cells` (6,
              nx, ny)
    material  outermost material of the body
    spacing   cell sides [length]
    """
    found = [
        stress_from_beyond(edged.framed_fields[0], plane, some.x, some.y, material, spacing)
        + _stress_in_box(edged, some, material, spacing)
        + _stress_by_points(edged, some.x, some.y, 0.0, material, spacing)
        for some in (
            phi.chosen(slice(start, start + OBSERVERS)) for start in range(0, len(phi.x), OBSERVERS)
        )
    ]
    ring = _stress_by_subcells(edged, phi.x, phi.y, 0.0, material, spacing, PARTS, (BOX + 1, PATCH))
    return np.asarray(np.concatenate(found, axis=-1) + ring)


def change_at_depth(
    edged: EdgedTractions, x: Field, y: Field, depth: float, material: HalfSpace, spacing: Spacing
) -> Field:
    """Compute the change of the stress (6, n) at a depth by the variation of tractions in cells.

    The change [force/length^2] is relative to the stress by uniform tractions in each cell.

    edged     tractions with their variation within the edge cells
    x, y      points as cell indices (n,)
    depth     z > 0 [length], within the outermost material; accurate from a quarter of a cell on
    material  outermost material of the body
    spacing   cell sides [length]
    """
    cells = depth / max(spacing)
    near = max(PARTS, int(np.ceil(PARTS_AT_A_CELL / cells)))
    points = 2 if cells >= 1 else 4
    change = _stress_by_subcells(edged, x, y, depth, material, spacing, near, (0, BOX))
    change += _stress_by_subcells(edged, x, y, depth, material, spacing, PARTS, (BOX + 1, PATCH))
    for start in range(0, len(x), OBSERVERS):
        part = slice(start, start + OBSERVERS)
        change[:, part] += _stress_by_points(
            edged, x[part], y[part], depth, material, spacing, points, slopes_alone=True
        )
    return change


def _stress_in_box(
    edged: EdgedTractions, phi: Quadratic, material: HalfSpace, spacing: Spacing
) -> Field:
    """Compute the surface stress (6, n) at n points by the tractions in a box of cells about each
    point.

    The root √φ of the fitted squared pressure φ is integrated along rays. The difference between
    the cell means of the traction and those of the root acts uniformly on each cell.

    edged     tractions with their variation within the edge cells
    phi       quadratics of φ about the points
    material  outermost material of the body
    spacing   cell sides [length]
    """
    i, j = np.rint(phi.x).astype(int), np.rint(phi.y).astype(int)
    x, y = phi.x - i, phi.y - j
    half = BOX + 0.5
    sides = ((half + x, 0), (half - x, 0), (half + y, 1), (half - y, 1))
    box = np.stack([reach * spacing[axis] for reach, axis in sides])
    slip = edged.slip_at(phi.x, phi.y)
    stress = stress_by_root(phi.in_scaled_axes(*spacing), box, slip, material.poisson_ratio)
    shift = np.arange(-BOX, BOX + 1)
    at_i, at_j = np.broadcast_arrays(
        (i[:, None] + shift)[:, :, None], (j[:, None] + shift)[:, None, :]
    )
    by_root = phi.reshape_arrays((-1, 1, 1)).about(at_i, at_j).cell_mean(0.5)
    last = edged.means.shape
    inside = (at_i >= 0) & (at_i < last[1]) & (at_j >= 0) & (at_j < last[2])
    means = edged.means[:, np.clip(at_i, 0, last[1] - 1), np.clip(at_j, 0, last[2] - 1)] * inside
    left = means - np.concatenate([slip, np.ones((1, len(i)))])[..., None, None] * by_root
    # Observer minus source: corners in decreasing order for increasing sources.
    corners = np.arange(BOX + 1, -BOX - 1, -1) - 0.5
    to_x, to_y = (
        # On a cell side uniform tractions are singular: evaluated next to it.
        np.where(at[:, None] == corners, 1e-9, at[:, None] - corners) * side
        for at, side in zip((x, y), spacing, strict=True)
    )
    sheared = bool(edged.means[:2].any())
    response = half_space_response(to_x, to_y, 0.0, material, sheared=sheared)
    response = response[STRESS, :, :, ::-1, ::-1]
    return stress + np.einsum("ftnij,tnij->fn", response, left[-response.shape[1] :])


def _stress_by_points(
    edged: EdgedTractions,
    x: Field,
    y: Field,
    depth: float,
    material: HalfSpace,
    spacing: Spacing,
    points: int = 2,
    *,
    slopes_alone: bool = False,
) -> Field:
    """Compute the stress (6, n) at n points by cells near each point, as point forces at Gauss
    points.

    The tractions are linear in each cell, with its mean and slope. The cells lie at a distance of
    more than BOX and at most PATCH cells from the point.

    edged         tractions with their variation within the edge cells
    x, y          points as cell indices (n,)
    depth         z >= 0 [length]
    material      outermost material of the body
    spacing       cell sides [length]
    points        number of Gauss points along a cell side
    slopes_alone  omit the means, and include the cells within BOX
    """
    i, j = np.rint(x).astype(int), np.rint(y).astype(int)
    a, b = (
        grid.ravel() for grid in np.meshgrid(*2 * [np.arange(-PATCH, PATCH + 1)], indexing="ij")
    )
    if not slopes_alone:
        ring = np.maximum(np.abs(a), np.abs(b)) > BOX
        a, b = a[ring], b[ring]
    at = i[:, None] + a + PATCH, j[:, None] + b + PATCH
    mean, by_x, by_y = (field[:, at[0], at[1]] for field in edged.framed_fields)
    mean *= not slopes_alone
    observer, cell = np.nonzero((mean[2] > 0) | (by_x[2] != 0) | (by_y[2] != 0))
    mean, by_x, by_y = (field[:, observer, cell] for field in (mean, by_x, by_y))
    to_x, to_y = (x - i)[observer] - a[cell], (y - j)[observer] - b[cell]
    nodes, weights = (half / 2 for half in np.polynomial.legendre.leggauss(points))
    total = np.zeros((6, len(observer)))
    for s, weight_s in zip(nodes, weights, strict=True):
        for t, weight_t in zip(nodes, weights, strict=True):
            area = spacing[0] * spacing[1] * weight_s * weight_t
            force = area * (mean + s * by_x + t * by_y)
            places = (to_x - s) * spacing[0], (to_y - t) * spacing[1]
            total += stress_by_force(*places, depth, material.poisson_ratio, force)
    return _sum_over_sources(total, observer, len(x))


def _stress_by_subcells(
    edged: EdgedTractions,
    x: Field,
    y: Field,
    depth: float,
    material: HalfSpace,
    spacing: Spacing,
    count: int,
    within: tuple[int, int],
) -> Field:
    """Compute the stress (6, n) at n points by the variation of tractions within the edge cells.

    Each subcell acts as a point force: its traction minus the uniform traction of its cell, times
    its area.

    edged     tractions with their variation within the edge cells
    x, y      points as cell indices (n,)
    depth     z >= 0 [length]
    material  outermost material of the body
    spacing   cell sides [length]
    count     number of subcells along a cell side
    within    least and largest distance in cells of the edge cells that are included
    """
    i, j = np.rint(x).astype(int), np.rint(y).astype(int)
    pairs = []
    for start in range(0, len(x), OBSERVERS):
        some = slice(start, start + OBSERVERS)
        away = np.maximum(np.abs(edged.i - i[some, None]), np.abs(edged.j - j[some, None]))
        seen_from, seen = np.nonzero((away >= within[0]) & (away <= within[1]))
        pairs.append((seen_from + start, seen))
    observer, cell = np.concatenate(pairs, axis=1)
    at = part_centres(count)
    forces = edged.subcell_deviations(count) * (spacing[0] * spacing[1] / count**2)
    stress = np.zeros((6, len(x)))
    at_once = max(1, SEEN // count**2)
    for start in range(0, len(observer), at_once):
        o, c = observer[start : start + at_once], cell[start : start + at_once]
        to_x = ((x[o] - edged.i[c])[:, None, None] - at[:, None]) * spacing[0]
        to_y = ((y[o] - edged.j[c])[:, None, None] - at) * spacing[1]
        to_x, to_y = np.broadcast_arrays(to_x, to_y)
        each = stress_by_force(to_x, to_y, depth, material.poisson_ratio, forces[:, c])
        stress += _sum_over_sources(np.sum(each, axis=(-2, -1)), o, len(x))
    return stress


def _sum_over_sources(stress: Field, observer: Indices, count: int) -> Field:
    """Sum the stress of pairs of a point and a source (6, pairs) at each point (6, count)."""
    return np.stack([np.bincount(observer, component, count) for component in stress])
