"""Pressing with friction by finite elements: pressure and radial shear act on each other."""

import numpy as np
import pytest
from contact_scenes import LOAD, MU, NU, PRESS, RADIUS, RIGID_BALL, YOUNG, grid, scene
from fem_scenes import both_laws, elements, end, solved

import semi_analytical
from contact_scene import IsotropicMaterial, Scene
from fem_reference import Method, solve
from verification.closed_forms.hertz import PointContact

BODY = IsotropicMaterial(young_modulus=YOUNG, poisson_ratio=NU)
HERTZ = PointContact.under_load(LOAD, RADIUS, BODY.plane_strain_modulus)


def pressed(friction: float | None = MU, increments: int = 20, indenter=RIGID_BALL) -> Scene:
    steps = {**PRESS, "increments": increments}
    return scene(steps, indenter=indenter, body=BODY, friction=friction)


def test_vanishing_friction_is_no_friction() -> None:
    smooth, slippery, none = (end(pressed(mu, 4)) for mu in (None, 1e-9, 0.0))
    assert slippery.approach == pytest.approx(smooth.approach, rel=1e-9)
    assert none.approach == pytest.approx(smooth.approach, rel=1e-12)
    assert none.shear_radial is None
    assert np.max(np.abs(slippery.shear_radial)) <= 1e-9 * HERTZ.peak_pressure


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
