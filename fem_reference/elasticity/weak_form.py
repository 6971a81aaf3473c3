"""Stiffness of a section for one angular harmonic.

A load that goes as cos n theta (r and z components) and sin n theta (theta) moves the body in the
same way, so the angle is integrated out and n enters the strains as a number:

    e_rr = u_r,r              g_rz = u_r,z + u_z,r
    e_tt = (u_r + n u_t)/r    g_rt = u_t,r - (u_t + n u_r)/r
    e_zz = u_z,z              g_tz = u_t,z - n u_z/r

Energies carry the weight r alone; the factors 2 pi and pi of the angle belong to the resultants.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from skfem import Basis, ElementQuad2, MeshQuad

from fem_reference.mesh.section_mesh import SectionMesh

Components = tuple[int, ...]
"""Which of u_r (0), u_theta (1) and u_z (2) take part."""

RADIAL_AND_NORMAL: Components = (0, 2)
TORSION: Components = (1,)
ALL_THREE: Components = (0, 1, 2)

STIFFEST = 1e4
"""Largest lambda / mu of an element whose pressure is no unknown."""

# Strains in the order rr, tt, zz, rz, rt, tz; axes: strain, component, (u/r, u_,r, u_,z).
_FIXED = np.zeros((6, 3, 3))
_FIXED[0, 0, 1] = _FIXED[1, 0, 0] = _FIXED[2, 2, 2] = 1.0
_FIXED[3, 0, 2] = _FIXED[3, 2, 1] = 1.0
_FIXED[4, 1, 1] = _FIXED[5, 1, 2] = 1.0
_FIXED[4, 1, 0] = -1.0
_PER_HARMONIC = np.zeros((6, 3, 3))
_PER_HARMONIC[1, 1, 0] = 1.0
_PER_HARMONIC[4, 0, 0] = _PER_HARMONIC[5, 2, 0] = -1.0
_SHEAR_ENERGY = np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])


@dataclass(frozen=True, eq=False)
class SectionBasis:
    """Biquadratic shape functions on a section, at the Gauss points.

    nodes     (2, n) positions (r, z) of the nodes
    elements  (e, 9) nodes of an element
    shapes    (e, 27, q) u/r, u_,r, u_,z (first nine, second nine, ...) of the shape functions
    linear    (e, 3, q) linear functions of r and z, for the pressure
    weights   (e, q) of the integral of r dr dz
    """

    nodes: NDArray[np.float64]
    elements: NDArray[np.int64]
    shapes: NDArray[np.float64]
    linear: NDArray[np.float64]
    weights: NDArray[np.float64]


def section_basis(section: SectionMesh) -> SectionBasis:
    """Shape functions at 3 x 3 Gauss points, which integrate every energy below exactly."""
    basis = Basis(MeshQuad(section.points, section.quads), ElementQuad2(), intorder=5)
    r, z = np.asarray(basis.global_coordinates())
    fields = [field[0] for field in basis.basis]
    shapes = np.stack(
        [np.stack([np.broadcast_to(f, r.shape) / r, f.grad[0], f.grad[1]]) for f in fields]
    )
    middle = section.points[:, section.quads].mean(axis=1)[..., None]
    size = np.ptp(section.points[:, section.quads], axis=1)[..., None]
    linear = np.stack([np.ones_like(r), (r - middle[0]) / size[0], (z - middle[1]) / size[1]])
    return SectionBasis(
        np.asarray(basis.doflocs),
        np.asarray(basis.element_dofs.T, dtype=np.int64),
        np.ascontiguousarray(shapes.transpose(2, 1, 0, 3).reshape(r.shape[0], 27, -1)),
        np.ascontiguousarray(linear.transpose(1, 0, 2)),
        basis.dx * r,
    )


def strain_operator(harmonic: int) -> NDArray[np.float64]:
    """(6, 3, 3) strains by component and by (u/r, u_,r, u_,z): linear in the harmonic."""
    return _FIXED + harmonic * _PER_HARMONIC


def element_stiffness(
    basis: SectionBasis, section: SectionMesh, harmonic: int, components: Components
) -> NDArray[np.float64]:
    """(e, 9 c, 9 c) stiffness of every element, component by component.

    The volume strain is projected onto functions linear in an element (Q2-P1), in every material:
    that keeps nearly incompressible layers from locking, and is exact for quadratic displacements.
    Where `dilatation` says so, the resistance to it is left out: there the pressure is an unknown.
    """
    c, e = len(components), basis.elements.shape[0]
    strain = strain_operator(harmonic)[:, components, :]
    pairs = (basis.shapes * basis.weights[:, None, :]) @ basis.shapes.transpose(0, 2, 1)
    pairs = pairs.reshape(e, 3, 9, 3, 9)
    coefficients = np.einsum("sci,st,tdj->cidj", strain, _SHEAR_ENERGY, strain)
    stiffness = np.zeros((e, c, 9, c, 9))
    for k, i, m, j in np.argwhere(coefficients):
        stiffness[:, k, :, m, :] += coefficients[k, i, m, j] * pairs[:, i, :, j, :]
    stiffness *= shear_moduli(section)[:, None, None, None, None]

    expansion = volume_strain(basis, harmonic, components)
    volumetric = expansion.transpose(0, 2, 1) @ expansion
    resistance = dilatation(section).resistance[:, None, None]
    return stiffness.reshape(e, 9 * c, 9 * c) + resistance * volumetric


def volume_strain(
    basis: SectionBasis, harmonic: int, components: Components
) -> NDArray[np.float64]:
    """(e, 3, 9 c) projections of the volume strain onto three orthonormal linear functions."""
    trace = strain_operator(harmonic)[:3, components, :].sum(axis=0)
    weighted = basis.linear * basis.weights[:, None, :]
    moments = (weighted @ basis.shapes.transpose(0, 2, 1)).reshape(-1, 3, 3, 9)
    expansion = np.einsum("ci,epin->epcn", trace, moments).reshape(moments.shape[0], 3, -1)
    gram = np.linalg.cholesky(weighted @ basis.linear.transpose(0, 2, 1))
    return np.linalg.solve(gram, expansion)


@dataclass(frozen=True, eq=False)
class Dilatation:
    """How elements resist a change of volume; lambda = 2 mu nu / (1 - 2 nu), infinite at nu = 1/2.

    resistance   (e,) lambda; 0 where the pressure is an unknown
    mixed        (e,) whether it is: so large a lambda would drown the shear in round-off
    compliance   (e,) 1 / lambda where the pressure is an unknown, else 0
    """

    resistance: NDArray[np.float64]
    mixed: NDArray[np.bool_]
    compliance: NDArray[np.float64]


def dilatation(section: SectionMesh) -> Dilatation:
    """Resistance to volume strain of every element."""
    nu = np.array([m.poisson_ratio for m in section.outline.materials])[section.layer]
    softness = (1.0 - 2.0 * nu) / (2.0 * shear_moduli(section))  # nu / lambda
    mixed = 2.0 * nu > STIFFEST * (1.0 - 2.0 * nu)
    none = np.zeros_like(nu)
    return Dilatation(
        np.divide(nu, softness, out=none.copy(), where=~mixed),
        mixed,
        np.divide(softness, nu, out=none.copy(), where=mixed),
    )


def shear_moduli(section: SectionMesh) -> NDArray[np.float64]:
    """(e,) mu of every element."""
    return np.array([m.shear_modulus for m in section.outline.materials])[section.layer]
