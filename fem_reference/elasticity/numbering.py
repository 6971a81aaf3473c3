"""Degrees of freedom of a section in one harmonic, and the order in which they are eliminated."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skfem import Basis

from fem_reference.elasticity.elimination_order import elimination_keys
from fem_reference.elasticity.motion import Motion
from fem_reference.mesh.section_mesh import SectionMesh

Indices = NDArray[np.int64]
Dofs = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Numbering:
    """A displacement is a factor times a degree of freedom: on the axis components share one.

    dofs      (c, n) degree of freedom of every displacement
    factor    (c, n)
    pressure  (m, 3) those of the elements whose pressure is unknown; they come after all others
    order     (u,) the unknown ones as they are eliminated: those of the contact zone last
    contact   how many come before these
    size      number of degrees of freedom, prescribed ones included
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
    """Number what can move.

    basis  of one component
    mixed  (e,) elements whose pressure is unknown
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
    pressure = factor.size + np.arange(3 * np.count_nonzero(mixed)).reshape(-1, 3)

    elements = basis.element_dofs.T
    keys = elimination_keys(section.points, section.quads, elements)
    keys[1, surface] = keys.max() + 1
    rank = np.empty(basis.N, dtype=np.int64)
    rank[np.lexsort(keys)] = np.arange(rank.size)
    # A pressure is held by the displacements around it alone: it follows them, save for those of
    # the contact zone, which are not to be eliminated with the rest.
    inside = np.where(np.isin(elements, surface), -1, rank[elements]).max(axis=1)
    places = np.concatenate([2 * rank[free % basis.N], np.repeat(2 * inside[mixed] + 1, 3)])
    order = np.concatenate([free, pressure.ravel()])[np.argsort(places, kind="stable")]
    contact = order.size - int(np.sum(np.isin(free % basis.N, surface)))
    return Numbering(dofs, factor, pressure, order, contact, factor.size + pressure.size)
