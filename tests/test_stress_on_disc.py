"""Tests of the stress below contacts of the radial solver, against closed forms and another
solver."""

from dataclasses import replace

import meshio
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import radial
import radial.history
import slipstick
from contact_errors.stress_errors import stress_errors
from contact_results.stress.below_contact import body_response
from contact_results.stress.files import SECTION, write_files
from contact_results.stress.loaded_bodies import state_of_increment, state_of_result
from contact_results.stress.on_disc import OnDisc
from contact_results.stress.stress_maxima import extremes
from contact_scene import (
    RIGID,
    Body,
    CoulombFriction,
    IsotropicMaterial,
    Layer,
    LoadStep,
    Paraboloid,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.geometry import ShapedBody
from contact_scene.solver_errors import UnsupportedScene
from radial.normal.disc import disc
from radial.response.bodies import Bodies
from radial.stress.circle_fit import axisymmetric_circle, fit_tangential_circle
from radial.stress.loaded_circle import LoadedCircle
from radial.stress.ray_integrals import below_circle
from radial.stress.subsurface_circle import SubsurfaceCircle
from radial.stress.subsurface_disc import SubsurfaceDisc
from semi_analytical.frf.depth import Level
from semi_analytical.frf.stack import HalfSpace, Stack, stack_of
from slipstick.against import comparison
from verification.closed_forms.huber_stress import hamilton_stress, huber_stress

# a = 1, E* = π/2 and p_H = 1.
SOFT = IsotropicMaterial(young_modulus=0.91 * np.pi / 2, poisson_ratio=0.3)
BALL = Paraboloid(radius=1.0, material=RIGID)
BARE = Body(material=SOFT)
RADII = np.concatenate([[0.0, 1e-5], np.linspace(0.05, 3, 40), [1 - 1e-9, 1 + 1e-9]])


def coated(modulus: float, thickness: float, ratio: float = 0.3) -> Body:
    layer = IsotropicMaterial(young_modulus=modulus * SOFT.young_modulus, poisson_ratio=ratio)
    return Body(material=SOFT, layers=(Layer(thickness=thickness, material=layer),))


def scene_of(body: Body, indenter: ShapedBody = BALL, force: float = 2.0) -> Scene:
    return Scene(indenter=indenter, body=body, loading=(LoadStep(normal_force=force),))


def below(body: Body) -> SubsurfaceDisc:
    return SubsurfaceDisc(disc(Bodies.of(scene_of(body)), BALL, 1.0), stack_of(body), 3.0)


@given(depth=st.floats(1e-3, 5.0))
def test_below_a_ball_it_is_hubers(depth):
    fields = below(BARE).compute_fields([Level(depth, 0)], RADII)[0]
    exact = huber_stress(RADII, depth, 1.0, 1.0, 0.3)
    for ours, theirs in zip(
        fields[2:], (exact.radial, exact.hoop, exact.axial, exact.shear), strict=True
    ):
        assert_allclose(ours, theirs, rtol=0, atol=1e-11)


def test_the_surface_has_the_fields_just_below_it():
    """Away from the edge, where the pressure has a vertical tangent."""
    radii = np.array([0.0, 0.2, 0.6, 0.9, 1.2, 2.5])
    surface, under = below(BARE).compute_fields([Level(0.0, 0), Level(1e-8, 0)], radii)
    assert_allclose(surface, under, rtol=0, atol=1e-6)


@given(modulus=st.floats(0.1, 10.0), thickness=st.floats(0.1, 2.0), ratio=st.floats(-0.5, 0.5))
def test_an_interface_carries_what_it_is_given(modulus, thickness, ratio):
    """Displacement and traction are the same on both sides, by two ways of the response."""
    sides = [Level(thickness, 0), Level(thickness, 1)]
    above, under = below(coated(modulus, thickness, ratio)).compute_fields(sides, RADII)
    for component in (0, 1, 4, 5):
        assert_allclose(above[component], under[component], rtol=0, atol=1e-10)


MU = 0.3
NU = 0.3
G = 2.0
# a = 1, E* = π/2 and p_H = 1.
SAME = Paraboloid(radius=1.0, material=SOFT)
W = 2 * np.pi / 3


def circle_of(q_x, q_y, p, centre=0.0):
    """From functions of η and the angle."""
    eta, turn = np.linspace(0, 1, 241)[:, None], 2 * np.pi * np.arange(360) / 360
    parts = [f(eta, turn) + 0 * eta * turn for f in (q_x, q_y, p)]
    return LoadedCircle(1.0, centre, np.stack(parts))


SLIDING = circle_of(lambda e, t: MU, lambda e, t: 0.0, lambda e, t: 1.0)
ANYHOW = circle_of(
    lambda e, t: 0.1 + 0.05 * e * np.cos(t),
    lambda e, t: 0.03 + 0.08 * e * np.sin(t) + 0.02 * e**2 * np.cos(2 * t),
    lambda e, t: 1 + 0.2 * e * np.cos(t) + 0.1 * e * np.sin(t),
    centre=0.2,
)


def test_a_fitted_circle_has_the_tractions_of_its_nodes_on_every_side():
    def tractions(x, y):
        p = np.sqrt(np.maximum(1 - x**2 - y**2, 0.0)) * (1 + 0.3 * x)
        return np.stack([0.1 * p * (1 + 0.5 * x), 0.05 * p * y, p])

    radii, angles = np.linspace(0.01, 1.1, 110), np.linspace(0, np.pi, 17)
    cos, sin = np.cos(angles), np.sin(angles)
    q_x, q_y, p = tractions(radii[:, None] * cos, radii[:, None] * sin)
    circle = fit_tangential_circle(radii, angles, q_x * cos + q_y * sin, q_y * cos - q_x * sin, p)
    x, y = np.array([0.5, -0.5, 0.3, -0.6]), np.array([0.1, -0.2, 0.6, 0.4])
    found = circle.interpolate_tractions((x - circle.centre) / circle.radius, y / circle.radius)
    assert_allclose(found, tractions(x, y), rtol=2e-3)


def test_a_pressure_whose_square_has_no_zero_ends_near_its_last_ring():
    radii, angles = np.linspace(0.0, 1.2, 61), np.linspace(0, np.pi, 10)
    s = np.maximum(1 - radii**2, 0.0)
    p = np.sqrt(np.where(s > 0, 0.02 + s**2, 0.0))[:, None] * np.ones_like(angles)
    circle = fit_tangential_circle(radii, angles, 0 * p, 0 * p, p)
    assert_allclose([circle.radius, circle.centre], [1.0, 0.0], atol=0.1)


def test_a_contact_within_few_rings_ends_among_them():
    """A fit of five rings also has a zero far inside, at 0.4 of the contact radius."""
    press = LoadStep(normal_force=2.0, increments=4)
    push = LoadStep(tangential_force=(0.24, 0.0), increments=1)
    friction = CoulombFriction(coefficient=0.2)
    posed = scene_of(BARE).replace({"loading": (press, push), "friction": friction})
    result = radial.solve(posed)
    half = state_of_increment(result, 1, 2)
    assert OnDisc(half).radial_body.parts.radius == pytest.approx(half.contact_radius, rel=0.05)


def test_a_small_contact_has_its_stress_without_the_later_larger_one():
    friction = CoulombFriction(coefficient=0.2)
    small = LoadStep(normal_force=0.03, increments=1)
    push = LoadStep(tangential_force=(0.003, 0.0), increments=1)
    larger = LoadStep(normal_force=2.0, increments=1)
    posed = scene_of(BARE).replace({"loading": (small, push, larger), "friction": friction})
    with pytest.raises(UnsupportedScene, match="remove later loads with a larger contact"):
        OnDisc(state_of_result(slipstick.solve(posed, "radial"), 2)).stress([0.1])
    alone = slipstick.solve(posed.replace({"loading": (small, push)}), "radial")
    assert OnDisc(state_of_result(alone, 2)).stress([0.1]).points.x.size


@pytest.mark.parametrize("scatters", [False, True])
def test_rings_whose_pressure_scatters_at_the_edge_do_not_move_the_circle(scatters):
    radii = np.append(np.linspace(0.0, 0.98, 25), [0.992, 0.996, 0.9999, 1.01, 1.2])
    p = np.sqrt(np.maximum(1 - radii**2, 0.0))
    p[-5:-2] *= np.array([0.8, 1.3, 5.0]) if scatters else 1.0
    circle = axisymmetric_circle(radii, 1.0, 0.1 * p, 0.2 * p, p, on_points=scatters)
    assert_allclose(circle.smooth[..., 0], np.ones((3, 241)) * [[0.1], [0.2], [1.0]], rtol=1e-9)


def test_one_point_may_need_several_blocks_of_quadrature_points():
    loaded = circle_of(lambda e, t: MU, lambda e, t: 0.0, lambda e, t: 1.0)
    near, depth = np.array([1 - 1e-6]), 1e-6
    usual, fine = (
        below_circle(loaded, HalfSpace(G, NU), near, 0 * near, depth, fineness)
        for fineness in (1, 8)
    )
    assert_allclose(usual, fine, rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize("r", [1.0, 1 + 4.0**-5, 1 - 4.0**-5, 0.5])
def test_round_off_of_a_position_does_not_change_its_stress(r):
    """Shear that turns about the axis has a kink there, which the rays resolve in part."""
    kinked = circle_of(lambda e, t: MU * np.cos(8 * t), lambda e, t: 0.0, lambda e, t: 1.0)
    x = r + 1e-15 * np.arange(-4, 5)
    found = below_circle(kinked, HalfSpace(G, NU), x, 0 * x, 0.0)
    assert_allclose(found, np.broadcast_to(found[:, 4:5], found.shape), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("depth", [0.0, 1e-6, 1e-3, 0.1, 2.0])
def test_below_a_sliding_ball_it_is_hamiltons(depth):
    drawn = np.random.default_rng(1)
    near = 10.0 ** -drawn.uniform(0.5, 7 if depth else 2, 40)
    r = np.concatenate([drawn.uniform(0, 3, 20), 1 + near[:20], 1 - near[20:], [0.0, 1.0]])
    turn = drawn.uniform(0, 2 * np.pi, len(r))
    x, y = r * np.cos(turn), r * np.sin(turn)
    exact = hamilton_stress(x, y, max(depth, 1e-6), 1.0, 1.0, MU, NU)
    for finer, allowed in ((1, 6e-5), (2, 3e-5)):
        found = below_circle(SLIDING, HalfSpace(G, NU), x, y, depth, finer)[3:]
        assert np.all(np.isfinite(found))
        inner = slice(None if depth else -1)  # the last point lies on the edge
        assert_allclose(found[:, inner], exact[:, inner], atol=allowed)


def test_a_stiffer_layer_is_bonded_to_its_base():
    """Displacement and what acts on the interface are the same from both sides."""
    film = SubsurfaceCircle(ANYHOW, Stack([(3 * G, 0.2, 0.5)], (G, 0.4)), 5, 5)
    x, y = np.random.default_rng(3).uniform(-2, 2, (2, 30))
    above, below = film.compute_fields([Level(0.5, 0), Level(0.5, 1)], x, y)
    carried = [0, 1, 2, 5, 6, 7]
    assert_allclose(above[carried], below[carried], atol=1e-5)
    assert np.max(np.abs(above[3] - below[3])) > 0.1


def frictional(body: Body, indenter: Paraboloid, *loads: LoadStep) -> Scene:
    return Scene(
        indenter=indenter, body=body, friction=CoulombFriction(coefficient=0.1), loading=loads
    )


def pushed(direction: tuple[float, float] = (1.0, 0.0)) -> Scene:
    force = 0.06 * W * direction[0], 0.06 * W * direction[1]
    return frictional(
        Body(material=SOFT),
        SAME,
        LoadStep(normal_force=W, increments=1),
        LoadStep(tangential_force=force, increments=2),
    )


def test_an_oblique_load_has_its_profile_along_it_and_acts_on_the_indenter_in_reverse(
    tmp_path,
):
    result = radial.solve(pushed((0.6, 0.8)))
    slipstick.save(result, tmp_path / "run", figures="none")
    end = result.steps[-1]
    table = {"x": end.radii, "pressure": end.pressure[:, 0]}
    *_, at_places = comparison(table, slipstick.load(tmp_path / "run")).numbers
    assert at_places.gap < 1e-9 * end.peak_pressure
    state = state_of_result(result, None)
    lower, upper = (OnDisc(state, of).stress([0.3]).axis.components for of in (False, True))
    assert np.max(np.abs(lower["xz"])) > 1e-3 * end.peak_pressure
    assert_allclose(upper["xz"], -lower["xz"])
    assert_allclose(upper["zz"], lower["zz"])


@pytest.mark.parametrize("direction", [(0.6, 0.8), (0.0, -1.0)])
def test_stress_at_points_and_in_files_turns_with_the_load(direction, rng, tmp_path):
    """A vector turns by a rotation, a stress by one on each of its indices."""
    c, s = direction
    turn, voigt = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), [[0, 5, 4], [5, 1, 3], [4, 3, 2]]
    states = [state_of_result(radial.solve(scene), None) for scene in (pushed(), pushed(direction))]
    places, levels = rng.uniform(-1.5, 1.5, (2, 9)), [Level(0.3, 0)] * 9
    one, other = (
        OnDisc(state).stress_at(*at, levels)
        for state, at in zip(states, (places, turn[:2, :2] @ places), strict=True)
    )
    expected = np.einsum("ia,jb,abn->ijn", turn, turn, one.stress[voigt])
    assert_allclose(other.stress[voigt], expected, atol=1e-9)
    assert_allclose(other.displacement, turn @ one.displacement, atol=1e-9)
    field = OnDisc(states[1]).stress([0.2, 0.4])
    write_files(states[1], "body", field, extremes(field), tmp_path, None, None)
    section = meshio.read(tmp_path / SECTION)
    some = slice(None, None, 29)
    x, y, depth = section.points[some].T
    at_nodes = OnDisc(states[1]).stress_at(x, y, [Level(float(z), 0) for z in depth])
    tensors = section.point_data["stress [Pa]"][some].T
    assert_allclose(tensors.reshape(3, 3, -1), at_nodes.stress[voigt], atol=1e-6)


TWISTED = frictional(
    Body(material=SOFT), SAME, LoadStep(normal_force=W, increments=1), LoadStep(torque=0.02 * W)
)


@pytest.mark.parametrize("scene", [TWISTED, pushed()], ids=["twisted", "pushed"])
def test_a_section_has_on_both_sides_the_stress_of_its_points(scene):
    state = state_of_result(radial.solve(scene), None)
    section = OnDisc(state).stress([0.3]).section.select_columns(slice(None, None, 9))
    levels = [Level(0.3, 0)] * section.x.size
    at_points = OnDisc(state).stress_at(section.x.ravel(), section.y.ravel(), levels)
    peak = np.max(np.abs(section.stress))
    assert np.min(section.x) < 0
    assert_allclose(at_points.stress, section.stress[:, 0], atol=1e-9 * peak)


STEEL = IsotropicMaterial(young_modulus=21e10, poisson_ratio=0.3)
LARGE = Paraboloid(radius=18e-3, material=RIGID)


def on_steel(thickness: float, modulus: float) -> Body:
    """A layer of this modulus on steel, in SI units."""
    material = IsotropicMaterial(young_modulus=modulus, poisson_ratio=0.3)
    return Body(material=STEEL, layers=(Layer(thickness=thickness, material=material),))


@pytest.mark.parametrize(
    ("solver", "sizes"),
    [
        ("radial", None),
        ("semi-analytical", SurfaceDiscretisation(cells=(12, 12))),
    ],
)
@pytest.mark.parametrize("strain", [0.0, -1e-4])
def test_the_shear_far_below_a_contact_is_that_below_a_point_force(solver, sizes, strain):
    """Largest at half the depth from the axis, far beyond the points next to the contact. A bulk
    strain, whose stress is as large at any distance, does not change it."""
    depth, force = 2e-3, 10.0  # of contacts with radii of 0.05 mm
    scene = scene_of(on_steel(depth, 21e10), Paraboloid(radius=3e-3, material=RIGID), force)
    state = state_of_result(slipstick.solve(scene, solver, sizes), 1).with_bodies_of(scene)
    state = replace(state, strain=(strain, strain, 0.0) if strain else None)
    field = body_response(state).stress()
    found = {(e.region, e.measure): e for e in extremes(field)}
    shear = found["interface 1 above", "interface_shear"]
    # Boussinesq: 3 W / 2π · r z² / (r² + z²)^(5/2), at r = z / 2 (Johnson 1985, eq. 3.19).
    expected = 3 * force / (2 * np.pi * depth**2) * 0.5 / 1.25**2.5
    assert not shear.at_window_edge
    assert np.max(np.hypot(field.points.x, field.points.y)) < 3 * depth
    assert_allclose(shear.value, expected, rtol=5e-3)
    assert_allclose(np.hypot(shear.x, shear.y), depth / 2, rtol=0.05)


def test_no_point_beside_a_contact_has_more_than_the_largest_stress():
    """On both sides of the interface of a thick soft layer, up to 200 contact radii away."""
    depth = 6e-3
    pushed = LoadStep(tangential_force=(50.0, 0.0))
    scene = frictional(on_steel(depth, 2e10), LARGE, LoadStep(normal_force=1e3), pushed)
    state = state_of_result(slipstick.solve(scene, "radial"), 2)
    response = OnDisc(state)
    found = {(e.region, e.measure): e for e in extremes(response.stress())}
    x = np.linspace(-0.2, 0.2, 81)
    for side, layer in (("above", 0), ("below", 1)):
        points = response.stress_at(x, 0 * x, [Level(depth, layer)] * len(x))
        for measure in ("max_principal", "max_shear", "von_mises"):
            largest = found[f"interface 1 {side}", measure]
            assert not largest.at_window_edge
            assert np.max(points.measures[measure]) <= (1 + 1e-3) * largest.value


def test_the_error_below_gross_slip_is_smaller_than_the_stress():
    """Two refinements of a maximum have depths that differ by round-off."""
    steps = LoadStep(normal_force=1e3, increments=8), LoadStep(tangential_force=(100.0, 0.0))
    scene = frictional(Body(material=STEEL), LARGE, *steps)
    result = slipstick.solve(scene, "radial")
    state = state_of_result(result, 2, slipstick.stated_errors(result))
    field = OnDisc(state).stress()
    largest = [e for e in extremes(field) if e.measure == "von_mises"]
    (error,) = stress_errors(state, field, largest)
    assert float(error.error) < 0.05 * largest[0].value


def test_rings_at_the_edge_of_a_contact_at_points_do_not_change_its_stress():
    """After a change of the normal load under torque, the tractions of single rings scatter."""
    steps = (LoadStep(normal_force=force, torque=0.01, increments=2) for force in (2.0, 1.8))
    state = state_of_result(slipstick.solve(frictional(BARE, BALL, *steps), "radial"), 2)
    outermost = np.hypot(*state.surface.positions) > 0.99 * state.pressed[1]
    pressure = state.tractions["pressure"]
    assert np.any(pressure[outermost] > 0)
    other = state.tractions | {"pressure": np.where(outermost, 2 * pressure, pressure)}
    at = np.array([0.0, 0.9]), np.zeros(2), [Level(0.1, 0)] * 2
    found = [
        OnDisc(replace(state, tractions=tractions)).stress_at(*at).stress
        for tractions in (state.tractions, other)
    ]
    assert_allclose(*found, rtol=1e-12)


A_BARE = 0.86e-3  # contact radius without layer [m]
TWO_LAYERS = on_steel(0.9 * A_BARE, 2.4e11).layers + on_steel(0.16 * A_BARE, 1.2e12).layers


OTHER_LAYERS = tuple(
    Layer(thickness=h, material=IsotropicMaterial(young_modulus=modulus, poisson_ratio=nu))
    for h, modulus, nu in ((3.397e-4, 2.444e11, 0.197), (6.276e-5, 1.186e12, 0.281))
)


@pytest.mark.parametrize(
    ("body", "upper"),
    [
        (on_steel(0.4 * A_BARE, 2e10), RIGID),
        (on_steel(8.0 * A_BARE, 2e10), RIGID),
        (Body(material=STEEL, layers=TWO_LAYERS), RIGID),
        (Body(material=STEEL, layers=OTHER_LAYERS), STEEL),
    ],
)
def test_cells_have_the_largest_stresses_of_the_radial_solver(body, upper):
    """Also where the tension of an interface begins beyond the first window, in a base that begins
    below the usual depths, and between the points of sections and depths."""
    scene = scene_of(body, Paraboloid(radius=18e-3, material=upper), 1e3)
    named = []
    for solver, sizes in (
        ("semi-analytical", SurfaceDiscretisation(cells=(48, 48))),
        ("radial", None),
    ):
        state = state_of_result(slipstick.solve(scene, solver, sizes), 1)
        field = body_response(state).stress()
        assert field.shown[1] <= 3.01 * state.contact_radius  # deeper points are not drawn
        named.append({(one.region, one.measure): one for one in extremes(field)})
    cells, rings = named
    highest = rings["body", "von_mises"].value
    assert all(rings[key].value < 1e-4 * highest for key in rings.keys() - cells.keys())
    for key, one in cells.items():
        assert not one.at_window_edge
        allowed = 0.005 if one.depth else 0.03
        assert_allclose(one.value, rings[key].value, rtol=allowed, err_msg=str(key))


@pytest.mark.parametrize("depth", [-1e-3, np.inf, np.nan])
def test_a_depth_outside_the_body_is_refused(depth):
    state = state_of_result(radial.solve(scene_of(BARE)), None)
    with pytest.raises(ValueError, match="got a depth of"):
        OnDisc(state, False).stress([0.5, depth])
