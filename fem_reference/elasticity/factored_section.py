"""Factorised stiffness of one body in one harmonic, and displacements by forces on its surface."""

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import block_array, coo_array, csr_array
from scipy.sparse.linalg import splu
from skfem import Basis, condense

from contact_scene.array_types import Field
from fem_reference.elasticity.motion import Motion
from fem_reference.elasticity.numbering import Dofs, Numbering, number_unknowns
from fem_reference.elasticity.section_basis import displacement_basis
from fem_reference.elasticity.weak_form import dilatation, element_stiffness, volume_strain
from fem_reference.memory import refuse_if_too_large, required_bytes
from fem_reference.mesh.section_mesh import SectionMesh

Indices = NDArray[np.int64]

EVERYWHERE = slice(None)

BLOCK = 64
"""Number of right-hand sides that are solved at once. More need more memory and save no time."""


class FactoredSection:
    """Factorised stiffness of the meridional section of one body in one angular harmonic.

    Used to compute displacements by surface forces, and the compliance of the surface. Unknowns are
    in the order of elimination, those of the contact zone last. The symmetric matrix is eliminated
    in this order without pivoting. The last block of the factors is therefore the stiffness of the
    contact zone after condensation of all other unknowns. The constructor raises ResourceRefused if
    the memory is insufficient.

    section, motion  mesh and harmonic of the factorised problem
    nodes            positions (r, z) of the nodes (2, n)
    surface          indices of the nodes of the contact zone (m,), in the order of their radii
    """

    def __init__(self, section: SectionMesh, motion: Motion) -> None:
        self.section, self.motion = section, motion
        basis = displacement_basis(section)
        self.nodes = basis.doflocs
        contact = basis.get_dofs("contact").all()
        self.surface = contact[np.argsort(self.nodes[0, contact])]
        mixed = dilatation(section).mixed & motion.changes_volume
        self._numbering = number_unknowns(section, motion, basis, mixed)
        unknowns, components = self._numbering.order.size, len(motion.components)
        refuse_if_too_large(required_bytes(len(mixed), unknowns, components, bool(mixed.any())))
        matrix = _assemble_stiffness(section, motion, basis, self._numbering)
        if mixed.any():
            matrix = _add_pressure_unknowns(matrix, section, motion, basis, self._numbering)
        prescribed = self._far_displacements(basis)
        inner, loads, far, _ = condense(
            matrix, np.zeros_like(prescribed), prescribed, I=self._numbering.order
        )
        self._lu = splu(
            inner.T,  # the symmetric matrix, stored by columns
            permc_spec="NATURAL",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        far[self._numbering.order] = self._lu.solve(loads)
        self._far = self._numbering.factor * far[self._numbering.dofs]

    def displacement(self, forces: Field, nodes: Indices | slice = EVERYWHERE) -> Field:
        """Compute the displacements of nodes of a body by generalised forces on its surface nodes.

        The result has the shape (c, nodes, k) for c displacement components and k load cases.

        forces  generalised forces on the m surface nodes, the integrals of trace function times
                traction over r dr (c, m, k)
        nodes   indices of the nodes at which displacements are returned; all nodes by default
        """
        weights = self.motion.resultant_weights(self.section.radii)
        resultants = np.einsum("cm,cmk->k", weights, forces)
        displacement = self._far[:, nodes, None] * resultants
        numbering, order = self._numbering, self._numbering.order
        dofs, factor = numbering.dofs, numbering.factor[..., None]
        for start in range(0, forces.shape[2], BLOCK):
            block = forces[..., start : start + BLOCK]
            loads = np.zeros((numbering.size, block.shape[2]))
            np.add.at(loads, dofs[:, self.surface], factor[:, self.surface] * block)
            solved = np.zeros_like(loads)
            solved[order] = self._lu.solve(loads[order])
            displacement[..., start : start + BLOCK] += factor[:, nodes] * solved[dofs[:, nodes]]
        return displacement

    def compliance(self) -> Field:
        """Compute the displacement of the surface nodes of a body per unit generalised force.

        The shape is (c, m, c, m) for c components and m surface nodes. The matrix is the inverse of
        the stiffness after condensation on the contact zone, plus the effect of the prescribed
        displacement far from the contact. This effect depends on the resultant alone and makes the
        matrix slightly asymmetric. The result is the symmetric part.
        """
        numbering, first = self._numbering, self._numbering.contact
        stiffness = (self._lu.L[first:, first:] @ self._lu.U[first:, first:]).toarray()
        factor = numbering.factor[:, self.surface].ravel()
        place = np.zeros(numbering.size, dtype=np.int64)
        place[numbering.order[first:]] = np.arange(len(stiffness))
        places = place[numbering.dofs[:, self.surface].ravel()]
        matrix = factor[:, None] * np.linalg.inv(stiffness)[np.ix_(places, places)] * factor
        weights = self.motion.resultant_weights(self.section.radii)
        matrix += np.outer(self._far[:, self.surface], weights)
        return (0.5 * (matrix + matrix.T)).reshape(weights.shape * 2)

    def _far_displacements(self, basis: Basis) -> Field:
        """Return the displacements that a unit resultant load prescribes on the far boundary.

        The far boundary is the outer edge and the base of the mesh. The displacements are those of
        a half-space, or zero for a rigid base or for a motion without resultant. The array has an
        entry for every degree of freedom, zero except on the far boundary.

        basis  finite-element basis of one displacement component
        """
        values = np.zeros(self._numbering.size)
        outline, far_field = self.section.outline, self.motion.far_field
        if far_field is not None and not outline.rigid_base:
            far = basis.get_dofs("far").all()
            r, z = self.nodes[:, far]
            known = far_field(r, z, outline.materials[-1])
            factor = self._numbering.factor[:, far]
            moved = factor * known[list(self.motion.components)]
            values[self._numbering.dofs[:, far][factor != 0.0]] = moved[factor != 0.0]
        return values


def _assemble_stiffness(
    section: SectionMesh, motion: Motion, basis: Basis, numbering: Numbering
) -> csr_array:
    """Assemble the stiffness of a body for one angular harmonic, without boundary conditions.

    Entries with the value zero remain in the sparsity pattern, because fill-in needs them.
    """
    stiffness = element_stiffness(basis, section, motion.in_strains, motion.components)
    dofs, factor = _element_unknowns(basis, numbering)
    stiffness *= factor[:, :, None] * factor[:, None]
    both = (dofs[:, :, None], dofs[:, None])
    place = [np.broadcast_to(one, stiffness.shape).ravel() for one in both]
    size = numbering.dofs.size
    return coo_array((stiffness.ravel(), tuple(place)), shape=(size, size)).tocsr()


def _add_pressure_unknowns(
    stiffness: csr_array, section: SectionMesh, motion: Motion, basis: Basis, numbering: Numbering
) -> csr_array:
    """Extend the stiffness matrix by the pressures in each nearly incompressible element.

    The additional equations are volume strain = p / lambda, with Lamé's constant lambda. The
    pressures enter the displacement equations by the transposed matrix.
    """
    mixed, first = dilatation(section).mixed, numbering.dofs.size
    volume = volume_strain(basis, motion.in_strains, motion.components)[mixed]
    dofs, factor = (one[mixed, :, None] for one in _element_unknowns(basis, numbering))
    rows = np.broadcast_to((numbering.pressure - first)[:, None], volume.shape).ravel()
    columns = np.broadcast_to(dofs, volume.shape).ravel()
    shape = (numbering.pressure.size, first)
    expansion = coo_array(((volume * factor).ravel(), (rows, columns)), shape=shape)
    softness = np.repeat(dilatation(section).compliance[mixed], numbering.pressure.shape[1])
    itself = coo_array((-softness, (np.arange(softness.size),) * 2))
    return block_array([[stiffness, expansion.T], [expansion, itself]], format="csr")


def _element_unknowns(basis: Basis, numbering: Numbering) -> tuple[Dofs, Field]:
    """Return degrees of freedom and factors of nodal displacements (e, m c), components contiguous.
    On the axis, where components are zero or depend on each other, factors differ from 1."""
    shape = (-1, basis.nelems)
    return (
        numbering.dofs[:, basis.element_dofs].reshape(shape).T,
        numbering.factor[:, basis.element_dofs].reshape(shape).T,
    )
