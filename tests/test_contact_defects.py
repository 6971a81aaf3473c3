"""Tests that errors planted in the contact solver are seen in its results, without its residuals.

Each error is planted in the shared laws or in Newton's method, while the residuals by which the
solver judges itself are zero. `observed` then evaluates the laws of contact and friction from the
fields of the result. A solve that fails loudly gives no result, which counts as seen.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from contact_scenes import LIMIT, PRESS, A, grid, push, scene, slide
from coupled_scenes import press
from coupled_scenes import push as push_coupled
from coupled_scenes import scene as coupled_scene

from contact_scene import Scene
from contact_scene.quantities.residuals import Residuals, ShearResiduals
from contact_scene.solver_errors import NotConverged
from contact_solver import admissible_pressure, admissible_shear, pressure, residuals, shear
from contact_solver.pressure import PressureProblem
from contact_solver.rigid_motion import MotionShapes
from semi_analytical import solve
from semi_analytical.coupled import coupled_increment
from semi_analytical.increments import tangential_solve, tangential_state
from semi_analytical.increments.normal_target import NormalTarget
from verification.defects.defect import Defect, Replacement, Replacements, planted, replaces
from verification.observed.observed_laws import observed

TOLERANCE = 1e-8
# A law is violated beyond the tolerance of the solver and the norms of `observed`.
SEEN = 1e-6

BLIND = (
    *(
        Replacement(residuals, name, lambda whole, *given: 0.0)
        for name in ("complementarity", "penetration", "friction_cone", "slip_direction")
    ),
    Replacement(Residuals, "worst", lambda whole, self: 0.0),
    Replacement(ShearResiduals, "worst", lambda whole, self: 0.0),
)

TORQUE = 0.5 * LIMIT * A
SCENES = {
    "pressed": scene(PRESS, {"normal_force": 500.0}, friction=None),
    "tilted": scene({**PRESS, "moment": (0.1 * A * 1e3, 0.05 * A * 1e3)}, friction=None),
    "pushed": scene(PRESS, push(0.7), push(-0.2, 0.5, increments=3)),
    "slid": scene(PRESS, slide(1), slide(-0.5, 0.3)),
    "twisted": scene(PRESS, {"torque": TORQUE, "increments": 2}),
    "coupled": coupled_scene(press(increments=2), push_coupled(0.5, 0.2, increments=2)),
}


def outcome(described: Scene, defect: Replacements) -> float:
    """Largest violation of a law in the result of a planted error; infinite for a loud failure."""
    with planted(Defect("planted", "Planted.", (), (*defect, *BLIND))), np.errstate(all="ignore"):
        try:
            result = solve(described, grid(32), TOLERANCE)
        except NotConverged:
            return np.inf
    found = observed(result)
    return max(found.violation, found.imbalance)


@replaces(admissible_shear, "natural_shear")
def _shear_accepted_at_once(whole: Any, *given: Any) -> Any:
    return whole(*given)._replace(error=0.0)


@replaces(admissible_shear, "natural_shear")
def _motion_of_wrong_sign(whole: Any, *given: Any) -> Any:
    found = whole(*given)
    return found._replace(motion=-found.motion)


@replaces(admissible_shear, "natural_shear")
def _slip_of_wrong_sign(whole: Any, motions: Any, q: Any, apart: Any, *rest: Any) -> Any:
    return whole(motions, q, -apart, *rest)


@replaces(MotionShapes, "forces")
def _moments_long(whole: Any, self: Any, tractions: Any) -> Any:
    varies = np.arange(len(self)) >= len(self.uniform)
    return whole(self, tractions) * np.where(varies, 1.001, 1.0)


@replaces(coupled_increment, "coupled_problem")
def _limit_of_other_pressure(whole: Any, *given: Any) -> Any:
    problem = whole(*given)
    return replace(problem, friction_limit=lambda p: problem.friction_limit(0.99 * p))


@replaces(coupled_increment, "coupled_problem")
def _slope_dropped(whole: Any, *given: Any) -> Any:
    return replace(whole(*given), friction_slope=np.zeros_like)


@replaces(pressure, "close_gap")
def _contact_never_grows(whole: Any, problem: Any, contact: Any, start: Any, *rest: Any) -> Any:
    return whole(problem, contact & (start.tractions > 0), start, *rest)


@replaces(shear, "zones_at")
def _slip_compliance_dropped(whole: Any, *given: Any) -> Any:
    zones = whole(*given)
    return replace(zones, slip_compliance=np.zeros_like(zones.slip_compliance))


@replaces(shear, "zones_at")
def _zones_not_updated(whole: Any, contact: Any, z: Any, *rest: Any) -> Any:
    return whole(contact, np.roll(z, 1, axis=1), *rest)


# A scene whose result shows the error, and the error.
PLANTED: dict[str, tuple[str, Replacements]] = {
    "slip of the wrong sign": ("slid", _slip_of_wrong_sign),
    "rigid motion of the wrong sign": ("pushed", _motion_of_wrong_sign),
    "shear accepted at once": ("slid", _shear_accepted_at_once),
    "history of the surface forgotten": (
        "pushed",
        replaces(tangential_state, "surface_target")(lambda whole, *given: 0.0 * whole(*given)),
    ),
    "friction limit of another pressure": (
        "pushed",
        replaces(tangential_solve, "shear")(
            lambda whole, model, bound, *rest: whole(model, 0.99 * bound, *rest)
        ),
    ),
    "friction limit of another pressure, coupled": ("coupled", _limit_of_other_pressure),
    "force counted short": (
        "pressed",
        replaces(admissible_pressure, "admissible_pressure")(
            lambda whole, *given: 0.999 * whole(*given)
        ),
    ),
    "torque counted short": ("twisted", _moments_long),
    "moment counted short": ("tilted", _moments_long),
    "tension kept": (
        "pressed",
        replaces(admissible_pressure, "admissible_pressure")(
            lambda whole, held, p, allowed: p * held.prescribed_forces[0] / np.sum(p)
        ),
    ),
    "overlap without contact": (
        "pressed",
        _contact_never_grows + replaces(PressureProblem, "residual")(lambda whole, *given: 0.0),
    ),
    "tilt not closed": (
        "tilted",
        replaces(NormalTarget, "reached")(
            lambda whole, self, model, motion: whole(self, model, motion * (1.0, 0.99, 1.0))
        ),
    ),
}


@pytest.mark.parametrize("error", PLANTED)
def test_planted_error_is_seen_in_the_result(error: str) -> None:
    name, defect = PLANTED[error]
    assert outcome(SCENES[name], defect) > SEEN


@pytest.mark.parametrize("name", SCENES)
def test_without_error_nothing_is_seen(name: str) -> None:
    assert outcome(SCENES[name], ()) < 10 * TOLERANCE


# Errors of Newton's method that leave the solution as it is, and cost steps.
COSTLY: dict[str, tuple[str, Replacements]] = {
    "slope of the friction limit dropped": ("coupled", _slope_dropped),
    "zones not updated": ("pushed", _zones_not_updated),
    "slip compliance dropped": ("pushed", _slip_compliance_dropped),
}


def convolutions(described: Scene) -> float:
    try:
        increments = solve(described, grid(32), TOLERANCE).increments
    except NotConverged:
        return np.inf
    return float(sum(increment.convolutions for increment in increments))


@pytest.mark.parametrize("error", COSTLY)
def test_planted_error_of_newtons_method_costs_steps(error: str) -> None:
    """1.6 times the convolutions for the slope, 3 times for the slip compliance."""
    name, defect = COSTLY[error]
    sound = convolutions(SCENES[name])
    with planted(Defect("planted", "Planted.", (), defect)):
        assert convolutions(SCENES[name]) > 1.3 * sound
