"""Pressing with friction by finite elements: pressure and radial shear act on each other."""

from math import log

import numpy as np
import pytest
from contact_scenes import LOAD, MU, NU, PRESS, RADIUS, RIGID_BALL, YOUNG, A, grid, scene
from fem_scenes import both_laws, elements, end, solved

import semi_analytical
from contact_scene import RIGID, FlatPunch, IsotropicMaterial, Scene
from contact_scene.summary import ContactStatus
from fem_reference import Increment, Method, solve
from verification.closed_forms.hertz import PointContact
from verification.references import load_reference

BODY = IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=NU)
HERTZ = PointContact.under_load(LOAD, RADIUS, BODY.plane_strain_modulus)
REFERENCE = {row["mu"]: row for row in load_reference("frictional_indentation_homogeneous")["rows"]}


def along_radius(found: Increment, traction, r):
    """Between the rings: squares of tractions are nearly linear in the square of the radius."""
    return np.sqrt(np.interp(r**2, found.radii**2, traction**2))


GLUE = 1e6  # a coefficient of friction that nothing overcomes


def pressed(friction: float | None = MU, increments: int = 20, indenter=RIGID_BALL) -> Scene:
    steps = {**PRESS, "increments": increments}
    return scene(steps, indenter=indenter, body=BODY, friction=friction)


# Elements per radius for the same accuracy of the shear. At Gauss points the shear ripples where
# the edge of stick has passed. At 16, 32, 64 elements and µ = 0.3 the largest error of q/µp₀ is
# 0.033, 0.021, 0.004; at nodes it is 0.011, 0.004, 0.002.
FOR_SHEAR = {Method.COMPLEMENTARITY: 32, Method.PENALTY: 64}


@both_laws
@pytest.mark.parametrize(("mu", "increments", "allowed"), [(0.1, 20, 5e-3), (0.3, 60, 1e-2)])
def test_self_similar_indentation(mu: float, increments: int, allowed: float, law: Method) -> None:
    row = REFERENCE[mu]
    a = row["a_over_aH"] * HERTZ.contact_radius
    found = end(pressed(mu, increments), FOR_SHEAR[law], law, contact_radius=a)
    assert found.contact_radius == pytest.approx(a, rel=2e-3)
    assert found.approach == pytest.approx(row["delta_over_deltaH"] * HERTZ.approach, rel=2e-4)
    assert found.stick_radius == pytest.approx(row["c_over_a"] * a, abs=0.02 * a)
    r = np.array(row["r_over_a"])
    judged = (r >= 0.1) & (r <= 0.85)
    p = along_radius(found, found.pressure, r * a) / HERTZ.peak_pressure
    q = along_radius(found, found.shear_radial, r * a) / (mu * HERTZ.peak_pressure)
    assert np.max(np.abs(p - row["p_over_pH"])[judged]) < 2e-3
    assert np.max(np.abs(q - row["q_over_mu_pH"])[judged]) < allowed


def test_shear_on_the_body_points_outwards() -> None:
    """Its surface moves towards the axis, and friction resists."""
    found = end(pressed())
    assert np.all(found.shear_radial >= 0)
    assert np.all(found.slip_radial <= 0)


@pytest.mark.parametrize("poisson_ratio", [0.0, 0.3])
def test_punch_that_does_not_slip(poisson_ratio: float) -> None:
    """The exact stiffness of Mossakovskii (1954), (1-ν) ln(3-4ν)/(1-2ν) of the frictionless."""
    nu = poisson_ratio
    body = IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=nu)
    punch = FlatPunch(radius=A, material=RIGID)
    found = end(scene(PRESS, indenter=punch, body=body, friction=GLUE))
    frictionless = 2 * body.plane_strain_modulus * A * found.approach
    stiffer = (1 - nu) * log(3 - 4 * nu) / (1 - 2 * nu)
    assert LOAD / frictionless == pytest.approx(stiffer, rel=2e-3)
    assert found.status is ContactStatus.FULL_STICK
    assert found.dissipated_energy == pytest.approx(0, abs=1e-12 * LOAD * found.approach)


def test_ball_that_does_not_slip() -> None:
    """κR and W/W_Hertz at fixed radius by superposition of punches; approach at fixed force."""
    found = end(pressed(GLUE, 80))
    assert found.approach == pytest.approx(
        1.0245802 / 1.0539106 ** (2 / 3) * HERTZ.approach, rel=1e-3
    )


def test_vanishing_friction_is_no_friction() -> None:
    smooth, slippery, none = (end(pressed(mu, 4)) for mu in (None, 1e-9, 0.0))
    assert slippery.approach == pytest.approx(smooth.approach, rel=1e-9)
    assert none.approach == pytest.approx(smooth.approach, rel=1e-12)
    assert none.shear_radial is None
    assert np.max(np.abs(slippery.shear_radial)) <= 1e-9 * HERTZ.peak_pressure


def test_more_friction_sticks_more_and_moves_less() -> None:
    found = [end(pressed(mu)) for mu in (0.05, 0.1, 0.2, 0.4)]
    assert np.all(np.diff([i.stick_radius for i in found]) > 0)
    assert np.all(np.diff([i.approach for i in found]) < 0)


@both_laws
@pytest.mark.parametrize("mu", [0.1, 1.0, 5.0])
@pytest.mark.parametrize("poisson_ratio", [-0.5, 0.0, 0.3, 0.45])
def test_equations_hold_however_strong_the_coupling(
    mu: float, poisson_ratio: float, law: Method
) -> None:
    body = IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=poisson_ratio)
    asked = scene({**PRESS, "increments": 5}, indenter=RIGID_BALL, body=body, friction=mu)
    result = solved(asked, law=law, overlap=1.0)
    for increment in result.increments:
        assert increment.residuals.worst < 1e-10
        assert np.all(np.abs(increment.shear_radial) <= mu * increment.pressure)


def test_uncoupled_bodies_carry_no_shear() -> None:
    assert end(scene(PRESS)).shear_radial is None


@both_laws
def test_unloading_dissipates_and_turns_the_shear(law: Method) -> None:
    there_and_back = scene(
        {**PRESS, "increments": 10}, {"normal_force": 0.05 * LOAD, "increments": 15},
        indenter=RIGID_BALL, body=BODY,
    )  # fmt: skip
    found = solved(there_and_back, law=law).increments
    energy = [increment.dissipated_energy for increment in found]
    assert np.all(np.diff(energy) >= 0)
    assert np.min(found[-1].shear_radial) < 0
    assert max(increment.residuals.worst for increment in found) < 1e-10


def test_work_is_stored_or_lost() -> None:
    """On the way there and back the indenter's work is what friction took, to first order in the
    increments; it is 1/240 of the work on the way there."""

    def missing(increments: int) -> float:
        steps = {**PRESS, "increments": increments}
        back = {"normal_force": 1e-4 * LOAD, "increments": increments}
        path = solved(scene(steps, back, indenter=RIGID_BALL, body=BODY)).increments
        W = np.array([0.0, *(i.normal_force for i in path)])
        delta = np.array([0.0, *(i.approach for i in path)])
        work = np.sum(0.5 * (W[1:] + W[:-1]) * np.diff(delta))
        return float(work / path[-1].dissipated_energy - 1)

    coarse, fine = missing(20), missing(160)
    assert abs(fine) < 0.02
    assert abs(fine) < 0.1 * abs(coarse)


@pytest.mark.parametrize("method", Method)
def test_energy_lost_is_as_uncertain_as_on_cells(method: Method) -> None:
    """Of a push: while a contact grows, cells count slip from before it. Of what is uncertain, four
    harmonics leave 5 %."""
    push = {"tangential_force": (0.7 * MU * LOAD, 0.0), "increments": 2}
    described = scene({**PRESS, "increments": 4}, push, indenter=RIGID_BALL, body=BODY)
    found = solve(described, elements(harmonics=4), method).steps
    radius = HERTZ.contact_radius
    on_cells = semi_analytical.solve(described, grid(32, 1.2, radius), 1e-7).steps
    for name, apart in (("dissipated_energy", 0.02), ("dissipation_uncertainty", 0.06)):
        one, other = (getattr(end, name) - getattr(start, name) for start, end in (found, on_cells))
        assert one == pytest.approx(other, rel=apart), name


@pytest.mark.parametrize(
    ("method", "aside"),
    [(Method.COMPLEMENTARITY, 0.0), (Method.PENALTY, 0.0), (Method.COMPLEMENTARITY, 0.4)],
    ids=["rings", "springs", "points"],
)
def test_slip_of_a_growing_contact_has_no_teeth(method: Method, aside: float) -> None:
    """It rises along the radius and falls: up and down again it goes by hardly more than twice its
    largest value. Charged for all of their motion, particles slip by up to five times that."""
    start = {"normal_force": 0.1 * LOAD, "increments": 1}
    grow = {**PRESS, "increments": 8, "tangential_force": (aside * 0.1 * LOAD, 0.0)}
    steps = [start, grow] if aside else [{**PRESS, "increments": 8}]
    described = scene(*steps, indenter=RIGID_BALL, body=BODY, friction=0.1)
    told = solve(described, elements(harmonics=2), method).increments[-1]
    slip = np.abs(told.slip_radial if told.angles is None else told.slip_radial[:, 0])
    slip = slip[told.radii < told.contact_radius]
    variation = np.sum(np.abs(np.diff(slip))) + slip[0] + slip[-1]
    assert variation < 2.1 * np.max(slip)


def test_slip_counts_from_touch_to_first_order_in_the_increments() -> None:
    def lost(increments: int) -> float:
        return float(end(pressed(0.1, increments)).dissipated_energy)

    coarse, fine, limit = lost(10), lost(40), lost(160)
    assert abs(coarse / limit - 1) < 0.02  # charged for all its motion, 0.08
    assert abs(fine - limit) < abs(coarse - limit) / 4


def test_many_increments_cost_little() -> None:
    """Deterministic: linear systems of some ten unknowns, and one sparse factorisation."""
    increments = solved(pressed(0.1, 60)).increments
    assert sum(i.iterations for i in increments) < 1500
    assert sum(i.factorizations for i in increments) == 1
    assert max(i.sweeps for i in increments) <= 12
