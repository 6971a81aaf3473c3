"""Tests of the finite-element elasticity: exact solutions are reproduced on any mesh."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_scene import (
    RIGID,
    Body,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Scene,
    Sphere,
)
from contact_scene.solver_errors import SolverError, UnsupportedScene
from fem_reference.elasticity.hat_functions import hats_on
from fem_reference.elasticity.section_basis import displacement_basis
from fem_reference.elasticity.weak_form import dilatation, element_stiffness
from fem_reference.mesh.gmsh_mesh import gmsh_section_mesh
from fem_reference.mesh.section_mesh import SectionMesh, section_mesh
from slipstick import solve, stated_errors

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


RIGID_MOTIONS = {
    "along z": (0, PLANE, lambda r, z: (0, 0, 1)),
    "about z": (0, ANGULAR, lambda r, z: (0, r, 0)),
    "along x": (1, ALL, lambda r, z: (1, -1, 0)),
    "about y": (1, ALL, lambda r, z: (z, -z, -r)),
}


@pytest.mark.parametrize("motion", RIGID_MOTIONS.values(), ids=RIGID_MOTIONS)
def test_rigid_motions_carry_no_stress(rng, motion):
    _, _, forces = nodal_forces(distorted_section(rng), *motion)
    assert np.abs(forces).max() < 1e-12 * R


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


@pytest.mark.parametrize("nu", [-0.9, 0.3, 0.49999, 0.5])
@pytest.mark.parametrize(("harmonic", "components"), [(0, PLANE), (0, ANGULAR), (1, ALL), (5, ALL)])
def test_stiffness_is_symmetric_and_never_negative(rng, nu, harmonic, components):
    section = distorted_section(rng, nu)
    basis = displacement_basis(section)
    elements = element_stiffness(basis, section, harmonic, components)
    largest = np.abs(elements).max(axis=(1, 2))
    assert np.all(np.abs(elements - elements.transpose(0, 2, 1)).max(axis=(1, 2)) < 1e-13 * largest)
    assert np.all(np.linalg.eigvalsh(elements)[:, 0] > -1e-12 * largest)


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


# ---- Hat functions over the radius: their integrals are those of the plane they cover.


@st.composite
def nodes(draw):
    """Corners of unequal elements, midsides between."""
    widths = draw(st.lists(st.floats(0.1, 3.0), min_size=1, max_size=8))
    corners = np.concatenate([[0.0], np.cumsum(widths)])
    middle = 0.5 * (corners[1:] + corners[:-1])
    return np.sort(np.concatenate([corners, middle]))


@given(nodes())
def test_uniform_traction_carries_area_and_moment(radii) -> None:
    hats, R = hats_on(radii), radii[-1]
    assert 2 * pi * hats.weights.sum() == pytest.approx(pi * R**2)
    assert 2 * pi * hats.arms.sum() == pytest.approx(2 * pi * R**3 / 3)


@given(nodes(), st.lists(st.floats(-2, 2), min_size=3, max_size=3))
def test_forces_of_a_linear_traction_do_the_work_of_the_tractions(radii, parabola) -> None:
    """∫ u t r dr for u quadratic and t linear, by nodal forces and in closed form."""
    hats = hats_on(radii)
    u = np.polynomial.Polynomial(parabola)
    t = np.polynomial.Polynomial([0.7, -0.3])
    exact = (u * t * np.polynomial.Polynomial([0, 1])).integ()(radii[-1])
    assert u(radii) @ hats.products @ t(hats.radii) == pytest.approx(exact, abs=1e-9)


@given(nodes())
def test_gap_over_hats_adds_up_to_the_volume(radii) -> None:
    hats, R = hats_on(radii), radii[-1]
    assert 2 * pi * hats.integrate(lambda r: r**2 / 2).sum() == pytest.approx(pi * R**4 / 4)


@given(nodes(), st.data())
def test_no_hat_reaches_beyond_a_rim(radii, data) -> None:
    """A hat at the rim is half a hat, so the area carried is that within the rim."""
    rim = data.draw(st.sampled_from(list(radii[2::2])))
    hats = hats_on(radii, rim)
    assert hats.radii[-1] == rim
    assert 2 * pi * hats.weights.sum() == pytest.approx(pi * rim**2)


@given(nodes(), st.integers(0, 2**32 - 1))
def test_compliance_stays_symmetric_and_positive(radii, seed) -> None:
    B = np.random.default_rng(seed).normal(size=(len(radii), len(radii)))
    weak = hats_on(radii).compliance(B @ B.T)
    assert np.allclose(weak, weak.T, rtol=1e-12, atol=1e-12 * np.abs(weak).max())
    assert np.linalg.eigvalsh(weak).min() > -1e-9 * np.abs(weak).max()


# ---- Both meshers fill the section they are given.


SOFT = IsotropicMaterial(young_modulus=1.0, poisson_ratio=0.3)
HARD = IsotropicMaterial(young_modulus=3.0, poisson_ratio=0.2)


def stack(*thicknesses, base=SOFT):
    layers = tuple(
        Layer(thickness=t, material=(HARD, SOFT)[i % 2]) for i, t in enumerate(thicknesses)
    )
    return Body(material=base, layers=layers)


BODIES = {
    "half-space": stack(),
    "coated": stack(1.0),
    "thin": stack(0.01),
    "thin under thick": stack(3.0, 0.02, 0.3),
    "rigid base": stack(0.5, base=RIGID),
}


@pytest.fixture(name="gmsh")
def loaded_gmsh():
    try:
        import gmsh
    except (ImportError, OSError) as error:
        pytest.skip(f"gmsh cannot be loaded: {error}")
    return gmsh


@pytest.fixture(params=["tensor", "gmsh"])
def mesher(request):
    if request.param == "tensor":
        return section_mesh
    request.getfixturevalue("gmsh")
    return gmsh_section_mesh


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_no_element_crosses_an_interface(mesher, body):
    section = mesher(body, 8)
    top, base = np.array(section.outline.pieces).T
    depth = section.points[1, section.quads]
    assert np.all(depth >= top[section.layer])
    assert np.all(depth <= base[section.layer])
    assert np.array_equal(np.unique(section.layer), np.arange(len(section.outline.materials)))


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_a_refined_mesh_is_nested(mesher, body):
    coarse = mesher(body, 4)
    fine = coarse.refined()
    assert fine.quads.shape[1] == 4 * coarse.quads.shape[1]
    assert np.array_equal(fine.radii[::2], coarse.radii)
    corners = {tuple(point) for point in fine.points.T}
    assert all(tuple(point) in corners for point in coarse.points.T)
    assert fine.outline.size == coarse.outline.size / 2


@pytest.mark.parametrize(
    ("body", "arguments", "error", "message"),
    [
        (stack(), {"elements_per_radius": 1}, ValueError, "at least 2"),
        (stack(), {"elements_per_radius": 8, "box": 1.5}, SolverError, "larger box"),
        (stack(), {"elements_per_radius": 8, "box": np.inf}, SolverError, "larger box"),
        (stack(20.0), {"elements_per_radius": 8, "box": 10.0}, SolverError, "larger box"),
        (stack(1e-9), {"elements_per_radius": 8}, UnsupportedScene, "Remove it"),
        (stack(2e6), {"elements_per_radius": 8}, UnsupportedScene, "substrate has no effect"),
    ],
)
def test_sizes_that_make_no_mesh_are_refused(mesher, body, arguments, error, message):
    with pytest.raises(error, match=message):
        mesher(body, **arguments)


@pytest.mark.usefixtures("gmsh")
def test_both_meshers_agree_within_the_stated_errors() -> None:
    scene = Scene(
        title="ball on a coating",
        indenter=Sphere(radius=18e-3, material=RIGID),
        body=Body(
            material=IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3),
            layers=(
                Layer(
                    thickness=4e-4,
                    material=IsotropicMaterial(young_modulus=420e9, poisson_ratio=0.3),
                ),
            ),
        ),
        loading=(LoadStep(normal_force=1e3),),
    )
    tensor, other = (
        solve(
            scene,
            solver="fem",
            discretisation=FiniteElementDiscretisation(elements_per_radius=12, mesher=mesher),
        )
        for mesher in ("tensor", "gmsh")
    )
    errors = stated_errors(tensor).steps[-1]
    for name in ("approach", "peak_pressure", "contact_radius"):
        difference = getattr(tensor.steps[-1], name) - getattr(other.steps[-1], name)
        assert 0 < abs(difference) < errors[name].error, name
