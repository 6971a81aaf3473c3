"""Tests of the errors of stresses: they cover the true errors of largest stresses and of points."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from contact_scenes import (
    PRESS,
    YOUNG,
    A,
    grid,
    hertz,
    paraboloid,
    push,
    scene,
    steel,
)
from error_scenes import cells, indented, size
from fem_scenes import elements

import slipstick as package
from contact_errors.stress_errors import (
    SMALL_STICK,
    THIN_LAYER,
    largest_stresses,
    stress_at,
    stress_errors,
)
from contact_results.stress.below_contact import body_response
from contact_results.stress.loaded_bodies import LoadedBodies, state_of_result, state_of_run
from contact_results.stress.on_cells import OnCells
from contact_results.stress.stress_maxima import extremes
from contact_scene import (
    RIGID,
    Body,
    Cone,
    Cylinder,
    FiniteElementDiscretisation,
    Layer,
    LoadStep,
    RadialDiscretisation,
    Strip,
    SurfaceDiscretisation,
)
from contact_scene.quantities.stated_error import (
    ErrorStatus,
)
from radial.discretised import RingSolver
from semi_analytical import solve
from semi_analytical.frf.depth import Level
from slipstick import stated_errors
from verification.closed_forms.huber_stress import huber_stress, trailing_edge_tension


def largest_tension(result):
    """Of the body, at the end."""
    of_body = largest_stresses(result, stated_errors(result), ["max_principal@body"])
    ((value, error),) = of_body.values()
    return value, error


@pytest.mark.slow
@pytest.mark.parametrize("count", [24, 48])
def test_an_edge_that_may_have_the_largest_stress_leaves_it_open(count):
    """A stiff film pushed along: 2.0 GPa behind the contact, 1.6 GPa inside."""
    radius = (3 * 150 * 0.011 * (1 - 0.3**2) / 4 / 210e9) ** (1 / 3)
    film = Layer(thickness=0.4 * radius, material=steel(0.2, 840e9))
    push_ = LoadStep(tangential_force=(0.6 * 0.3 * 150, 0.0))
    posed = indented(0.011, 150.0, film, steel(0.3, 210e9), 0.3, push_)
    result = package.solve(posed, "semi-analytical", cells(count))
    value, error = largest_tension(result)
    assert error.status is ErrorStatus.NOT_CONVERGED or abs(value - 2.0e9) <= size(error)


@pytest.mark.parametrize(
    ("thickness", "modulus", "count", "widest"),
    [
        (0.04, 600e9, 24, 0.1),
        (0.4, 420e9, 48, 0.05),
    ],
)
def test_the_tension_at_a_coating_pressed_without_friction_is_known(
    thickness, modulus, count, widest
):
    """A film thinner than a cell, whose pressure the cells do not resolve, and a thicker one."""
    film = Layer(thickness=thickness * A, material=steel(0.25, modulus))
    posed = indented(0.018, 1e3, film, steel(0.3, 210e9), None)
    result = package.solve(posed, "semi-analytical", cells(count))
    value, error = largest_tension(result)
    by_rings = package.solve(posed, "radial")
    ((exact, _),) = largest_stresses(by_rings, None, ["max_principal@body"]).values()
    assert error.status is ErrorStatus.ESTIMATED
    assert abs(value - exact) <= size(error) <= widest * exact


def test_a_strain_of_one_direction_is_not_compared_with_a_contact_of_revolution():
    """The tension at the edge along the pull: that of Huber (1904) and that of the strain."""
    pull = 1e-3
    ball = paraboloid(steel(0.3))
    posed = scene(
        {**PRESS, "bulk_strain": (0.0, pull, 0.0)}, indenter=ball, body=steel(0.3), friction=None
    )
    value, error = largest_tension(package.solve(posed, "semi-analytical", cells(32)))
    pressed = hertz(poisson_ratio=0.3).peak_pressure * (1 - 2 * 0.3) / 3
    exact = pressed + pull * YOUNG / (1 - 0.3**2)
    assert error.status is ErrorStatus.ESTIMATED
    assert abs(value - exact) <= size(error) <= 0.05 * exact


def test_a_stress_below_a_tip_is_not_converged_near_the_surface():
    posed = scene(PRESS, indenter=Cone(slope_angle=0.02, material=RIGID), friction=None)
    result = package.solve(posed, "semi-analytical", cells(24))
    names = ["von_mises@body", "max_shear@body"]
    found = [e for _, e in largest_stresses(result, stated_errors(result), names).values()]
    assert [error.status for error in found] == [ErrorStatus.NOT_CONVERGED] * len(names)
    assert all("infinite" in error.reason for error in found)


def largest_on_axis(nu: float) -> float:
    """Largest von Mises stress below Hertz's contact over its peak pressure (Huber 1904)."""
    stress = huber_stress(0.0, np.linspace(0.3, 0.7, 40001), 1.0, 1.0, nu)
    return float(np.max(np.abs(stress.axial - stress.radial)))


@cache
def pressed_ball() -> LoadedBodies:
    """Hertz's contact with its errors."""
    posed = scene(PRESS, indenter=paraboloid(steel(0.3)), body=steel(0.3))
    result = package.solve(posed, "semi-analytical", cells(64))
    return state_of_result(result, 1, stated_errors(result))


@pytest.mark.parametrize("deeper", [0.0, 0.03, 0.06, 0.09, 0.13])
def test_a_largest_stress_between_depths_is_covered(deeper):
    """Below Hertz's contact the stress on the axis is known (Johnson 1985, eq. 3.45)."""
    state = pressed_ball()
    depths = [z * A for z in (0.0, 0.2, 0.35 + deeper, 0.55 + deeper, 0.8, 1.2)]
    field = OnCells(state).stress(depths)
    found = [e for e in extremes(field) if e.measure != "max_principal"]
    assert found
    exact = hertz().peak_pressure * largest_on_axis(0.3)
    for extreme, error in zip(
        found, stress_errors(state, field, found, at_depths=True), strict=True
    ):
        largest = exact if extreme.measure == "von_mises" else exact / 2
        assert abs(extreme.value - largest) <= size(error) <= 0.05 * largest


def test_the_stress_at_depths_far_from_the_surface_is_covered():
    """Below Hertz's contact, where no edge is fitted and no depth is near the surface.

    The layer has an interface and hardly another modulus.
    """
    posed = scene(PRESS, indenter=paraboloid(steel(0.3)), body=steel(0.3))
    layer = Layer(thickness=1.2 * A, material=steel(0.3, YOUNG * (1 + 1e-6)))
    posed = posed.replace({"body": Body(material=steel(0.3), layers=(layer,))})
    state = state_of_result(solve(posed, grid(32), 1e-8), 1)
    field = OnCells(state).stress([A, 1.5 * A])
    (found,) = (e for e in extremes(field) if (e.measure, e.region) == ("von_mises", "body"))
    (error,) = stress_errors(state, field, [found], at_depths=True)
    stress = huber_stress(0.0, np.array([A]), A, hertz().peak_pressure, 0.3)
    exact = float(np.abs(stress.axial - stress.radial)[0])
    assert abs(found.value - exact) <= size(error) <= 0.02 * exact


@pytest.mark.parametrize("nu", [0.0, 0.3])
def test_a_largest_stress_between_the_depths_of_the_radial_solver_is_covered(nu):
    posed = scene(PRESS, friction=None, indenter=paraboloid(RIGID), body=steel(nu))
    result = package.solve(posed, "radial", RadialDiscretisation())
    ((found, error),) = largest_stresses(result, stated_errors(result), ["von_mises@body"]).values()
    exact = result.steps[-1].peak_pressure * largest_on_axis(nu)
    assert abs(found - exact) <= size(error) < 1e-8 * exact


def test_stress_near_the_surface_improves_slower_with_cells_than_that_below(monkeypatch):
    """The same change between cells leaves the larger error where the order is lower."""
    state = state_of_result(solve(scene(PRESS), grid(24), 1e-8), 1)
    depth = np.array([0.01 * A, A])
    monkeypatch.setattr(
        OnCells,
        "stress_at",
        lambda one, *_: SimpleNamespace(
            depth=depth, stress=np.full((6, 2), float(one.state is not state))
        ),
    )
    _, (near, below), _ = stress_at(state, depth, depth, [])
    assert near > 1.2 * below > 0


def test_a_stress_by_tractions_of_unknown_error_is_marked():
    """As in a run without errors; a contact that is pressed alone has no increment error."""
    result = solve(scene(PRESS, push(0.5)), grid(16), 1e-8)
    for step, expected in ((1, ErrorStatus.ESTIMATED), (2, ErrorStatus.NOT_CONVERGED)):
        state = state_of_result(result, step)
        field = OnCells(state).stress([0.0, 0.5 * A])
        (deepest, *_) = (e for e in extremes(field) if e.measure == "max_shear")
        (error,) = stress_errors(state, field, [deepest], at_depths=True)
        assert error.status is expected, error.reason


@pytest.mark.parametrize(
    ("solver", "share"),
    [("radial", 0.0), ("fem", 0.0), ("semi-analytical", 0.5)],
)
def test_the_shear_of_pressing_has_an_error_that_no_scalar_shows(solver, share):
    """All sticks, and few increments leave errors in the shear, which hardly changes peak pressure
    and approach. A load along the surface leaves this shear as it is."""
    friction, more = 0.9, share * 0.9e3
    asked = {
        "semi-analytical": cells(16),
        "fem": elements(32),
        "radial": RadialDiscretisation(rings=8),
    }

    def solved(increments):
        loads = [{"normal_force": 1e3}, *([{"tangential_force": (more, 0.0)}] if share else [])]
        posed = indented(0.018, 1e3, None, steel(0.2, 210e9), friction)
        posed = posed.replace({"loading": [{**load, "increments": increments} for load in loads]})
        return package.solve(posed, solver, asked[solver])

    name = "von_mises@body"
    exact, _ = largest_stresses(solved(24), None, [name])[name]
    result = solved(8)
    errors = stated_errors(result)
    value, error = largest_stresses(result, errors, [name])[name]
    part = error.parts["increments"]
    assert isinstance(part, float)
    assert abs(value - exact) < part < 0.5 * exact
    of_scalars = errors.steps[-1]["approach"].parts["increments"]
    assert of_scalars < 0.1 * part / exact * result.steps[-1].approach


def tractions_exact(state: LoadedBodies) -> LoadedBodies:
    """The state as if increments left no error."""
    return replace(state, by_increments=0.0, shear_error=0.0)


@pytest.mark.parametrize(
    ("films", "force", "resolved"),
    [((1.9,), 1e3, False), ((1.2, 1.2), 1e3, True), ((1.2,), 1e2, False), ((5.0, 1.0), 1e3, True)],
)
def test_elements_that_do_not_resolve_a_film_leave_its_stress_open(films, force, resolved):
    """Elements are those of the largest contact. Equal films are one, deep ones do not count."""
    layers = [{"thickness": film / 16 * A, "material": steel(0.3, 400e9)} for film in films]
    posed = indented(0.018, 1e3, None, steel(0.3, 210e9), 0.1, LoadStep(normal_force=force))
    posed = posed.replace({"body": {"material": steel(0.3, 210e9), "layers": layers}})
    asked = FiniteElementDiscretisation(elements_per_radius=16)
    result = package.solve(posed, "fem", asked)
    state = state_of_result(result, None)
    field = body_response(state).stress()
    errors = stress_errors(tractions_exact(state), field, extremes(field))
    assert any(error.reason == THIN_LAYER for error in errors) != resolved


@pytest.mark.parametrize("solver", ["semi-analytical", "fem"])
@pytest.mark.parametrize(("friction", "resolved"), [(0.02, False), (0.2, True)])
def test_a_small_stick_zone_leaves_the_stress_at_its_centre_open(solver, friction, resolved):
    posed = indented(0.018, 1e3, None, steel(0.2, 210e9), friction)
    asked = cells(48) if solver == "semi-analytical" else None
    state = state_of_result(package.solve(posed, solver, asked), 1)
    field = body_response(state).stress([0.0, 0.3 * A])
    centre = [replace(one, x=0.0, y=0.0, depth=0.0) for one in extremes(field)][:1]
    (error,) = stress_errors(tractions_exact(state), field, centre)
    assert (error.reason == SMALL_STICK) != resolved


def test_a_stress_below_shear_on_rings_has_the_error_of_its_tractions(tmp_path):
    push_ = LoadStep(tangential_force=(120.0, 0.0), increments=2)
    posed = indented(0.018, 1e3, None, steel(0.3, 210e9), 0.2, push_)
    solver = RingSolver(posed, RadialDiscretisation())
    run, fine = (solver.solve(replace(solver.run_fineness(), space=rings)) for rings in (0.8, 1.6))
    package.save(run, tmp_path / "run", figures="none")
    stored = state_of_run(tmp_path / "run", None)
    assert stored.ring_fineness == state_of_result(run, None).ring_fineness
    state = replace(stored, by_increments=0.0, shear_error=0.0)
    field = body_response(state).stress()
    found = extremes(field)
    known = extremes(body_response(state_of_result(fine, None)).stress())
    for rough, exact, error in zip(found, known, stress_errors(state, field, found), strict=True):
        assert abs(rough.value - exact.value) <= size(error) <= 0.1 * exact.value
    x = A * np.array([0.4, 0.94, 0.69, 0.69, 1.3])
    y = A * np.array([1.1, -1.42, 0.44, 0.57, -0.35])
    z = A * np.array([0.0, 0.49, 0.36, 0.23, 0.32])
    levels = [Level(float(depth), 0) for depth in z]
    here, errors, unknown = stress_at(state, x, y, levels)
    there, _, _ = stress_at(state_of_result(fine, None), x, y, levels, error=False)
    apart = np.max(np.abs(here.stress - there.stress), axis=0)
    assert np.all((apart <= errors) & (errors <= 10 * apart))
    assert not unknown


def test_a_run_without_its_number_of_rings_states_no_error_at_points():
    """As stored before the file had this number."""
    pushed = scene(PRESS, push(0.5, increments=1), body=steel())
    state = state_of_result(package.solve(pushed, "radial", RadialDiscretisation()), None)
    at, levels = np.array([0.1 * A]), [Level(0.1 * A, 0)]
    _, errors, unknown = stress_at(replace(state, ring_fineness=None), at, at, levels)
    assert np.all(np.isnan(errors))
    assert "run the scene again" in unknown


def test_a_largest_stress_may_be_another_maximum_of_its_region(monkeypatch):
    push_ = LoadStep(tangential_force=(50.0, 0.0), increments=1)
    posed = indented(
        0.018, 1e3, Layer(thickness=A, material=steel(0.3, 150e9)), steel(), 0.1, push_
    )
    state = state_of_result(package.solve(posed, "radial"), None)
    state = replace(state, by_increments=0.0, shear_error=0.0)
    field = body_response(state).stress([0.0, 0.5 * A])
    body, layer, surface = (
        next(one for one in extremes(field) if (one.region, one.measure) == (region, "von_mises"))
        for region in ("body", "layer 1", "surface")
    )
    monkeypatch.setattr(
        "contact_errors.stress_errors._below_other_rings",
        lambda *_: [(2.0, np.array([body.value, layer.value, 0.5 * surface.value]))],
    )
    *inside, above = stress_errors(state, field, [body, layer, surface])
    assert surface.value < layer.value == body.value
    exceeds = surface.value + size(above) - body.value
    assert [size(one) for one in inside] == pytest.approx([exceeds, exceeds])


def test_the_largest_tension_of_a_body_has_the_error_of_its_layer():
    push_ = LoadStep(tangential_force=(50.0, 0.0), increments=1)
    posed = indented(
        0.018, 1e3, Layer(thickness=A, material=steel(0.3, 150e9)), steel(), 0.1, push_
    )
    state = state_of_result(package.solve(posed, "radial"), None)
    field = body_response(replace(state, by_increments=0.0, shear_error=0.0)).stress([0.0])
    found = [one for one in extremes(field) if one.measure == "max_principal"][:2]
    assert [one.region for one in found] == ["body", "surface"]
    whole, part = stress_errors(state, field, found)
    assert size(whole) == pytest.approx(size(part))


@pytest.mark.parametrize(("friction", "count"), [(0.6, 32)])
def test_the_tension_behind_a_sliding_ball_is_covered(friction, count):
    """Its place is the trailing edge, where both the fit of the edge and its evaluation err."""
    slid = {"tangential_shift": (1e-4, 0.0)}
    posed = scene(PRESS, slid, indenter=paraboloid(steel()), friction=friction)
    value, error = largest_tension(package.solve(posed, "semi-analytical", cells(count)))
    exact = trailing_edge_tension(hertz().peak_pressure, friction, 0.3)
    assert error.status is ErrorStatus.ESTIMATED
    assert abs(value - exact) <= size(error) <= 0.01 * exact


@pytest.mark.parametrize(("nu", "count"), [(0.2, 32), (0.49, 32), (0.499, 32), (0.47, 100)])
def test_a_tension_near_zero_has_the_error_of_the_tractions(nu, count):
    """At the edge of Hertz's contact it is (1 - 2ν)/3 of the peak, however close ν is to ½."""
    posed = scene(PRESS, indenter=paraboloid(steel(nu)), body=steel(nu))
    result = package.solve(posed, "semi-analytical", cells(count))
    value, error = largest_tension(result)
    exact = (1 - 2 * nu) / 3 * hertz(poisson_ratio=nu).peak_pressure
    assert abs(value - exact) <= size(error) <= 0.01 * hertz().peak_pressure


def test_a_bare_cylinder_that_is_pressed_has_no_tension_but_round_off():
    """No principal stress below a pressed line contact of half-spaces is tensile."""
    cylinder = Cylinder(radius=0.018, material=steel())
    posed = scene({"normal_force": 1e6}, indenter=cylinder, body=steel(), friction=0.3)
    value, error = largest_tension(package.solve(posed, "semi-analytical"))
    assert abs(value) <= size(error) <= 1e-3  # [Pa]
    assert error.status is ErrorStatus.ESTIMATED


def test_the_error_of_a_stress_contains_that_of_a_small_section():
    """A stiff layer below a line contact bends the more, the farther its section reaches."""
    layer = Layer(thickness=2.5 * A, material=steel(young_modulus=8 * YOUNG))
    body = Body(material=steel(), layers=(layer,))
    strip = Strip(half_width=A, edge_radius=0.02, material=RIGID)
    posed = scene({"normal_force": 2e5}, indenter=strip, body=body, friction=None)
    on_strips = package.solve(posed, "semi-analytical", SurfaceDiscretisation(cells=256))
    exact, _ = largest_tension(on_strips)
    value, error = largest_tension(package.solve(posed, "fem", elements(16, box=15.0)))
    assert 0.1 * exact < abs(value - exact) <= size(error) < 0.3 * exact
    assert error.parts["section"] > error.parts["elements"]


@pytest.mark.parametrize(
    ("half_width", "edge_radius", "thickness", "stiffer"),
    [(0.5, 0.018, 0.5, 2.0), (1.0, 0.005, 1.0, 0.5)],
)
def test_the_force_at_an_unresolved_edge_is_not_spread_over_the_contact(
    half_width, edge_radius, thickness, stiffer
):
    """The pressure peak of a rounded edge lies within an element, and carries 5 % of the force."""
    layer = Layer(thickness=thickness * A, material=steel(young_modulus=stiffer * YOUNG))
    body = Body(material=steel(), layers=(layer,))
    strip = Strip(half_width=half_width * A, edge_radius=edge_radius, material=RIGID)
    posed = scene({"normal_force": 2e5}, indenter=strip, body=body, friction=None)
    on_strips = package.solve(posed, "semi-analytical", SurfaceDiscretisation(cells=256))
    name = "von_mises@base"
    ((exact, _),) = largest_stresses(on_strips, None, [name]).values()
    result = package.solve(posed, "fem", elements(12))
    ((value, error),) = largest_stresses(result, stated_errors(result), [name]).values()
    assert error is not None
    assert abs(value - exact) <= size(error) <= 0.02 * exact
