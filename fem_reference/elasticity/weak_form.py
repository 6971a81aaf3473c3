"""Weak form of elasticity in a section, for one angular harmonic.

A load ∝ cos n theta (r and z components) and sin n theta (theta) causes displacements of this form,
so the angle is integrated analytically and n enters the strains as a number:

    e_rr = u_r,r              g_rz = u_r,z + u_z,r
    e_tt = (u_r + n u_t)/r    g_rt = u_t,r - (u_t + n u_r)/r
    e_zz = u_z,z              g_tz = u_t,z - n u_z/r

Energies are integrals over r dr dz (see `section_basis`). Every element has one product of matrices
of its strains: a scikit-fem form for each pair of components would take four times the time.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skfem import Basis

from contact_scene.array_types import Field
from fem_reference.elasticity.section_basis import pressure_basis
from fem_reference.mesh.section_mesh import SectionMesh

Components = tuple[int, ...]
"""Which of u_r (0), u_theta (1) and u_z (2) take part."""

STIFFEST = 1e4
"""Largest lambda / mu of an element whose pressure is no unknown."""

NORMAL = ("rr", "tt", "zz")


def strains(u: Any, component: int, n: int) -> dict[str, Field]:
    """The strains that one component of a displacement has a part in."""
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
    """Compute the stiffness (e, 9 c, 9 c) of every element, component by component.

    The volume strain is projected onto linear functions of an element (Q2-P1) in every material.
    This prevents locking of nearly incompressible layers and is exact for quadratic displacements.
    Mixed elements of `dilatation` have no resistance to it: there the pressure is an unknown.
    """
    strain = _strains_of(basis, harmonic, components)
    volume = _projected_volume(basis, strain)
    # The distortional energy 2 mu e : e contains the shear g = 2 e of two entries once.
    weight = np.sqrt(shear_moduli(section)[:, None] * basis.dx)[:, None]
    for name, field in strain.items():
        field *= np.sqrt(2.0) * weight if name in NORMAL else weight
    root = np.concatenate(list(strain.values()), axis=2)
    stiffness = root @ root.transpose(0, 2, 1)
    resistance = dilatation(section).resistance[:, None, None]
    stiffness += (resistance * volume) @ volume.transpose(0, 2, 1)
    return np.asarray(stiffness)


def volume_strain(basis: Basis, harmonic: int, components: Components) -> Field:
    """Compute projections (e, 9 c, 3) of the volume strain onto orthonormal linear functions."""
    return _projected_volume(basis, _strains_of(basis, harmonic, components))


def volume_strain_at(basis: Basis, points: Basis, strain: Field) -> Field:
    """Evaluate the volume strain (e, q) of projections (e, 3), at the points of another basis."""
    return np.einsum("ep,epq->eq", strain, _orthonormal(basis, _linear(points)))


def _strains_of(basis: Basis, harmonic: int, components: Components) -> dict[str, Field]:
    """Compute strains (e, 9 c, q) of every element's functions, component by component."""
    elements, points = basis.dx.shape
    found: dict[str, Field] = {}
    for k, component in enumerate(components):
        for i, (u,) in enumerate(basis.basis, start=k * basis.Nbfun):
            for name, field in strains(u, component, harmonic).items():
                if name not in found:
                    found[name] = np.zeros((elements, len(components) * basis.Nbfun, points))
                found[name][:, i] = field
    return found


def _projected_volume(basis: Basis, strain: dict[str, Field]) -> Field:
    volume = sum(strain[name] for name in NORMAL if name in strain) * basis.dx[:, None]
    return np.asarray(volume @ _orthonormal(basis, _linear(basis)).transpose(0, 2, 1))


def _linear(basis: Basis) -> Field:
    """Return the functions of the pressure (e, 3, q)."""
    return np.stack([np.asarray(field[0]) for field in pressure_basis(basis).basis], axis=1)


def _orthonormal(basis: Basis, linear: Field) -> Field:
    """Return linear functions (e, 3, q), orthonormal in their element."""
    functions = _linear(basis)
    gram = (functions * basis.dx[:, None]) @ functions.transpose(0, 2, 1)
    return np.asarray(np.linalg.solve(np.linalg.cholesky(gram), linear))


@dataclass(frozen=True, eq=False)
class Dilatation:
    """Resistance to change of volume; lambda = 2 mu nu / (1 - 2 nu), infinite at nu = 1/2.

    resistance  (e,) lambda; 0 if the pressure is an unknown
    mixed       (e,) true if it is an unknown: with a large lambda the shear stiffness is round-off
    compliance  (e,) 1 / lambda if the pressure is an unknown, else 0
    """

    resistance: Field
    mixed: NDArray[np.bool_]
    compliance: Field


def dilatation(section: SectionMesh) -> Dilatation:
    """Compute the resistance to volume strain of every element."""
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
    """Return mu of every element (e,)."""
    return np.array([m.shear_modulus for m in section.outline.materials])[section.layer]
