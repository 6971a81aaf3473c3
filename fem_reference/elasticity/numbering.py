"""Degrees of freedom of a section in one harmonic, and the order of their elimination.

The order is a nested dissection by the position of the elements. A section is cut in two along a
line of nodes, then each half is cut in two, and so on. The nodes of a cut are eliminated after both
halves that they separate. No fill then arises between the halves (George 1973, SIAM Journal on
Numerical Analysis 10, 345-363).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skfem import Basis

from fem_reference.elasticity.motion import Motion
from fem_reference.mesh.element_order import ELEMENTS
from fem_reference.mesh.section_mesh import SectionMesh

Indices = NDArray[np.int64]
Dofs = NDArray[np.int32]

LEAF = 4  # number of elements in a subtree that is not divided further


@dataclass(frozen=True, eq=False)
class Numbering:
    """Degrees of freedom of the mesh of one body, and the order of their elimination.

    Each nodal displacement is a factor times one degree of freedom. The displacement components of
    a node on the axis share one degree of freedom.

    dofs      degree of freedom of every displacement (c, n), for c components and n nodes
    factor    factor of every displacement (c, n)
    pressure  degrees of freedom of the m elements whose pressure is unknown (m, f); they have the
              last numbers
    order     unknowns in the order of elimination (u,); those of the contact zone are the last
    contact   number of unknowns that precede those of the contact zone in this order
    size      number of degrees of freedom, including prescribed ones
    """

    dofs: Dofs
    factor: NDArray[np.float64]
    pressure: Indices
    order: Indices
    contact: int
    size: int


def number_unknowns(
    section: SectionMesh, motion: Motion, basis: Basis, mixed: NDArray[np.bool_]
) -> Numbering:
    """Number the degrees of freedom of a body's mesh and determine the order of their elimination.

    The order keeps the factors of the stiffness matrix sparse. The degrees of freedom of the
    contact zone are the last.

    section  mesh of the meridional section of a body
    motion   displacement components, and their conditions on the axis
    basis    finite-element basis of one displacement component
    mixed    True for nearly incompressible elements, whose pressure is unknown (e,)
    """
    components, axis = len(motion.components), basis.get_dofs("axis").all()
    surface, far = basis.get_dofs("contact").all(), basis.get_dofs("far").all()
    factor = np.ones((components, basis.N))
    factor[:, axis] = np.asarray(motion.on_axis)[:, None]
    dofs = np.arange(factor.size, dtype=np.int32).reshape(factor.shape)
    dofs[:, axis] = dofs[np.argmax(factor[:, axis] != 0.0, axis=0), axis]
    moving = factor != 0.0
    moving[:, far] = False
    free = np.flatnonzero(moving & (dofs == np.arange(dofs.size).reshape(dofs.shape)))
    count = len(ELEMENTS.pressures)
    pressure = factor.size + np.arange(count * np.count_nonzero(mixed)).reshape(-1, count)

    elements = basis.element_dofs.T
    keys = _elimination_keys(section.points, section.quads, elements)
    keys[1, surface] = keys.max() + 1
    rank = np.empty(basis.N, dtype=np.int64)
    rank[np.lexsort(keys)] = np.arange(rank.size)
    # A pressure depends only on the displacements of its element. It is eliminated after them,
    # except for those of the contact zone, which are not eliminated.
    inside = np.where(np.isin(elements, surface), -1, rank[elements]).max(axis=1)
    places = np.concatenate([2 * rank[free % basis.N], np.repeat(2 * inside[mixed] + 1, count)])
    order = np.concatenate([free, pressure.ravel()])[np.argsort(places, kind="stable")]
    contact = order.size - int(np.sum(np.isin(free % basis.N, surface)))
    return Numbering(dofs, factor, pressure, order, contact, factor.size + pressure.size)


def _elimination_keys(points: NDArray[np.float64], quads: Indices, elements: Indices) -> Indices:
    """Compute two sort keys of each node of a mesh for the order of elimination (2, n).

    Nodes are eliminated in the order of the second key; the first key decides between equal ones.
    In this order, nodes on the line between two parts of the mesh follow the nodes of both parts.
    The factors of the stiffness matrix then remain sparse.

    points, quads  corner positions (2, k), and corner indices of the elements (4, e)
    elements       the m nodes of every element (e, m)
    """
    leaf = _number_leaves(points, quads)
    count = int(elements.max()) + 1
    first, last = np.full(count, leaf.max()), np.zeros(count, dtype=np.int64)
    np.minimum.at(first, elements, leaf[:, None])
    np.maximum.at(last, elements, leaf[:, None])
    # Leaves of a subtree have equal leading bits. A node belongs to the smallest subtree with all
    # its elements, and follows the leaves of this subtree.
    height = np.frexp((first ^ last).astype(np.float64))[1].astype(np.int64)
    end = ((last >> height) + 1) << height
    return np.stack([height, end])


def _number_leaves(points: NDArray[np.float64], quads: Indices) -> Indices:
    """Divide the elements of a mesh into small groups of neighbours and number the groups (e,).

    The mesh is cut in two at the median position of its elements, then each half is cut, and so on.
    The groups are the leaves of this binary tree, which determines the order of elimination of the
    unknowns. The result contains the number of the leaf of each element.

    points, quads  corner positions (2, k), and corner indices of the elements (4, e)
    """
    corners = points[:, quads]
    low, high = corners.min(axis=1), corners.max(axis=1)
    middle = 0.5 * (low + high)
    depth = max(0, int(np.ceil(np.log2(quads.shape[1] / LEAF))))
    leaf = np.zeros(quads.shape[1], dtype=np.int64)
    outwards = np.argsort(middle, axis=1)
    for level in reversed(range(depth)):
        _, group, size = np.unique(leaf, return_inverse=True, return_counts=True)
        median_at = np.cumsum(size) - size + size // 2
        below, price = [], []
        for a, by_place in enumerate(outwards):
            by_group = by_place[np.argsort(group[by_place], kind="stable")]
            median = middle[a, by_group[median_at]][group]
            below.append(middle[a] < median)
            cut = np.bincount(group, (low[a] < median) & (high[a] >= median))
            unequal = np.abs(2 * np.bincount(group, below[a]) - size) / size
            price.append(cut * (1.0 + unequal) + size * (unequal == 1.0))
        # The cut is perpendicular to the axis along which it meets fewer elements.
        side = np.where((price[0] <= price[1])[group], *below)
        leaf += (~side & (size > 1)[group]) * (1 << level)
    return leaf
