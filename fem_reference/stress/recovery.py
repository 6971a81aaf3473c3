"""Stress at the nodes, recovered from the elements.

Strains of biquadratic elements are most accurate at their 2 x 2 Gauss points (Barlow 1976). There
the stress is taken, extrapolated bilinearly to the nodes of the element, and averaged over the
elements of one material that meet at a node (Hinton and Campbell 1974). A node on an interface
keeps one value per material, so that the jump of the stress in the plane of the layers is not
smeared.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skfem import Basis, ElementQuad2, MeshQuad

from fem_reference.elasticity.motion import Motion
from fem_reference.elasticity.weak_form import (
    SectionBasis,
    dilatation,
    shear_moduli,
    strain_operator,
    volume_strain,
)
from fem_reference.mesh.section_mesh import SectionMesh
from fem_reference.scales import Scales
from fem_reference.stress.section_field import Amplitude

Field = NDArray[np.float64]
Indices = NDArray[np.int64]

# CONVENTIONS at theta = 0: rr, tt, zz, tz, rz, rt; from the order of `strain_operator`.
ORDER = (0, 1, 2, 5, 3, 4)
GAUSS = 0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)


@dataclass(frozen=True, eq=False)
class Recovery:
    """From the 2 x 2 points of the elements to points at the nodes, one for each material there.

    shapes         shape functions at the 2 x 2 points, as in `SectionBasis.shapes` (e, 3, 9, 4)
    linear         orthonormal linear functions there (e, 3, 4)
    extrapolation  (9, 4) from these points to the nodes of an element
    cells          (e, 9) points
    node           (n,) node of every point
    material       (n,)
    share          (n,) how many elements meet at a point
    """

    shapes: Field
    linear: Field
    extrapolation: Field
    cells: Indices
    node: Indices
    material: Indices
    share: Field


def recovery_of(section: SectionMesh, basis: SectionBasis) -> Recovery:
    """What recovers the stress on a section; the same for all its motions."""
    xi, eta = (part.ravel() for part in np.meshgrid(GAUSS, GAUSS, indexing="ij"))
    element = ElementQuad2()
    at = Basis(
        MeshQuad(section.points, section.quads),
        element,
        quadrature=(np.stack([xi, eta]), np.full(4, 0.25)),
    )
    r, z = np.asarray(at.global_coordinates())
    fields = [field[0] for field in at.basis]
    shapes = np.stack(
        [np.stack([np.broadcast_to(f, r.shape) / r, f.grad[0], f.grad[1]]) for f in fields]
    )
    middle = section.points[:, section.quads].mean(axis=1)[..., None]
    size = np.ptp(section.points[:, section.quads], axis=1)[..., None]
    linear = np.stack([np.ones_like(r), (r - middle[0]) / size[0], (z - middle[1]) / size[1]])
    weighted = basis.linear * basis.weights[:, None, :]
    gram = np.linalg.cholesky(weighted @ basis.linear.transpose(0, 2, 1))
    count = len(section.outline.materials)
    key = basis.elements * count + section.layer[:, None]
    unique, cells, share = np.unique(key, return_inverse=True, return_counts=True)
    return Recovery(
        shapes.transpose(2, 1, 0, 3),
        np.linalg.solve(gram, linear.transpose(1, 0, 2)),
        _extrapolation(np.asarray(element.doflocs, dtype=float)),
        cells.reshape(key.shape),
        unique // count,
        unique % count,
        share.astype(float),
    )


def _extrapolation(nodes: Field) -> Field:
    """(9, 4) bilinear functions of the 2 x 2 points, first coordinate slowest, at the nodes."""
    low, high = GAUSS
    along = [np.stack([(high - c) / (high - low), (c - low) / (high - low)], -1) for c in nodes.T]
    return np.einsum("na,nb->nab", *along).reshape(len(nodes), 4)


def recovered_amplitude(
    section: SectionMesh,
    basis: SectionBasis,
    recovery: Recovery,
    of: Motion,
    u: Field,
    scales: Scales,
) -> Amplitude:
    """Fields of one motion from the displacement of the nodes (c, nodes)."""
    local = u[:, basis.elements]
    gradients = np.einsum("ednq,cen->cdeq", recovery.shapes, local)
    strain = np.einsum(
        "scd,cdeq->seq", strain_operator(of.harmonic)[:, of.components, :], gradients
    )
    stress = np.array([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])[:, None, None] * strain
    stress *= shear_moduli(section)[:, None]
    # The volume strain resists as its projection onto linear functions does.
    expansion = volume_strain(basis, of.harmonic, of.components)
    flat = local.transpose(1, 0, 2).reshape(len(basis.elements), -1, 1)
    volume = np.einsum("ep,epq->eq", (expansion @ flat)[..., 0], recovery.linear)
    stress[:3] += dilatation(section).resistance[:, None] * volume
    at_nodes = stress @ recovery.extrapolation.T
    total = np.zeros((6, len(recovery.node)))
    for component, values in zip(total, at_nodes[list(ORDER)], strict=True):
        np.add.at(component, recovery.cells.ravel(), values.ravel())
    displacement = np.zeros((3, len(recovery.node)))
    displacement[list(of.components)] = u[:, recovery.node] * scales.length
    return Amplitude(of, displacement, total / recovery.share * scales.modulus)
