"""One body in one harmonic, factored: displacements of the section for forces on its surface."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import splu

from fem_reference.elasticity.assembly import Elements, assembled, with_pressure
from fem_reference.elasticity.motion import Motion
from fem_reference.elasticity.numbering import number_unknowns
from fem_reference.elasticity.weak_form import (
    dilatation,
    element_stiffness,
    section_basis,
    volume_strain,
)
from fem_reference.memory import require_memory, required_bytes
from fem_reference.mesh.section_mesh import SectionMesh

Field = NDArray[np.float64]
Indices = NDArray[np.int64]

EVERYWHERE = slice(None)

BLOCK = 64
"""Right-hand sides solved at once: more need more memory and are not faster."""


class FactoredSection:
    """The stiffness of a section in one harmonic, factored once, and solves with it.

    Unknowns are numbered as they are eliminated, those of the contact zone last. Symmetric and
    eliminated in that order without pivoting, the last block of the factors is the stiffness of the
    contact zone alone, everything else having followed.

    section, motion  what was factored
    nodes            (2, n) positions (r, z) of the nodes
    surface          (m,) nodes of the contact zone, by radius
    Raises ResourceRefused where the memory does not suffice.
    """

    def __init__(self, section: SectionMesh, motion: Motion) -> None:
        self.section, self.motion = section, motion
        basis = section_basis(section)
        self.nodes = basis.nodes
        self.surface = _contact_nodes(section, basis.nodes)
        expansion = volume_strain(basis, motion.harmonic, motion.components)
        resistance = dilatation(section)
        mixed = resistance.mixed & np.any(expansion, axis=(1, 2))
        self._numbering = number_unknowns(
            section, motion, basis.nodes, basis.elements, self.surface, mixed
        )
        unknowns, count = self._numbering.size, len(motion.components)
        require_memory(required_bytes(len(mixed), unknowns, count, bool(mixed.any())))
        stiffness = element_stiffness(basis, section, motion.harmonic, motion.components)
        blocks = (
            Elements(stiffness, basis.elements, np.full((len(mixed), 0), -1)),
            Elements(
                with_pressure(expansion[mixed], resistance.compliance[mixed]),
                basis.elements[mixed],
                self._numbering.pressure[mixed],
            ),
        )
        self._lu = splu(
            assembled(blocks, self._numbering),
            permc_spec="NATURAL",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        self._far = self._far_displacement(blocks)

    def displacement(self, forces: Field, nodes: Indices | slice = EVERYWHERE) -> Field:
        """(c, n, k) displacement of the nodes for (c, m, k) generalised forces on the surface."""
        weights = self.motion.resultant_weights(self.section.radii)
        resultants = np.einsum("cm,cmk->k", weights, forces)
        displacement = self._far[:, nodes, None] * resultants
        column, factor = self._numbering.column, self._numbering.factor[..., None]
        for start in range(0, forces.shape[2], BLOCK):
            block = forces[..., start : start + BLOCK]
            loads = np.zeros((self._numbering.size + 1, block.shape[2]))  # last: what is at rest
            np.add.at(loads, column[:, self.surface], factor[:, self.surface] * block)
            loads[:-1] = self._lu.solve(loads[:-1])
            loads[-1] = 0.0
            displacement[..., start : start + BLOCK] += factor[:, nodes] * loads[column[:, nodes]]
        return displacement

    def compliance(self) -> Field:
        """(c, m, c, m) displacement of the surface nodes per unit generalised force on them.

        The far field is that of the resultant alone, which leaves a small asymmetry: it is removed.
        """
        first = self._numbering.contact
        factor = self._numbering.factor[:, self.surface].ravel()
        places = np.maximum(self._numbering.column[:, self.surface].ravel() - first, 0)
        stiffness = (self._lu.L[first:, first:] @ self._lu.U[first:, first:]).toarray()
        matrix = factor[:, None] * np.linalg.inv(stiffness)[np.ix_(places, places)] * factor
        weights = self.motion.resultant_weights(self.section.radii)
        matrix += np.outer(self._far[:, self.surface], weights)
        return (0.5 * (matrix + matrix.T)).reshape(weights.shape * 2)

    def _far_displacement(self, blocks: Iterable[Elements]) -> Field:
        """(c, n) displacement of all nodes for a unit resultant of which only the box knows."""
        field = np.zeros_like(self._numbering.factor)
        outline, far_field = self.section.outline, self.motion.far_field
        if far_field is None or outline.rigid_base:
            return field
        r, z = self.nodes
        box = (r == outline.box) | (z == outline.depth)
        values = far_field(r[box], z[box], outline.materials[-1])
        field[:, box] = values[list(self.motion.components)]
        loads = np.zeros(self._numbering.size + 1)
        for block in blocks:
            column, factor = block.unknowns(self._numbering)
            forces = np.einsum("eij,ej->ei", block.matrix, block.values(field))
            np.add.at(loads, column, -factor * forces)
        solution = np.append(self._lu.solve(loads[:-1]), 0.0)
        return field + self._numbering.factor * solution[self._numbering.column]


def _contact_nodes(section: SectionMesh, nodes: Field) -> Indices:
    r, z = nodes
    found = np.flatnonzero((z == 0.0) & (r <= section.outline.zone))
    return found[np.argsort(r[found])]
