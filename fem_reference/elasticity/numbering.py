"""Unknowns of a section in one harmonic, numbered in the order of elimination."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_reference.elasticity.elimination_order import elimination_keys
from fem_reference.elasticity.motion import Motion
from fem_reference.mesh.section_mesh import SectionMesh

Indices = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Numbering:
    """A displacement is a factor times an unknown; what is prescribed has the factor 0, column -1.

    column    (c, n) unknown of every displacement
    factor    (c, n)
    pressure  (e, 3) unknowns of an element's pressure, -1 where it has none
    contact   first of the unknowns of the contact zone, which come last
    size      number of unknowns
    """

    column: Indices
    factor: NDArray[np.float64]
    pressure: Indices
    contact: int
    size: int


def number_unknowns(
    section: SectionMesh,
    motion: Motion,
    nodes: NDArray[np.float64],
    elements: Indices,
    surface: Indices,
    mixed: NDArray[np.bool_],
) -> Numbering:
    """Number what can move.

    nodes, elements  (2, n) positions, (e, 9) nodes of the elements
    surface          nodes of the contact zone
    mixed            (e,) elements whose pressure is unknown
    """
    factor = _factors(section, motion, nodes)
    # Displacements on the axis share one unknown: that of the first component that moves.
    moving = factor != 0.0
    axis = nodes[0] == 0.0
    owners = np.argwhere((moving & ~(axis & (np.cumsum(moving, axis=0) > 1))).T)

    keys = elimination_keys(section.points, section.quads, elements)
    keys[1, surface] = keys.max() + 1
    rank = np.empty(nodes.shape[1], dtype=np.int64)
    rank[np.lexsort(keys)] = np.arange(rank.size)
    # A pressure is held by the displacements around it alone: it follows them, save for those of
    # the contact zone, which are not to be eliminated with the rest.
    inside = np.where(np.isin(elements, surface), -1, rank[elements]).max(axis=1)
    places = np.concatenate([2 * rank[owners[:, 0]], np.repeat(2 * inside[mixed] + 1, 3)])
    number = np.empty(places.size, dtype=np.int64)
    number[np.argsort(places, kind="stable")] = np.arange(places.size)

    column = np.full(factor.shape, -1)
    column[owners[:, 1], owners[:, 0]] = number[: len(owners)]
    column[:, axis] = np.where(moving[:, axis], column[:, axis].max(axis=0), -1)
    pressure = np.full((mixed.size, 3), -1)
    pressure[mixed] = number[len(owners) :].reshape(-1, 3)
    on_surface = column[:, surface]
    contact = int(on_surface[on_surface >= 0].min())
    return Numbering(column, factor, pressure, contact, number.size)


def _factors(
    section: SectionMesh, motion: Motion, nodes: NDArray[np.float64]
) -> NDArray[np.float64]:
    r, z = nodes
    factor = np.ones((len(motion.components), r.size))
    factor[:, r == 0.0] = np.asarray(motion.on_axis)[:, None]
    factor[:, (r == section.outline.box) | (z == section.outline.depth)] = 0.0
    return factor
