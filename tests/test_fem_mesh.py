"""Both meshers fill the section they are given."""

import builtins
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from contact_scene import RIGID, Body, IsotropicMaterial, Layer
from contact_scene.solver_errors import SolverError, UnsupportedScene
from fem_reference.mesh.gmsh_mesh import GmshMissing, gmsh_section_mesh
from fem_reference.mesh.section_mesh import SectionMesh, section_mesh
from fem_reference.mesh.section_outline import GROWTH

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


@given(
    st.lists(st.floats(1e-3, 30.0), max_size=4),
    st.integers(4, 24),
    st.sampled_from([SOFT, RIGID]),
)
def test_neighbouring_elements_of_a_layer_differ_by_the_growth_at_most(thicknesses, N, base):
    if base is RIGID and not thicknesses:
        return
    section = section_mesh(stack(*thicknesses, base=base), N)
    for top, bottom in section.outline.pieces:
        lines = np.unique(section.points[1])
        sizes = np.diff(lines[(lines >= top) & (lines <= bottom)])
        assert np.all(sizes[1:] / sizes[:-1] < GROWTH * (1 + 1e-9))
    r = np.unique(section.points[0])
    assert np.all(np.diff(r)[1:] / np.diff(r)[:-1] < GROWTH * (1 + 1e-9))


@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_a_refined_mesh_is_nested(mesher, body):
    coarse = mesher(body, 4)
    fine = coarse.refined()
    assert fine.quads.shape[1] == 4 * coarse.quads.shape[1]
    assert np.array_equal(fine.radii[::2], coarse.radii)
    corners = {tuple(point) for point in fine.points.T}
    assert all(tuple(point) in corners for point in coarse.points.T)
    assert fine.outline.size == coarse.outline.size / 2


@pytest.mark.parametrize("change", ["drop", "repeat"])
def test_holes_and_overlaps_are_noticed(mesher, change):
    section = mesher(BODIES["coated"], 4)
    quads = section.quads
    changed = quads[:, 1:] if change == "drop" else np.hstack([quads, quads[:, :1]])
    with pytest.raises(SolverError, match="holes or overlaps"):
        SectionMesh(section.points, changed, section.outline)


@pytest.mark.parametrize(
    ("body", "arguments", "error", "message"),
    [
        (stack(), {"elements_per_radius": 1}, ValueError, "at least 2"),
        (stack(), {"elements_per_radius": 8, "box": 1.5}, SolverError, "larger box"),
        (stack(), {"elements_per_radius": 8, "box": np.inf}, SolverError, "larger box"),
        (stack(20.0), {"elements_per_radius": 8, "box": 10.0}, SolverError, "larger box"),
        (stack(1e-9), {"elements_per_radius": 8}, UnsupportedScene, "leave it out"),
        (stack(2e6), {"elements_per_radius": 8}, UnsupportedScene, "leave the substrate out"),
    ],
)
def test_sizes_that_make_no_mesh_are_refused(mesher, body, arguments, error, message):
    with pytest.raises(error, match=message):
        mesher(body, **arguments)


def test_gmsh_is_left_as_it_was(gmsh):
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    gmsh.model.add("of somebody else")
    gmsh.option.setNumber("Mesh.Algorithm", 5)
    gmsh_section_mesh(stack(), 4)
    assert gmsh.option.getNumber("Mesh.Algorithm") == 5
    assert gmsh.model.getCurrent() == "of somebody else"
    gmsh.finalize()
    gmsh_section_mesh(stack(), 4)
    assert not gmsh.isInitialized()


@pytest.mark.parametrize("error", [ImportError("No module named gmsh"), OSError("libGLU.so.1")])
def test_missing_gmsh_is_named_with_its_packages(monkeypatch, error):
    def fail(name, *arguments, **options):
        if name == "gmsh":
            raise error
        return importing(name, *arguments, **options)

    importing = builtins.__import__
    monkeypatch.delitem(sys.modules, "gmsh", raising=False)
    monkeypatch.setattr(builtins, "__import__", fail)
    with pytest.raises(GmshMissing, match=f"{error}.*libglu1-mesa.*tensor"):
        gmsh_section_mesh(stack(), 4)
