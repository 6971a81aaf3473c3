"""Laws of line contacts: coefficients of strips, closed forms, loads per length, refusals."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fem_reference
import slipstick
from contact_errors.coarse_solves import stated_errors
from contact_results.directory.file_names import SUMMARY
from contact_results.result_files import write_result
from contact_results.stress.below_contact import body_response
from contact_results.stress.body_regions import BodyRegions
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.stress_maxima import extremes
from contact_results.surface import Rings, surface_on
from contact_scene import FiniteElementDiscretisation, Scene, SceneError, SurfaceDiscretisation
from contact_scene.quantities.per_length import SHOWN_NAMES
from contact_scene.quantities.summary import load_summary
from contact_scene.solver_errors import UnsupportedScene
from fem_reference import Method
from semi_analytical.frf.depth import Level, material_at
from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.influence.line import SCALARS, StripCoefficients
from semi_analytical.solve import solve_discretised
from semi_analytical.stress.strips import RESPONSES, strip_responses
from slipstick.expected import step_numbers
from verification.closed_forms.line_contact import CylinderContact, PushedCylinder

STEEL = {"young_modulus": 210e9, "poisson_ratio": 0.3}
MODULUS = 210e9 / (1 - 0.3**2) / 2
RADIUS = 18e-3
FORCE = 1e6
FRICTION = 0.1
REFERENCE = 0.02
HALF_WIDTH = float(np.sqrt(4 * FORCE * RADIUS / (np.pi * MODULUS)))
PEAK = 2 * FORCE / (np.pi * HALF_WIDTH)


def document(*loading: dict[str, Any], **changes: Any) -> dict[str, Any]:
    """A steel cylinder on a steel half-space."""
    indenter = {"shape": "cylinder", "radius": RADIUS, "material": STEEL}
    indenter |= {"reference_length": REFERENCE} | changes.pop("indenter", {})
    return {
        "indenter": {key: value for key, value in indenter.items() if value is not None},
        "body": {"material": STEEL},
        "friction": {"coefficient": FRICTION},
        "loading": list(loading) or [{"normal_force": FORCE}],
        **changes,
    }


def solved(*loading: dict[str, Any], cells: int = 256, **changes: Any) -> Any:
    scene = Scene.model_validate(document(*loading, **changes))
    return solve_discretised(scene, SurfaceDiscretisation(cells=cells))


# ---- Coefficients

# Base, and layers: alike, stiff on soft, soft on stiff, two layers, rigid base, incompressible.
STACKS = {
    "half-space": Stack((), (80e9, 0.3)),
    "equal layer": Stack([(80e9, 0.3, 1.0)], (80e9, 0.3)),
    "stiff": Stack([(200e9, 0.2, 1.0)], (80e9, 0.3)),
    "soft": Stack([(1e9, 0.4, 1.0)], (80e9, 0.3)),
    "two layers": Stack([(200e9, 0.2, 1.0), (20e9, 0.45, 2.0)], (80e9, 0.3)),
    "rigid base": Stack([(1e9, 0.3, 1.0)], None),
    "incompressible": Stack([(1e9, 0.5, 1.0)], None),
}


def dense_displacement(stack: Stack, width: float, x: np.ndarray, far: float) -> np.ndarray:
    """Displacements at x minus those at `far` (4, n), by Gauss sums over all wavenumbers.

    The transform of a strip, sin(m w/2)/(m/2), makes the integrals converge like 1/m². The last
    wavenumber is 600 per width, so that the tail is below 1e-5 of the values.
    """
    nodes, weights = np.polynomial.legendre.leggauss(16)
    step = np.pi / max(far, float(np.max(x)))
    edges = np.concatenate([[0.0], step * 2.0 ** np.arange(-60, 0), step * np.arange(1, 8_000)])
    m = ((edges[1:] + edges[:-1])[:, None] / 2 + np.diff(edges)[:, None] / 2 * nodes).ravel()
    own = (np.diff(edges)[:, None] / 2 * weights).ravel()
    response = np.array(scalars(stack, m)) * own * np.sin(m * width / 2) / (m / 2) / np.pi
    found = np.zeros((4, len(x)))
    for n, place in enumerate(x):
        even = np.cos(m * place) - np.cos(m * far)
        found[:, n] = response @ even
        found[1, n] = response[1] @ np.sin(m * place)
    return found


@pytest.mark.parametrize("name", STACKS)
def test_coefficients_are_sums_over_all_wavenumbers(name: str) -> None:
    stack, width, places = STACKS[name], 0.5, np.array([0, 1, 2, 5, 10, 23])
    found = StripCoefficients(stack, width, (42, 3), 1.0)
    dense = dense_displacement(stack, width, width * places, 40 * width)
    for component, row in SCALARS.items():
        own = found[component]
        assert not np.any(own[:, 1:])
        one = own[places, 0] - (0.0 if component == "zx" else own[40, 0])
        size = np.ptp(dense[row])
        np.testing.assert_allclose(one, dense[row], rtol=0, atol=1e-4 * size, err_msg=component)
    assert not np.any(found["xy"])
    assert not np.any(found["zy"])


def test_the_reference_length_adds_a_uniform_displacement() -> None:
    near, far = (StripCoefficients(STACKS["stiff"], 0.1, (50, 1), L)["zz"][:, 0] for L in (1, 20))
    rise = 0.1 / np.pi * (1 - 0.3) / 80e9 * np.log(20)
    np.testing.assert_allclose(far - near, rise, rtol=1e-9)
    rigid = [StripCoefficients(STACKS["rigid base"], 0.1, (50, 1), L)["zz"] for L in (1, 20)]
    np.testing.assert_allclose(*rigid, rtol=1e-9)


# ---- Closed forms


def test_a_moment_tilts_the_cylinder() -> None:
    moment = 0.3 * FORCE * HALF_WIDTH
    (end,) = solved({"normal_force": FORCE, "moment": [0, moment]}, cells=512).steps
    assert end.tilt[1] == pytest.approx(moment / (FORCE * RADIUS), rel=1e-5)
    assert end.moment[1] == pytest.approx(moment)
    (free,) = solved({"approach": end.approach, "tilt": [0, end.tilt[1]]}, cells=512).steps
    assert free.normal_force == pytest.approx(FORCE, rel=1e-3)


def test_tractions_do_not_depend_on_the_reference_length() -> None:
    steps = {"normal_force": FORCE}, {"tangential_force": [0.4 * FRICTION * FORCE, 0]}
    near, far = (solved(*steps, indenter={"reference_length": L}) for L in (REFERENCE, 1.0))
    none = solved(*steps, indenter={"reference_length": None})
    for other in (far, none):
        size = 1e-8 * PEAK
        np.testing.assert_allclose(other.steps[1].shear, near.steps[1].shear, rtol=0, atol=size)
        lost = [result.steps[1].dissipated_energy for result in (near, other)]
        assert lost[1] == pytest.approx(lost[0], rel=1e-6)
    end = none.steps[1]
    unknown = (end.approach, end.tangential_shift, end.elastic_energy, end.input_work)
    assert unknown == (None, None, None, None)
    assert far.steps[1].approach > near.steps[1].approach


def test_a_profile_of_the_cylinder_has_its_half_width() -> None:
    x = np.linspace(-2e-3, 2.4e-3, 221)
    profile = np.stack([x, x**2 / (2 * RADIUS)])
    shape = {"shape": "line_profile", "radius": None, "file": profile}
    (end,) = solved({"normal_force": FORCE}, cells=512, indenter=shape).steps
    assert end.contact_radius == pytest.approx(HALF_WIDTH, rel=2e-4)
    (led,) = solved({"approach": end.approach}, cells=512, indenter=shape).steps
    assert led.normal_force == pytest.approx(FORCE, rel=2e-4)


# ---- What a line contact refuses

REFUSED = {
    "force": ({"loading": [{"normal_force": "100 N"}]}, 'per length such as "100 N/mm"'),
    "moment": (
        {"loading": [{"normal_force": FORCE, "moment": [0, "1 N m"]}]},
        'a moment per length such as "20 N"',
    ),
    "stiffness": ({"rig": {"normal_stiffness": "1 N/um"}}, 'such as "50 N/mm^2"'),
    "torque": ({"loading": [{"normal_force": FORCE}, {"torque": 1.0}]}, "out of the plane"),
    "moment x": ({"loading": [{"normal_force": FORCE, "moment": [1, 0]}]}, "(0, value)"),
    "strain": (
        {"loading": [{"normal_force": FORCE, "bulk_strain": [0, 1e-4, 0]}]},
        "(value, 0, 0)",
    ),
    "approach": (
        {"loading": [{"approach": 1e-5}], "indenter": {"reference_length": None}},
        "add indenter.reference_length",
    ),
    "spring": (
        {"rig": {"normal_stiffness": 1e9}, "indenter": {"reference_length": None}},
        "add indenter.reference_length",
    ),
    "friction map": (
        {"friction": {"coefficient": {"map": np.full((4, 4), 0.1), "spacing": 1e-3}}},
        "one number",
    ),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_not_in_plane_strain_is_refused(name: str) -> None:
    changes, words = REFUSED[name]
    loading = changes.get("loading", [{"normal_force": FORCE}])
    rest = {key: value for key, value in changes.items() if key != "loading"}
    with pytest.raises(SceneError, match=r".") as refused:
        Scene.model_validate(document(*loading, **dict(rest)))
    assert words in str(refused.value)


def test_a_load_per_length_is_refused_on_a_ball() -> None:
    ball = {"shape": "sphere", "reference_length": None}
    with pytest.raises(SceneError, match='a normal force such as "100 N"'):
        Scene.model_validate(document({"normal_force": "100 N/mm"}, indenter=ball))


def test_the_radial_solver_refuses_a_cylinder() -> None:
    with pytest.raises(UnsupportedScene, match="not axisymmetric"):
        slipstick.solve(Scene.model_validate(document()), "radial")


def test_a_contact_needs_a_distant_reference() -> None:
    with pytest.raises(UnsupportedScene, match="at least 10 half-widths"):
        solved(indenter={"reference_length": 5 * HALF_WIDTH})


def test_cells_along_two_axes_are_refused() -> None:
    scene = Scene.model_validate(document())
    for wrong in ({"cells": (64, 64)}, {"window": (1e-3, 1e-3)}):
        with pytest.raises(UnsupportedScene, match="one number, along x"):
            solve_discretised(scene, SurfaceDiscretisation(**wrong))


# ---- Stress below


@pytest.mark.parametrize("layer", [0, 1])
def test_layers_equal_to_their_base_have_the_stress_of_the_half_space(layer: int) -> None:
    depth = (0.4, 1.3)[layer]
    plain = strip_responses(STACKS["half-space"], Level(depth, 0), 0.1, 60)
    layered = strip_responses(STACKS["equal layer"], Level(depth, layer), 0.1, 60)
    np.testing.assert_allclose(layered, plain, rtol=0, atol=1e-13 * np.max(np.abs(plain)))


@pytest.mark.parametrize("name", ["stiff", "soft", "two layers"])
def test_tractions_and_strain_are_continuous_at_an_interface(name: str) -> None:
    stack = STACKS[name]
    above, below = (strip_responses(stack, Level(1.0, layer), 0.1, 60) for layer in (0, 1))
    rows = {response: n for n, response in enumerate(RESPONSES)}
    for response in ("zz z", "xz z", "zz x", "xz x", "yz y"):
        row = rows[response]
        np.testing.assert_allclose(above[row], below[row], rtol=0, atol=1e-12)
    # ε_xx = (1 - ν) σ_xx/2G - ν σ_zz/2G in plane strain; the interface is bonded.
    for traction in "zx":
        strains = []
        for layer, stress in enumerate((above, below)):
            G, nu = material_at(stack, Level(1.0, layer))
            xx, zz = (stress[rows[f"{part} {traction}"]] for part in ("xx", "zz"))
            strains.append(((1 - nu) * xx - nu * zz) / (2 * G))
        size = np.max(np.abs(strains))
        np.testing.assert_allclose(*strains, rtol=0, atol=1e-11 * size)


# ---- Plane-strain elements

PUSH = 0.5 * FRICTION * FORCE
PUSHED = PushedCylinder(CylinderContact(FORCE, RADIUS, MODULUS, REFERENCE), FRICTION, PUSH)
PRESS_AND_PUSH: tuple[dict[str, Any], ...] = (
    {"normal_force": FORCE},
    {"tangential_force": [PUSH, 0]},
)


def solved_on_elements(
    *loading: dict[str, Any], method: Method = Method.COMPLEMENTARITY, **changes: Any
) -> Any:
    scene = Scene.model_validate(document(*loading, **changes))
    return fem_reference.solve(scene, FiniteElementDiscretisation(elements_per_radius=16), method)


@pytest.mark.parametrize("method", Method)
def test_elements_in_plane_strain_have_the_contact_of_a_pushed_cylinder(method: Method) -> None:
    pressed, pushed = solved_on_elements(*PRESS_AND_PUSH, method=method).steps
    part = 0.1 / 16  # a tenth of an element
    assert pressed.peak_pressure == pytest.approx(PEAK, rel=2e-3)
    assert pressed.contact_radius == pytest.approx(HALF_WIDTH, rel=part)
    assert pressed.contact_area == 2 * pressed.contact_radius
    assert pressed.approach == pytest.approx(PUSHED.pressed.approach, rel=5e-4)
    assert pushed.stick_radius == pytest.approx(PUSHED.stick_radius, rel=part)
    assert pushed.tangential_shift[0] == pytest.approx(PUSHED.shift, rel=1e-3)
    assert pushed.dissipated_energy == pytest.approx(PUSHED.dissipated_energy, rel=3 * part)


def test_motions_on_elements_need_a_reference_length() -> None:
    far, none = (
        solved_on_elements(*PRESS_AND_PUSH, indenter={"reference_length": L}) for L in (1.0, None)
    )
    near, end = solved_on_elements(*PRESS_AND_PUSH).steps[1], none.steps[1]
    size = 1e-9 * PEAK
    for other in (far.steps[1], end):
        np.testing.assert_allclose(other.pressure, near.pressure, rtol=0, atol=size)
        np.testing.assert_allclose(other.shear_along_load, near.shear_along_load, atol=size)
    rise = 2 * np.log(1.0 / REFERENCE) / (np.pi * MODULUS)
    moved = far.steps[1].approach - near.approach
    assert moved == pytest.approx(FORCE * rise, rel=1e-9)
    slid = far.steps[1].tangential_shift[0] - near.tangential_shift[0]
    assert slid == pytest.approx(PUSH * rise, rel=1e-9)
    unknown = (end.approach, end.tangential_shift, end.elastic_energy, end.input_work)
    assert unknown == (None, None, None, None)


def test_the_stress_below_elements_is_that_below_strips() -> None:
    """Von Mises stress by closed forms, and tension behind the pushed contact."""
    found = [
        extremes(body_response(state_of_result(result, 2)).stress())
        for result in (solved_on_elements(*PRESS_AND_PUSH), solved(*PRESS_AND_PUSH, cells=512))
    ]
    elements, strips = (
        {one.measure: one.value for one in each if one.region == "body"} for each in found
    )
    assert elements["von_mises"] == pytest.approx(strips["von_mises"], rel=5e-3)
    assert elements["max_principal"] == pytest.approx(strips["max_principal"], rel=0.2)


def tension_of_a_layer(solve: Any, thickness: float, region: str, **settings: Any) -> Any:
    """Largest tension in a region of a layer, twice as stiff as its base, below a cylinder."""
    coat = {"thickness": thickness, "material": {"young_modulus": 400e9, "poisson_ratio": 0.3}}
    body = {"material": STEEL, "layers": [coat]}
    result = solve({"normal_force": FORCE}, body=body, friction=None, **settings)
    found = extremes(body_response(state_of_result(result, 1)).stress())
    (one,) = (e for e in found if (e.region, e.measure) == (region, "max_principal"))
    assert not one.at_window_edge
    return one


@pytest.mark.parametrize(("widths", "region"), [(1.0, "surface"), (1.0, "base"), (20.0, "surface")])
def test_a_bent_layer_has_its_tension_beyond_the_contact(widths: float, region: str) -> None:
    """Two to three thicknesses from the middle."""
    thickness = widths * HALF_WIDTH
    one = tension_of_a_layer(solved_on_elements, thickness, region)
    other = tension_of_a_layer(solved, thickness, region, cells=512)
    assert other.value == pytest.approx(one.value, rel=0.1)
    assert abs(other.x) == pytest.approx(abs(one.x), rel=0.1)
    assert abs(other.x) > 1.5 * thickness


def test_the_tension_of_thick_layers_is_inverse_to_their_thickness() -> None:
    """Far from the load only its force counts; a half width of h/40 changes 1e-3 of it."""
    one, other = (
        tension_of_a_layer(solved, n * HALF_WIDTH, "surface", cells=128) for n in (40, 160)
    )
    assert 4 * other.value == pytest.approx(one.value, rel=1e-3)
    assert abs(other.x) == pytest.approx(4 * abs(one.x), rel=5e-3)


def test_the_surface_is_a_region_of_depth_zero_alone() -> None:
    coat = {"thickness": HALF_WIDTH, "material": {"young_modulus": 400e9, "poisson_ratio": 0.3}}
    body = {"material": STEEL, "layers": [coat]}
    result = solved(cells=64, body=body, friction=None)
    response = body_response(state_of_result(result, 1))
    for depths, has_surface in (((0.0, 0.5 * HALF_WIDTH), True), ((0.5 * HALF_WIDTH,), False)):
        found = extremes(response.stress(depths))
        assert ("surface" in {one.region for one in found}) is has_surface
    below_a_tip = BodyRegions.from_body(response.body, HALF_WIDTH, 4, infinite=True)
    assert "surface" not in below_a_tip.named


OTHER = {"young_modulus": 70e9, "poisson_ratio": 0.3}
SLANTED = np.stack([x := np.linspace(-2e-3, 2e-3, 101), x**2 / (2 * RADIUS) + 1e-4 * x**3])
REFUSED_ON_ELEMENTS: dict[str, tuple[dict[str, Any], str]] = {
    "unlike bodies": ({"body": {"material": OTHER}}, "unlike bodies have friction"),
    "bulk strain": (
        {"loading": [{"normal_force": FORCE, "bulk_strain": [1e-4, 0, 0]}]},
        "bulk strain",
    ),
    "push along": (
        {"loading": [{"normal_force": FORCE}, {"tangential_force": [0, PUSH]}]},
        "pushes along the line",
    ),
    "tilt": ({"loading": [{"normal_force": FORCE, "moment": [0, 10.0]}]}, "does not tilt"),
    "slanted profile": (
        {"indenter": {"shape": "line_profile", "radius": None, "file": SLANTED}},
        "not symmetric about x = 0",
    ),
}


@pytest.mark.parametrize("name", REFUSED_ON_ELEMENTS)
def test_elements_refuse_what_is_not_symmetric_about_the_line(name: str) -> None:
    changes, words = REFUSED_ON_ELEMENTS[name]
    scene = document(**{key: value for key, value in changes.items() if key != "loading"})
    scene["loading"] = changes.get("loading", scene["loading"])
    with pytest.raises(UnsupportedScene, match=words):
        fem_reference.plan(Scene.model_validate(scene))


def test_unlike_bodies_are_pressed_without_friction() -> None:
    scene = Scene.model_validate(document(body={"material": OTHER}, friction=None))
    assert fem_reference.plan(scene).path is fem_reference.Path.PRESSING


@pytest.mark.parametrize("solve", [solved, solved_on_elements])
def test_a_summary_has_the_names_of_line_contacts(solve: Any, tmp_path: Path) -> None:
    result = solve(*PRESS_AND_PUSH)
    write_result(result, tmp_path, figures="none", errors=stated_errors(result))
    text = (tmp_path / SUMMARY).read_text(encoding="utf-8")
    for step, end in zip(json.loads(text)["steps"], result.steps, strict=True):
        for names in (step, step["errors"]):
            assert set(names) >= set(SHOWN_NAMES.values())
            assert not set(names) & set(SHOWN_NAMES)
        assert step["half_width"] == end.contact_radius
    read = load_summary(text).steps[-1]
    assert read.stick_radius == result.steps[-1].stick_radius
    assert read.errors is not None
    assert "stick_radius" in read.errors
    expected = step_numbers([read], line=True)["step 1"]
    assert (expected["stick_half_width"].unit, expected["normal_force"].unit) == ("m", "N/m")
    assert not set(expected) & set(SHOWN_NAMES)


def test_lines_of_elements_are_stored_on_both_sides() -> None:
    """The sum of weight times field is the integral of a field that is linear between the lines."""
    x = np.array([0.0, 0.3, 0.5, 1.1])
    lines = Rings(x, None, (1.0, 0.0), polar=False, of_strips=True)
    assert np.sum(lines.weights) == pytest.approx(2.2)
    assert np.sum(lines.weights * x) == pytest.approx(1.1**2)
    read = surface_on(lines.axes, lines.direction)
    assert isinstance(read, Rings)
    assert read.of_strips
    np.testing.assert_array_equal(read.on_both_sides().profile_line.places, [*-x[::-1], *x])
