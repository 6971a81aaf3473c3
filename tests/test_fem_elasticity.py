"""Tests of the finite-element elasticity: exact solutions are reproduced on any mesh."""

import numpy as np
import pytest

from contact_scene import (
    Body,
    IsotropicMaterial,
)
from fem_reference.elasticity.section_basis import displacement_basis
from fem_reference.elasticity.weak_form import dilatation, element_stiffness
from fem_reference.mesh.section_mesh import SectionMesh, section_mesh

R = 10.0
ALL = (0, 1, 2)
PLANE = (0, 2)
ANGULAR = (1,)


def distorted_section(rng, poisson_ratio=0.3):
    """A homogeneous square of quadrilaterals, none of them a rectangle."""
    material = IsotropicMaterial(young_modulus=1.0, poisson_ratio=poisson_ratio)
    section = section_mesh(Body(material=material), 2, box=R)
    points = section.points.copy()
    inside = np.all((points > 0) & (points < R), axis=0)
    gaps = [np.min(np.diff(np.unique(section.points[axis]))) for axis in (0, 1)]
    shift = rng.uniform(-0.3, 0.3, points.shape) * np.reshape(gaps, (2, 1))
    points[:, inside] += shift[:, inside]
    return SectionMesh(points, section.quads, section.outline)


def nodal(basis, components, field):
    """(c, n) values of u_r, u_theta, u_z at the nodes."""
    values = np.broadcast_arrays(*field(*basis.doflocs), basis.doflocs[0])[:3]
    return np.stack(values)[list(components)]


def nodal_forces(section, harmonic, components, field):
    """Nodes, nodal values and the forces that hold them."""
    basis = displacement_basis(section)
    values = nodal(basis, components, field)
    local = values[:, basis.element_dofs]
    elements = element_stiffness(basis, section, harmonic, components)
    forces = np.zeros_like(values)
    by_element = np.einsum("eij,je->ie", elements, local.reshape(-1, basis.nelems))
    np.add.at(forces, (slice(None), basis.element_dofs), by_element.reshape(local.shape))
    return basis.doflocs, values, forces


def equilibrium_fields(nu):
    """Quadratic fields free of body forces: harmonic, components, field, energy per E, R^4 or R^2
    and length: twice the strain energy over the factor pi or 2 pi of the angle."""
    G = 1 / (2 * (1 + nu))
    return {
        "tension": (0, PLANE, lambda r, z: (-nu * r, 0, z), R**2 / 2),
        "twisting": (0, ANGULAR, lambda r, z: (0, r * z, 0), G * R**4 / 4),
        "bending": (
            1,
            ALL,
            lambda r, z: (-(z**2 + nu * r**2) / 2, (z**2 - nu * r**2) / 2, r * z),
            R**4 / 4,
        ),
        "plane shear": (2, ALL, lambda r, z: (r, -r, 0), 4 * G * R**2),
        "warping": (2, ALL, lambda r, z: (2 * r * z, -2 * r * z, -(r**2)), None),
        "third harmonic": (3, ALL, lambda r, z: (r**2, -(r**2), 0), 8 * G * R**4),
    }


@pytest.mark.parametrize("nu", [-0.9, 0.0, 0.3, 0.499])
@pytest.mark.parametrize("name", equilibrium_fields(0.3))
def test_quadratic_fields_are_exact(rng, name, nu):
    harmonic, components, field, energy = equilibrium_fields(nu)[name]
    nodes, values, forces = nodal_forces(distorted_section(rng, nu), harmonic, components, field)
    r, z = nodes
    inside = (r > 0) & (r < R) & (z > 0) & (z < R)
    softening = min(1 + nu, 1 - 2 * nu)  # forces of elements are larger by its inverse, and cancel
    assert np.abs(forces[:, inside]).max() < 1e-13 * np.abs(forces).max() / softening
    if energy is not None:
        assert np.sum(values * forces) == pytest.approx(energy * R, rel=1e-11)


@pytest.mark.parametrize("nu", [-0.9, 0.0, 0.3, 0.4999, 0.49999, 0.5])
def test_resistance_to_volume_strain_is_lambda_or_an_unknown_pressure(rng, nu):
    """lambda = E nu / (1 + nu)(1 - 2 nu) or, where that is beyond 1e4 mu, its inverse."""
    resistance = dilatation(distorted_section(rng, nu))
    inverse = (1 + nu) * (1 - 2 * nu)
    if nu > 0.49995:
        assert np.all(resistance.mixed)
        assert not np.any(resistance.resistance)
        assert resistance.compliance == pytest.approx(inverse / nu, rel=1e-9)
    else:
        assert not np.any(resistance.mixed)
        assert not np.any(resistance.compliance)
        assert resistance.resistance == pytest.approx(nu / inverse, rel=1e-9)
