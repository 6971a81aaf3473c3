"""Laws of line contacts: coefficients of strips, closed forms, loads per length, refusals."""

from dataclasses import replace
from functools import cache, partial
from typing import Any

import numpy as np
import pytest

import fem_reference
from contact_errors.stress_errors import stress_errors
from contact_results.stress.below_contact import body_response
from contact_results.stress.body_regions import BodyRegions
from contact_results.stress.loaded_bodies import state_of_result
from contact_results.stress.stress_maxima import extremes
from contact_scene import FiniteElementDiscretisation, Scene, SurfaceDiscretisation
from fem_reference import Method
from fem_reference.discretised import ElementSolver
from semi_analytical.frf.depth import Level, material_at
from semi_analytical.frf.stack import Stack
from semi_analytical.frf.surface import scalars
from semi_analytical.influence.line import SCALARS, StripCoefficients
from semi_analytical.solve import solve_discretised
from semi_analytical.stress.strips import RESPONSES, strip_responses

STEEL = {"young_modulus": 210e9, "poisson_ratio": 0.3}
MODULUS = 210e9 / (1 - 0.3**2) / 2
RADIUS = 18e-3
FORCE = 1e6
FRICTION = 0.1
REFERENCE = 0.02
HALF_WIDTH = float(np.sqrt(4 * FORCE * RADIUS / (np.pi * MODULUS)))
PEAK = 2 * FORCE / (np.pi * HALF_WIDTH)


def document(*loading, **changes):
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


def solved(*loading, cells=256, **changes):
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
def test_coefficients_are_sums_over_all_wavenumbers(name):
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


# ---- Profiles


def test_a_profile_of_the_cylinder_has_its_half_width():
    x = np.linspace(-2e-3, 2.4e-3, 221)
    profile = np.stack([x, x**2 / (2 * RADIUS)])
    shape = {"shape": "line_profile", "radius": None, "file": profile}
    (end,) = solved({"normal_force": FORCE}, cells=512, indenter=shape).steps
    assert end.contact_radius == pytest.approx(HALF_WIDTH, rel=2e-4)
    (led,) = solved({"approach": end.approach}, cells=512, indenter=shape).steps
    assert led.normal_force == pytest.approx(FORCE, rel=2e-4)


# ---- Stress below


@pytest.mark.parametrize("name", ["stiff", "soft", "two layers"])
def test_tractions_and_strain_are_continuous_at_an_interface(name):
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
PRESS_AND_PUSH = (
    {"normal_force": FORCE},
    {"tangential_force": [PUSH, 0]},
)


def solved_on_elements(*loading, **changes):
    scene = Scene.model_validate(document(*loading, **changes))
    mesh = FiniteElementDiscretisation(elements_per_radius=16)
    return fem_reference.solve(scene, mesh, Method.COMPLEMENTARITY)


def test_the_area_of_a_line_contact_is_resolved_as_its_two_edges():
    result = solved_on_elements({"normal_force": FORCE})
    solver, (end,) = ElementSolver.of(result), result.steps
    features = solver.measure_features(result, end)
    (side,) = solver.cell_sides(result)
    assert features.largest == {"contact_radius": side, "contact_area": pytest.approx(2 * side)}
    assert features.layer_at_edge == 2.0  # half elements


@pytest.mark.parametrize("solve", [solved, solved_on_elements])
def test_motions_alone_depend_on_the_reference_length(solve):
    """They grow by the logarithm of the length; without a length they are unknown."""
    near, far, none = (
        solve(*PRESS_AND_PUSH, indenter={"reference_length": length}).steps[1]
        for length in (REFERENCE, 1.0, None)
    )
    for other in (far, none):
        np.testing.assert_allclose(other.pressure, near.pressure, rtol=0, atol=1e-8 * PEAK)
        assert other.dissipated_energy == pytest.approx(near.dissipated_energy, rel=1e-6)
    rise = 2 * np.log(1.0 / REFERENCE) / (np.pi * MODULUS)
    moved = far.approach - near.approach, far.tangential_shift[0] - near.tangential_shift[0]
    assert moved == pytest.approx((FORCE * rise, PUSH * rise), rel=1e-6)
    unknown = (none.approach, none.tangential_shift, none.elastic_energy, none.input_work)
    assert unknown == (None, None, None, None)


def test_the_stress_below_elements_is_that_below_strips():
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


def maxima(found: list[Any]) -> dict[tuple[str, str], Any]:
    return {(one.region, one.measure): one for one in found}


@cache
def below_layer(solve, widths):
    """Pressed cylinder on a layer of so many half widths, twice as stiff as its base: the state,
    the stress and its maxima."""
    coat = {"thickness": widths * HALF_WIDTH, "material": STEEL | {"young_modulus": 420e9}}
    body = {"material": STEEL, "layers": [coat]}
    state = state_of_result(solve({"normal_force": FORCE}, body=body, friction=None), 1)
    field = body_response(state).stress()
    return state, field, extremes(field)


STRIPS = partial(solved, cells=128)


@pytest.mark.parametrize(("widths", "region"), [(1.0, "surface"), (1.0, "base"), (20.0, "surface")])
def test_a_bent_layer_has_its_tension_beyond_the_contact(widths, region):
    """Two to three thicknesses from the middle."""
    one, other = (
        maxima(below_layer(solve, widths)[2])[region, "max_principal"]
        for solve in (solved_on_elements, STRIPS)
    )
    assert not one.at_window_edge
    assert not other.at_window_edge
    assert other.value == pytest.approx(one.value, rel=0.1)
    assert abs(other.x) == pytest.approx(abs(one.x), rel=0.1)
    assert abs(other.x) > 1.5 * widths * HALF_WIDTH


@pytest.mark.parametrize("widths", [1.0, 20.0])
def test_the_errors_of_stresses_far_from_the_contact_are_covered(widths):
    """Elements grow with the distance, at the interface and where a bent layer has its tension."""
    state, field, found = below_layer(solved_on_elements, widths)
    known = maxima(below_layer(STRIPS, widths)[2])
    errors = stress_errors(replace(state, by_increments=0.0, shear_error=0.0), field, found)
    judged = 0
    for one, error in zip(found, errors, strict=True):
        if one.region.split()[0] in ("base", "interface") and (one.region, one.measure) in known:
            exact = known[one.region, one.measure].value
            assert abs(one.value - exact) <= error.error <= 0.05 * exact, one
            assert one.value == pytest.approx(exact, rel=0.01)
            judged += 1
    assert judged >= 7


def test_the_surface_is_a_region_of_depth_zero_alone():
    coat = {"thickness": HALF_WIDTH, "material": {"young_modulus": 400e9, "poisson_ratio": 0.3}}
    body = {"material": STEEL, "layers": [coat]}
    result = solved(cells=64, body=body, friction=None)
    response = body_response(state_of_result(result, 1))
    for depths, has_surface in (((0.0, 0.5 * HALF_WIDTH), True), ((0.5 * HALF_WIDTH,), False)):
        found = extremes(response.stress(depths))
        assert ("surface" in {one.region for one in found}) is has_surface
    below_a_tip = BodyRegions.from_body(response.body, HALF_WIDTH, 4, infinite=True)
    assert "surface" not in below_a_tip.named
