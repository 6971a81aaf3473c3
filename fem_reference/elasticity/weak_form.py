"""The weak form of elasticity in a section, for one angular harmonic.

A load that goes as cos n theta (r and z components) and sin n theta (theta) moves the body in the
same way, so the angle is integrated out and n enters the strains as a number:

    e_rr = u_r,r              g_rz = u_r,z + u_z,r
    e_tt = (u_r + n u_t)/r    g_rt = u_t,r - (u_t + n u_r)/r
    e_zz = u_z,z              g_tz = u_t,z - n u_z/r

Forms are of one component of each displacement, `w.trial` and `w.test`, in the harmonic `w.n`, and
integrate over r dr dz (see `section_basis`). All of a vector element at once would take the
products with the components that are zero as well: three times the time.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skfem import Basis, BilinearForm

from fem_reference.elasticity.section_basis import pressure_basis
from fem_reference.mesh.section_mesh import SectionMesh

Field = NDArray[np.float64]
Components = tuple[int, ...]
"""Which of u_r (0), u_theta (1) and u_z (2) take part."""

STIFFEST = 1e4
"""Largest lambda / mu of an element whose pressure is no unknown."""

NORMAL, SHEAR = ("rr", "tt", "zz"), ("rz", "rt", "tz")


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


@BilinearForm  # type: ignore[untyped-decorator]
def distortion(u: Any, v: Any, w: Any) -> Any:
    """2 mu e : e, the energy without the resistance to a change of volume."""
    e, f = strains(u, w.trial, w.n), strains(v, w.test, w.n)
    normal = sum(e[k] * f[k] for k in NORMAL if k in e and k in f)
    return w.mu * (2.0 * normal + sum(e[k] * f[k] for k in SHEAR if k in e and k in f))


@BilinearForm  # type: ignore[untyped-decorator]
def expansion(u: Any, q: Any, w: Any) -> Any:
    """q tr e, the work of a pressure."""
    e = strains(u, w.trial, w.n)
    return q * sum(e[k] for k in NORMAL if k in e)


@BilinearForm  # type: ignore[untyped-decorator]
def product(p: Any, q: Any, _: Any) -> Any:
    """p q."""
    return p * q


def element_stiffness(
    basis: Basis, section: SectionMesh, harmonic: int, components: Components
) -> Field:
    """(9 c, 9 c, e) stiffness of every element, component by component.

    The volume strain is projected onto functions linear in an element (Q2-P1), in every material:
    that keeps nearly incompressible layers from locking, and is exact for quadratic displacements.
    Where `dilatation` says so, the resistance to it is left out: there the pressure is an unknown.
    """
    c = len(components)
    stiffness = np.empty((c, 9, c, 9, basis.nelems))
    by_volume = volume_strain(basis, harmonic, components).reshape(c, 9, 3, -1)
    mu, resistance = shear_moduli(section)[:, None], dilatation(section).resistance
    for k, trial in enumerate(components):
        for m, test in enumerate(components[: k + 1]):
            block = _local(distortion, basis, basis, n=harmonic, trial=trial, test=test, mu=mu)
            block += np.einsum("ipe,jpe->ije", resistance * by_volume[k], by_volume[m])
            stiffness[k, :, m] = block
            stiffness[m, :, k] = block.transpose(1, 0, 2)
    return stiffness.reshape(9 * c, 9 * c, -1)


def volume_strain(basis: Basis, harmonic: int, components: Components) -> Field:
    """(9 c, 3, e) projections of the volume strain onto linear functions, orthonormal in every
    element."""
    pressure = pressure_basis(basis)
    moments = [_local(expansion, basis, pressure, n=harmonic, trial=k) for k in components]
    return _orthonormal(pressure, np.concatenate(moments).T).T


def volume_strain_at(basis: Basis, points: Basis, strain: Field) -> Field:
    """(e, q) the volume strain of projections (3, e), at the points of another basis."""
    linear = np.stack([np.asarray(field[0]) for field in pressure_basis(points).basis])
    functions = _orthonormal(pressure_basis(basis), linear.transpose(1, 0, 2))
    return np.einsum("pe,epq->eq", strain, functions)


def _orthonormal(pressure: Basis, linear: Field) -> Field:
    """(e, 3, ...) what linear functions become that are made orthonormal in their element."""
    gram = _local(product, pressure, pressure).transpose(2, 0, 1)
    return np.asarray(np.linalg.solve(np.linalg.cholesky(gram), linear))


def _local(form: BilinearForm, of: Basis, on: Basis, **parameters: Any) -> Field:
    """(trial functions, test functions, e) of every element."""
    found = form.elemental(of, on, **parameters).data
    return np.asarray(found.reshape(of.Nbfun, on.Nbfun, -1))


@dataclass(frozen=True, eq=False)
class Dilatation:
    """How elements resist a change of volume; lambda = 2 mu nu / (1 - 2 nu), infinite at nu = 1/2.

    resistance   (e,) lambda; 0 where the pressure is an unknown
    mixed        (e,) whether it is: so large a lambda would drown the shear in round-off
    compliance   (e,) 1 / lambda where the pressure is an unknown, else 0
    """

    resistance: Field
    mixed: NDArray[np.bool_]
    compliance: Field


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


def shear_moduli(section: SectionMesh) -> Field:
    """(e,) mu of every element."""
    return np.array([m.shear_modulus for m in section.outline.materials])[section.layer]
