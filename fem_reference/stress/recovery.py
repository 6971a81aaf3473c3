"""Recovery of the stress at the nodes from the strains in the elements.

Strains of biquadratic elements are most accurate at their 2 x 2 Gauss points (Barlow 1976). The
stress is computed at these points and extrapolated bilinearly to the nodes of the element. It is
then averaged over the elements of one material that meet at a node (Hinton and Campbell 1974). A
node on an interface has one value for each material. The jump of the in-plane stress at an
interface is therefore preserved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skfem import Basis, ElementQuad2

from contact_scene.array_types import Field
from fem_reference.elasticity.motion import Motion
from fem_reference.elasticity.section_basis import displacement_basis
from fem_reference.elasticity.weak_form import (
    NORMAL,
    dilatation,
    shear_moduli,
    strains,
    volume_strain,
    volume_strain_at,
)
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.scales import Scales
from fem_reference.stress.section_field import Amplitude

Indices = NDArray[np.int64]

ORDER = ("rr", "tt", "zz", "tz", "rz", "rt")
"""Order of the stress components. At theta = 0 it is the order of CONVENTIONS."""

GAUSS = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)


@dataclass(frozen=True, eq=False)
class Recovery:
    """Method that computes the stress at the nodes from the strains at Gauss points.

    The stress at the 2 x 2 Gauss points of an element is extrapolated to its nodes and averaged
    over the elements that meet there. A node on an interface is represented by several points, one
    for each material. There are n points.

    section, basis  mesh, and basis of one displacement component
    at              the same basis, evaluated at the 2 x 2 Gauss points
    extrapolation   matrix from the Gauss points to the nodes of an element (9, 4)
    cells           points of every element (e, 9)
    node            node of every point (n,)
    material        index of the material of every point (n,)
    share           number of elements that meet at a point (n,)
    """

    section: SectionMesh
    basis: Basis
    at: Basis
    extrapolation: Field
    cells: Indices
    node: Indices
    material: Indices
    share: Field

    def amplitude(self, of: Motion, u: Field, scales: Scales, *, turned: bool) -> Amplitude:
        """Compute displacement and stress at the nodes of a section from nodal displacements.

        The nodal displacements belong to one angular harmonic. A node on an interface has one
        stress for each material.

        of      motion: angular harmonic and components of the displacement
        u       dimensionless nodal displacement (c, nodes) for c components
        scales  units of length and stress of the result
        turned  True for a harmonic turned by a quarter wave
        """
        strain = dict.fromkeys(ORDER, np.zeros_like(self.at.dx))
        for component, values in zip(of.components, u, strict=True):
            found = strains(self.at.interpolate(values), component, of.in_strains)
            strain |= {name: strain[name] + part for name, part in found.items()}
        # The volume strain enters with its projection onto linear functions.
        expansion = volume_strain(self.basis, of.in_strains, of.components)
        local = u[:, self.basis.element_dofs].reshape(-1, len(expansion))
        volume = volume_strain_at(self.basis, self.at, np.einsum("eip,ie->ep", expansion, local))
        pressing = dilatation(self.section).resistance[:, None] * volume
        mu = shear_moduli(self.section)[:, None]
        total = np.zeros((6, len(self.node)))
        for row, name in zip(total, ORDER, strict=True):
            stress = 2.0 * mu * strain[name] + pressing if name in NORMAL else mu * strain[name]
            np.add.at(row, self.cells.ravel(), (stress @ self.extrapolation.T).ravel())
        displacement = np.zeros((3, len(self.node)))
        displacement[list(of.components)] = u[:, self.node] * scales.length
        return Amplitude(of, displacement, total / self.share * scales.modulus, turned)


def recovery_of(section: SectionMesh) -> Recovery:
    """Create the stress recovery for the mesh of a body, for use with all angular harmonics.

    The recovery computes the stress at the nodes from the strains at the Gauss points of the
    elements.

    section  mesh of the meridional section of the body
    """
    xi, eta = (part.ravel() for part in np.meshgrid(GAUSS, GAUSS, indexing="ij"))
    basis = displacement_basis(section)
    at = displacement_basis(section, (np.stack([xi, eta]), np.full(4, 0.25)))
    count = len(section.outline.materials)
    key = basis.element_dofs.T * count + section.layer[:, None]
    unique, cells, share = np.unique(key, return_inverse=True, return_counts=True)
    return Recovery(
        section,
        basis,
        at,
        _extrapolation_matrix(np.asarray(ElementQuad2().doflocs, dtype=float)),
        cells.reshape(key.shape),
        unique // count,
        unique % count,
        share.astype(float),
    )


def _extrapolation_matrix(nodes: Field) -> Field:
    """Return the bilinear extrapolation from 2 x 2 Gauss points (first coordinate slowest)
    to the 9 nodes of an element, at positions (9, 2) in the unit square: (9, 4)."""
    low, high = GAUSS
    along = [np.stack([(high - c) / (high - low), (c - low) / (high - low)], -1) for c in nodes.T]
    return np.einsum("na,nb->nab", *along).reshape(len(nodes), 4)
