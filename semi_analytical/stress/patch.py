"""Surface stress between cell centres that is caused by all cells beyond a patch about the point.

The contribution of the patch is subtracted at the cell centres. The remaining stress, which
includes that of the layers, is smooth and is interpolated. The stress at the contact edge is the
sum of this stress and that of the patch.
"""

from functools import lru_cache

import numpy as np

from contact_scene.array_types import Field, Indices
from semi_analytical.frf.stack import HalfSpace
from semi_analytical.stress.components import STRESS
from semi_analytical.stress.rectangle import half_space_response

# Half sides of the patch and of the nodes of interpolation, in cells.
PATCH = 8
NODES = 2


def stress_from_beyond(
    cells: Field,
    plane: Field,
    x: Field,
    y: Field,
    material: HalfSpace,
    spacing: tuple[float, float],
) -> Field:
    """Compute the surface stress (6, n) at points by cells outside a patch about each.

    The patch is centred at the nearest cell, which is at least NODES cells from the border of the
    grid.

    cells     tractions (q_x, q_y, p) of the cells (3, nx + 2 PATCH, ny + 2 PATCH) [force/length^2];
              PATCH layers of cells without traction surround the grid
    plane     surface stress at the cell centres by all tractions (6, nx, ny) [force/length^2]
    x, y      points as cell indices (n,)
    material  outermost material of the body
    spacing   cell sides [length]
    """
    i, j = np.rint(x).astype(int), np.rint(y).astype(int)
    nodes = np.arange(-NODES, NODES + 1)
    patches = _cell_patches(cells, i, j).reshape(len(i), -1)
    by_patch = (patches @ _patch_kernel(material, spacing)).reshape(len(i), 6, -1)
    at = plane[:, (i[:, None] + nodes)[:, :, None], (j[:, None] + nodes)[:, None, :]]
    rest = at.reshape(6, len(i), -1) - np.moveaxis(by_patch, 1, 0)
    weights = _lagrange_weights(x - i)[:, :, None] * _lagrange_weights(y - j)[:, None, :]
    return np.asarray(np.einsum("fnk,nk->fn", rest, weights.reshape(len(i), -1)))


def _cell_patches(cells: Field, i: Indices, j: Indices) -> Field:
    """Return (q_x, q_y, p) on the patch about each cell (n, 3, side, side), side = 2 PATCH + 1.
    `cells` has PATCH layers of cells without traction around it."""
    shift = np.arange(2 * PATCH + 1)
    found = cells[:, (i[:, None] + shift)[:, :, None], (j[:, None] + shift)[:, None, :]]
    return np.moveaxis(found, 1, 0)


@lru_cache(4)
def _patch_kernel(material: HalfSpace, spacing: tuple[float, float]) -> Field:
    """Compute the surface stress at each interpolation node by each unit traction of a patch of
    cells.

    The shape is (3 side², 6 nodes), with the number `side` of cells along a side of the patch. The
    nodes are cell centres about the centre of the patch.

    material  outermost material of the body
    spacing   cell sides [length]
    """
    reach = PATCH + NODES
    x, y = ((np.arange(-reach, reach + 2.0) - 0.5) * side for side in spacing)
    response = half_space_response(x, y, 0.0, material)[STRESS]
    side = 2 * PATCH + 1
    columns = [
        # Observer minus source, sources in increasing order.
        response[:, :, a : a + side, b : b + side][:, :, ::-1, ::-1].reshape(6, -1)
        for a in range(2 * NODES + 1)
        for b in range(2 * NODES + 1)
    ]
    return np.ascontiguousarray(np.stack(columns, axis=1).reshape(6 * len(columns), -1).T)


def _lagrange_weights(at: Field) -> Field:
    """Compute the weights of the nodes for one-dimensional Lagrange interpolation (n, 2 NODES + 1).

    The nodes are the integers from -NODES to NODES.

    at  positions of the interpolated values (n,)
    """
    nodes = np.arange(-NODES, NODES + 1)
    weights = np.ones((len(at), len(nodes)))
    for column, node in enumerate(nodes):
        for other in nodes[nodes != node]:
            weights[:, column] *= (at - other) / (node - other)
    return weights
