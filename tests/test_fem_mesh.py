"""Tests of the finite-element meshes: interfaces, refinement, sizes and both meshers."""

import numpy as np
import pytest
from contact_scenes import PRESS, RIGID_BALL, scene, steel

from contact_scene import (
    RIGID,
    Body,
    FiniteElementDiscretisation,
    IsotropicMaterial,
    Layer,
)
from contact_scene.solver_errors import SolverError, UnsupportedScene
from fem_reference.mesh.gmsh_mesh import gmsh_section_mesh
from fem_reference.mesh.section_mesh import section_mesh
from slipstick import solve, stated_errors

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
def test_both_meshers_agree_within_the_stated_errors():
    film = Layer(thickness=4e-4, material=steel())
    body = Body(material=steel(young_modulus=210e9), layers=(film,))
    pressed = scene(PRESS, friction=None, indenter=RIGID_BALL, body=body)
    tensor, other = (
        solve(
            pressed,
            solver="fem",
            discretisation=FiniteElementDiscretisation(elements_per_radius=12, mesher=mesher),
        )
        for mesher in ("tensor", "gmsh")
    )
    errors = stated_errors(tensor).steps[-1]
    for name in ("approach", "peak_pressure", "contact_radius"):
        difference = getattr(tensor.steps[-1], name) - getattr(other.steps[-1], name)
        assert 0 < abs(difference) < errors[name].error, name
