"""Stated errors of finite-element results: they hold the closed forms, and say what they are of."""

from dataclasses import replace

import numpy as np
import pytest
from contact_scenes import INDENTERS, LOAD, PRESS, RIGID_BALL, A, hertz, push, scene, steel
from fem_scenes import elements

import contact_errors.on_elements as on_elements
import radial
from contact_errors.of_stress import stress_errors
from contact_errors.on_elements import stated_errors
from contact_results.quantities import shift_along_x
from contact_results.stress.extremes import extremes
from contact_results.stress.loaded_bodies import LoadedBodies, state_of_result
from contact_results.stress.on_section import stress_on_section
from contact_scene import RIGID, Body, FlatPunch, IsotropicMaterial, Layer, Scene
from contact_scene.solver_errors import SolverError
from contact_scene.stated_error import ErrorStatus
from fem_reference import Method, solve
from verification.closed_forms.cattaneo_mindlin import PartialSlip
from verification.closed_forms.coated_indentation import paraboloid as pressed_coating
from verification.closed_forms.huber_stress import axis_stress
from verification.closed_forms.moduli import tangential_modulus
from verification.problems.layered_scene import surface_of

SMOOTH = scene(PRESS, friction=None)
LOOSE = steel(0.0)
FILM = Layer(thickness=A, material=steel())
COATED = Body(material=steel(young_modulus=0.5 * LOOSE.young_modulus), layers=(FILM,))


def error(stated, name, step=0):
    return stated.steps[step][name].error


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("per_radius", [8, 11, 16, 23, 32])
def test_errors_hold_the_closed_form(per_radius: int, method: Method) -> None:
    result, exact = solve(SMOOTH, elements(per_radius), method), hertz()
    stated, end = stated_errors(result), result.steps[-1]
    for name in ("approach", "peak_pressure", "contact_radius"):
        off = abs(getattr(end, name) - getattr(exact, name))
        assert off <= error(stated, name)
        if name != "contact_radius":  # its mesh is laid out for the exact one
            assert error(stated, name) < 10 * off
        assert stated.steps[0][name].status is ErrorStatus.ESTIMATED


@pytest.mark.parametrize("method", Method)
@pytest.mark.parametrize("times", [0.5, 8.0, 250.0])
def test_a_radius_that_the_mesh_was_laid_out_for_in_vain_decides_no_answer(
    times: float, method: Method
) -> None:
    """What is stated holds, or the contact is told to have been missed."""
    try:
        result = solve(SMOOTH, elements(16, contact_radius=times * A), method)
    except SolverError:
        assert times != 8.0
        return
    stated, exact = stated_errors(result), hertz()
    assert abs(result.steps[0].approach - exact.approach) <= error(stated, "approach")


@pytest.mark.parametrize("method", Method)
def test_errors_of_partial_slip_hold_the_closed_form(method: Method) -> None:
    asked = scene(PRESS, push(0.5), push(0.8), indenter=replace_material(LOOSE), body=LOOSE)
    result = solve(asked, elements(16), method)
    stated = stated_errors(result)
    modulus = tangential_modulus((LOOSE.young_modulus, 0.0), (LOOSE.young_modulus, 0.0))
    a = hertz(poisson_ratio=0.0).contact_radius
    for step, part in ((1, 0.5), (2, 0.8)):
        exact = PartialSlip(LOAD, a, 0.1, modulus, part * 0.1 * LOAD)
        end = result.steps[step]
        (shift, _), stick = error(stated, "tangential_shift", step), "stick_radius"
        assert abs(shift_along_x(end) - exact.shift) <= shift
        assert abs(end.stick_radius - exact.stick_radius) <= error(stated, stick, step)
        assert stated.steps[step]["tangential_force"].status is ErrorStatus.EXACT


@pytest.mark.parametrize(
    ("edge", "coefficient", "no_root", "method"),
    [
        *((8.5, 0.1, None, method) for method in Method),
        (12.0, 0.4, None, Method.COMPLEMENTARITY),
        (8.5, 0.1, "the contact ends at a rim", Method.PENALTY),
    ],
)
def test_the_error_of_stress_covers_the_trailing_edge(
    edge: float, coefficient: float, no_root: str | None, method: Method
) -> None:
    """The shear of full slip on a pressure whose edge lies there in elements; Hamilton (1983), eq.
    for x = -a. Linear between rings it is far too low."""
    count = int(edge)
    result = solve(SMOOTH, elements(count, contact_radius=count / edge * A), method)
    state = state_of_result(result, None, stated_errors(result))
    pressure = state.tractions["pressure"]
    sliding = state.tractions | {"shear_along_load": coefficient * pressure}
    found, error = largest(replace(state, tractions=sliding, no_root=no_root))
    exact = hertz().peak_pressure * ((1 - 0.6) / 3 + np.pi * coefficient * (4 + 0.3) / 8)
    off = exact - found["max_principal"]
    assert abs(off) <= error["max_principal"]
    if no_root:
        assert 0.1 * exact < off
    else:
        assert abs(off) < 0.02 * exact
        assert error["max_principal"] < 0.1 * exact


@pytest.mark.parametrize("per_radius", [8, 11])
def test_the_error_of_stress_covers_what_is_wrong_inside(per_radius: int) -> None:
    result, depth = solve(SMOOTH, elements(per_radius)), np.linspace(0.3, 0.7, 401) * A
    found, error = largest(state_of_result(result, None, stated_errors(result)))
    inside = axis_stress(depth, A, hertz().peak_pressure, 0.3)
    exact = np.max(np.abs(inside.radial - inside.axial))
    assert abs(found["von_mises"] - exact) <= error["von_mises"] < 0.05 * exact


def largest(state: LoadedBodies) -> tuple[dict[str, float], dict[str, float]]:
    """The largest stresses of the body and their errors, by measure."""
    field = stress_on_section(state)
    found = extremes(field, state.body)
    stated = stress_errors(state, field, found)
    return (
        {e.measure: e.value for e in found},
        {e.measure: one.error for e, one in zip(found, stated, strict=True)},
    )


def replace_material(material: IsotropicMaterial):
    return INDENTERS["paraboloid"].model_copy(update={"material": material})


@pytest.mark.parametrize(("thickness", "known"), [(0.21, True), (0.15, False)])
def test_the_error_of_the_radius_below_a_film_counts_its_elements(
    thickness: float, known: bool
) -> None:
    """Fewer than two over the thickness do not know it."""
    film = Layer(thickness=thickness * A, material=steel(young_modulus=7.2 * LOOSE.young_modulus))
    body = Body(material=LOOSE, layers=(film,))
    contact = pressed_coating(surface_of(body), RIGID_BALL.radius, A)
    asked = Scene(indenter=RIGID_BALL, body=body, loading=({"normal_force": contact.load},))
    for method in Method:
        result = solve(asked, elements(11), method)
        (errors,) = stated_errors(result).steps
        of_radius = errors["contact_radius"]
        assert (of_radius.status is ErrorStatus.ESTIMATED) is known
        assert abs(result.steps[0].contact_radius - A) <= of_radius.error
        assert errors["approach"].status is ErrorStatus.ESTIMATED


def test_the_error_of_the_peak_covers_what_springs_press_on_the_rim_of_a_film() -> None:
    """A third of an element thick and a hundred times as stiff, it stands on its last ring."""
    film = Layer(thickness=0.0137 * A, material=steel(young_modulus=100 * LOOSE.young_modulus))
    body = Body(material=LOOSE, layers=(film,))
    asked = Scene(indenter=RIGID_BALL, body=body, loading=({"normal_force": LOAD},))
    exact = radial.solve(asked).steps[0].peak_pressure
    result = solve(asked, elements(16), Method.PENALTY)
    off = abs(result.steps[0].peak_pressure - exact)
    assert off > 0.2 * exact
    stated = stated_errors(result)
    assert off <= error(stated, "peak_pressure")
    assert stated.steps[0]["peak_pressure"].status is ErrorStatus.NOT_CONVERGED


def on_film(stiffer: float, thickness: float, increments: int | None = None, **friction: float):
    """The ball on a film so many times as stiff as its base, of so many radii."""
    film = Layer(
        thickness=thickness * A, material=steel(young_modulus=stiffer * LOOSE.young_modulus)
    )
    return Scene(
        indenter=RIGID_BALL,
        body=Body(material=LOOSE, layers=(film,)),
        loading=({**PRESS, "increments": increments} if increments else PRESS,),
        friction=friction or None,
    )


def test_the_error_of_the_peak_is_more_than_what_two_coarse_meshes_have_alike_by_chance() -> None:
    """Neither has a ring on which the film stands."""
    result = solve(on_film(100, 0.01), elements(16), Method.PENALTY)
    exact = radial.solve(result.scene).steps[0].peak_pressure
    stated = stated_errors(result)
    assert 1e-3 * exact < abs(result.steps[0].peak_pressure - exact)
    assert abs(result.steps[0].peak_pressure - exact) <= error(stated, "peak_pressure")
    assert stated.steps[0]["peak_pressure"].status is ErrorStatus.NOT_CONVERGED


def test_what_is_lost_on_the_rim_of_a_film_thinner_than_elements_is_said_not_to_be_known() -> None:
    """Far too much of it, however fine the increments; peaks there are not told at all."""
    exact = radial.solve(on_film(100, 0.03, 2, coefficient=1.0)).steps[0].dissipated_energy
    result = solve(on_film(100, 0.03, 80, coefficient=1.0), elements(13))
    (errors,) = stated_errors(result).steps
    lost = errors["dissipated_energy"]
    off = abs(result.steps[0].dissipated_energy - exact)
    assert exact < off <= lost.error
    assert lost.status is ErrorStatus.NOT_CONVERGED
    assert errors["peak_pressure"].error is None
    assert errors["approach"].status is ErrorStatus.ESTIMATED


def test_slip_narrower_than_half_an_element_tells_nothing_of_what_is_lost_on_a_film() -> None:
    """In finer increments it misses nearly all of it."""
    result = solve(on_film(0.1, 0.1, 20, coefficient=1.0), elements(8))
    (errors,) = stated_errors(result).steps
    assert errors["dissipated_energy"].error is None
    assert errors["approach"].status is ErrorStatus.ESTIMATED


def test_a_companion_whose_springs_give_way_more_than_those_of_the_run_still_tells_errors() -> None:
    result = solve(on_film(0.1, 0.01, 4, coefficient=1.0), elements(16), Method.PENALTY)
    stated = stated_errors(result)
    assert all(companion.refused is None for companion in stated.companions)
    truth = solve(on_film(0.1, 0.01, 64, coefficient=1.0), elements(64)).steps[0]
    assert abs(result.steps[0].approach - truth.approach) <= error(stated, "approach")


PUSHED_ON_A_COATING = Scene(
    indenter=RIGID_BALL,
    body=COATED,
    friction={"coefficient": 0.1},
    loading=[{**PRESS, "increments": 4}, {**push(0.5), "increments": 4}],
)


def test_errors_by_harmonics_hold_what_four_times_as_many_change() -> None:
    few, many = (
        solve(PUSHED_ON_A_COATING, elements(8, harmonics=n), Method.PENALTY) for n in (2, 8)
    )
    errors = stated_errors(few).steps[1]
    one, other = few.steps[1], many.steps[1]
    moved = abs(shift_along_x(one) - shift_along_x(other))
    assert 1e-3 * shift_along_x(other) < moved <= errors["tangential_shift"].parts["harmonics"][0]
    grown = abs(one.stick_radius - other.stick_radius)
    assert grown <= errors["stick_radius"].parts["harmonics"]


def test_parts_say_what_they_are_of() -> None:
    result = solve(PUSHED_ON_A_COATING, elements(8, harmonics=4), Method.PENALTY)
    stated = stated_errors(result)
    made = [companion.differs for companion in stated.companions]
    assert made == [
        "half the elements",
        "half the elements, other increments",
        "half the elements, half as many harmonics again",
    ]
    parts = stated.steps[1]["tangential_shift"].parts
    assert set(parts) == {
        *("elements", "section", "penalty", "increments", "harmonics", "tolerance"),
    }
    assert "harmonics" not in stated.steps[0]["approach"].parts
    # Sectors that stick or slip as a whole leave more in the stick radius than in the motion.
    of_stick, of_shift = (stated.steps[1][name] for name in ("stick_radius", "tangential_shift"))
    share = of_shift.parts["harmonics"][0] / shift_along_x(result.steps[1])
    assert of_stick.parts["harmonics"] / result.steps[1].stick_radius > share


def test_small_sections_and_soft_springs_enlarge_the_error() -> None:
    usual = elements(16, contact_radius=A)
    for method, worse, part in (
        (Method.COMPLEMENTARITY, {"box": 5.0}, "section"),
        (Method.PENALTY, {"overlap": 1.0, "augmentations": 0}, "penalty"),
    ):
        own, other = (
            stated_errors(solve(SMOOTH, mesh, method)).steps[0]["approach"]
            for mesh in (usual, usual.model_copy(update=worse))
        )
        assert other.parts[part] > 3 * own.parts[part]


def test_contact_smaller_than_an_element_has_no_error_to_state() -> None:
    asked = scene(PRESS, {"normal_force": 1e-6 * LOAD}, friction=None)
    stated = stated_errors(solve(asked, elements(16)))
    assert stated.steps[0]["approach"].status is ErrorStatus.ESTIMATED
    assert stated.steps[1]["approach"].status is ErrorStatus.NOT_CONVERGED
    assert stated.steps[1]["approach"].error is None


def test_an_error_a_tenth_as_large_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    rules = on_elements.rules_of_elements

    def tenth(*asked):
        return {n: replace(r, factor=0.1 * r.factor) for n, r in rules(*asked).items()}

    monkeypatch.setattr(on_elements, "rules_of_elements", tenth)
    result, exact = solve(SMOOTH, elements(16)), hertz()
    stated = stated_errors(result)
    off = abs(result.steps[-1].approach - exact.approach)
    assert off > error(stated, "approach")


def test_slip_that_no_element_sees_is_not_converged() -> None:
    """Some slips at the edge under any force; none is seen where its annulus is too narrow."""
    asked = scene(PRESS, push(0.01), indenter=replace_material(LOOSE), body=LOOSE)
    result = solve(asked, elements(8))
    assert result.steps[1].dissipated_energy == 0
    stated = stated_errors(result)
    assert stated.steps[0]["dissipated_energy"].status is ErrorStatus.ESTIMATED
    assert stated.steps[1]["dissipated_energy"].status is ErrorStatus.NOT_CONVERGED


def test_springs_below_a_rim_know_no_error_of_the_energy_stored() -> None:
    """It falls as the root of the elements and below: 10, 7 and 5 % on 8, 16 and 32."""
    punch = FlatPunch(radius=A, material=RIGID)
    asked = scene({"normal_force": LOAD}, indenter=punch, friction=None)
    for method, known in ((Method.PENALTY, False), (Method.COMPLEMENTARITY, True)):
        (errors,) = stated_errors(solve(asked, elements(8), method)).steps
        assert (errors["elastic_energy"].error is not None) is known
        assert errors["approach"].error is not None
