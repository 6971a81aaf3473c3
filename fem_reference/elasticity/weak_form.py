"""Weak form of linear elasticity in the meridional section of a body, for one angular harmonic n.

A load ∝ cos n theta (r and z components) and sin n theta (theta component) causes displacements of
the same form. The angle is therefore integrated analytically, and n enters the strains as a number:

    e_rr = u_r,r              g_rz = u_r,z + u_z,r
    e_tt = (u_r + n u_t)/r    g_rt = u_t,r - (u_t + n u_r)/r
    e_zz = u_z,z              g_tz = u_t,z - n u_z/r

Energies are integrals over r dr dz (see `section_basis`). The stiffness of each element is one
matrix product of its strains. A scikit-fem form for each pair of components would take 4 times the
time.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skfem import Basis

from contact_scene.array_types import Field
from fem_reference.mesh.element_order import ELEMENTS
from fem_reference.mesh.section_mesh import SectionMesh

Components = tuple[int, ...]
"""Indices of the displacement components in a motion: u_r (0), u_theta (1), u_z (2)."""

STIFFEST = 1e4
"""Largest ratio lambda / mu of Lamé's constants for which the pressure is not an unknown."""

NORMAL = ("rr", "tt", "zz")


def strains(u: Any, component: int, n: int) -> dict[str, Field]:
    """Compute the strains that one displacement component of the angular harmonic n causes.

    The result maps the names rr, tt, zz, rz, rt and tz to the strain at the quadrature points.
    Shear strains are engineering strains. Strains that the component does not cause are absent.

    u          scikit-fem field of the component whose `grad` contains u/r and the derivatives of u
               by r and z
    component  0 for u_r, 1 for u_theta, 2 for u_z
    n          angular harmonic, 0 for axisymmetric displacements
    """
    over_r, along_r, along_z = u.grad
    found = (
        {"rr": along_r, "tt": over_r, "rz": along_z},
        {"rt": along_r - over_r, "tz": along_z},
        {"zz": along_z, "rz": along_r},
    )[component]
    if n > 0:
        name, sign = (("rt", -n), ("tt", n), ("tz", -n))[component]
        found[name] = sign * over_r
    return found


def element_stiffness(
    basis: Basis, section: SectionMesh, harmonic: int, components: Components
) -> Field:
    """Compute the stiffness matrices of all elements, shape (e, m c, m c).

    There are c components, and m nodes of an element. The nodal values of a component are
    contiguous. The volume strain is projected onto the pressure functions of the element (Q2-P1 for
    biquadratic elements) in every material. This projection prevents locking of nearly
    incompressible layers and is exact for displacements of the degree of the elements. Nearly
    incompressible elements have no resistance to volume strain in this matrix, because their
    pressure is a separate unknown.

    basis       finite-element basis of one displacement component
    section     mesh with the materials of the elements
    harmonic    angular harmonic n
    components  indices of the components in the motion: u_r (0), u_theta (1), u_z (2)
    """
    strain = _strains_of(basis, harmonic, components)
    volume = _project_volume(basis, strain)
    # An engineering shear strain g = 2 e occurs in two entries of e, so that the energy
    # 2 mu e : e contains mu g^2.
    weight = np.sqrt(shear_moduli(section)[:, None] * basis.dx)[:, None]
    for name, field in strain.items():
        field *= np.sqrt(2.0) * weight if name in NORMAL else weight
    root = np.concatenate(list(strain.values()), axis=2)
    stiffness = root @ root.transpose(0, 2, 1)
    resistance = dilatation(section).resistance[:, None, None]
    stiffness += (resistance * volume) @ volume.transpose(0, 2, 1)
    return np.asarray(stiffness)


def volume_strain(basis: Basis, harmonic: int, components: Components) -> Field:
    """Compute the volume strain of the shape functions, as a polynomial in each element.

    The result (e, m c, f) contains the coefficients of f orthonormal pressure functions, for each
    of the m shape functions of each of the c components. The projection onto these functions
    prevents locking of nearly incompressible materials.

    basis       finite-element basis of one displacement component
    harmonic    angular harmonic n
    components  indices of the components in the motion: u_r (0), u_theta (1), u_z (2)
    """
    return _project_volume(basis, _strains_of(basis, harmonic, components))


def volume_strain_at(basis: Basis, points: Basis, strain: Field) -> Field:
    """Evaluate the volume strain of the elements at given points in each element (e, q).

    The volume strain is stored as a polynomial in each element. Used to recover the stress at
    points other than those of the stiffness.

    basis   displacement basis with which the volume strain was projected
    points  displacement basis at whose q quadrature points the strain is evaluated
    strain  coefficients of the f orthonormal pressure functions of each element (e, f)
    """
    return np.einsum(
        "ep,epq->eq", strain, _orthonormal_functions(basis, _pressure_functions(points))
    )


def _strains_of(basis: Basis, harmonic: int, components: Components) -> dict[str, Field]:
    """Map each strain, such as "rr", to its values for all shape functions (e, m c, q).

    There are c displacement components and q quadrature points. The m shape functions of a
    component are contiguous.
    """
    elements, points = basis.dx.shape
    found: dict[str, Field] = {}
    for k, component in enumerate(components):
        for i, (u,) in enumerate(basis.basis, start=k * basis.Nbfun):
            for name, field in strains(u, component, harmonic).items():
                if name not in found:
                    found[name] = np.zeros((elements, len(components) * basis.Nbfun, points))
                found[name][:, i] = field
    return found


def _project_volume(basis: Basis, strain: dict[str, Field]) -> Field:
    """Compute projections of volume strains onto f orthonormal pressure functions of an
    element (e, m c, f), which prevents locking of nearly incompressible materials."""
    volume = sum(strain[name] for name in NORMAL if name in strain) * basis.dx[:, None]
    return np.asarray(
        volume @ _orthonormal_functions(basis, _pressure_functions(basis)).transpose(0, 2, 1)
    )


def _pressure_functions(basis: Basis) -> Field:
    """Evaluate products of powers of r and z (e, f, q) at quadrature points, from the middle of the
    element in its size. The polynomials of scikit-fem have other products on quadrilaterals."""
    points, corners = basis.global_coordinates(), basis.mesh.p[:, basis.mesh.t]
    middle, size = corners.mean(axis=1), np.ptp(corners, axis=1)
    r, z = (points - middle[..., None]) / size[..., None]
    return np.stack([r**i * z**j for i, j in ELEMENTS.pressures], axis=1)


def _orthonormal_functions(basis: Basis, values: Field) -> Field:
    """Transform pressure functions at q points to orthonormal ones with the weight r (e, f, q)."""
    functions = _pressure_functions(basis)
    gram = (functions * basis.dx[:, None]) @ functions.transpose(0, 2, 1)
    return np.asarray(np.linalg.solve(np.linalg.cholesky(gram), values))


@dataclass(frozen=True, eq=False)
class Dilatation:
    """Resistance of every element to a change of volume, in terms of Lamé's constant lambda.

    lambda = 2 mu nu / (1 - 2 nu), with the shear modulus mu and Poisson's ratio nu, is infinite at
    nu = 1/2. If lambda is much larger than mu, the pressure becomes an unknown, because the shear
    stiffness would be lost in round-off.

    resistance  lambda (e,), in units of the moduli; 0 if the pressure is an unknown
    mixed       True for elements whose pressure is an unknown (e,)
    compliance  1 / lambda (e,) if the pressure is an unknown, else 0
    """

    resistance: Field
    mixed: NDArray[np.bool_]
    compliance: Field


def dilatation(section: SectionMesh) -> Dilatation:
    """Compute the resistance of every element of a mesh to a change of volume.

    The result also marks the nearly incompressible elements, whose pressure is a separate unknown.

    section  mesh with the materials of the elements
    """
    nu = np.array([m.poisson_ratio for m in section.outline.materials])[section.layer]
    softness = (1.0 - 2.0 * nu) / (2.0 * shear_moduli(section))  # nu / lambda
    mixed = 2.0 * nu > STIFFEST * (1.0 - 2.0 * nu)
    none = np.zeros_like(nu)
    return Dilatation(
        np.divide(nu, softness, out=none.copy(), where=~mixed),
        mixed,
        np.divide(softness, nu, out=none.copy(), where=mixed),
    )


def shear_moduli(section: SectionMesh) -> Field:
    """Return the shear modulus mu of every element of a mesh, that of its layer (e,).

    section  mesh with the materials of the layers
    """
    return np.array([m.shear_modulus for m in section.outline.materials])[section.layer]
