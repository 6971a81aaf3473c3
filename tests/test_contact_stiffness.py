"""Contact stiffnesses: derivatives of solved increments, closed forms, stated errors, requests."""

from itertools import product

import numpy as np
import pytest
from contact_scenes import LIMIT, LOAD, MU, NU, YOUNG, A, push, scene, steel

import slipstick
from contact_scene import Body, Layer, Scene
from contact_scene.rig import Rig
from contact_solver import tangent
from verification.closed_forms.hertz import contact_modulus, tangential_modulus

BODY = YOUNG, NU
NORMAL = 2 * contact_modulus(BODY, BODY) * A
STICK = 2 * tangential_modulus(BODY, BODY) * A
TWIST = 16 / 3 * YOUNG / (4 * (1 + NU)) * A**3
NAMES = "normal_stiffness", "tangential_stiffness", "torsional_stiffness"
FILM = Layer(thickness=A / 2, material=steel())
BODIES = {
    "alike": Body(material=steel()),
    "coated": Body(material=steel(0.2, YOUNG / 4), layers=[FILM]),
}
# Above the contact radius, by less than the change that another mesh would follow.
EDGES = {"alike": 1.1 * A, "coated": 1.4 * A}
SOLVERS = "semi-analytical", "fem-complementarity", "radial"
PRESS = {"normal_force": LOAD, "increments": 1}
TORQUE = 0.3 * LIMIT * A


def settings(solver, edge):
    if solver == "radial":
        return slipstick.RadialDiscretisation(tolerance=1e-11)
    if solver == "semi-analytical":
        window = (3 * edge, 3 * edge)
        return slipstick.SurfaceDiscretisation(
            cells=(24, 24), window=window, tolerance=1e-11, edge="off"
        )
    return slipstick.FiniteElementDiscretisation(
        elements_per_radius=6, contact_radius=edge, harmonics=6, tolerance=1e-10
    )


def requested(*steps, body="alike", rig=None, friction=MU) -> Scene:
    """Loading steps of one increment each, by their tables, with contact stiffnesses."""
    made = scene(*({"increments": 1} | step for step in steps), friction=friction)
    change = {"body": BODIES[body], "rig": rig, "contact_stiffness": True}
    return Scene.model_validate(dict(made) | change)


def ends(solver, *steps, body="alike", **kind):
    asked = requested(*steps, body=body, **kind)
    return slipstick.solve(asked, solver, settings(solver, EDGES[body])).steps


def difference(solver, last, names, *before, **kind) -> float:
    """Central difference of the force over the motion, by a changed load of the last step."""
    (key, value), change = next(iter(last.items())), 3e-6
    found = []
    for factor in (1 + change, 1 - change):
        end = ends(
            solver,
            *before,
            {key: tuple(np.multiply(value, factor))} if np.ndim(value) else {key: value * factor},
            **kind,
        )[-1]
        found.append([float(np.ravel(getattr(end, name))[0]) for name in names])
    (force, motion), (less, shorter) = found
    return (force - less) / (motion - shorter)


PUSHED = "tangential_force", "tangential_shift"
TURNED = "torque", "twist"
PRESSED = "normal_force", "approach"
SPRINGS = Rig(normal_stiffness=NORMAL / 2, tangential_stiffness=STICK / 3)
SHIFT = {"tangential_shift": (0.5 * LIMIT / STICK, 0.0)}
CASES = {
    "normal force": (PRESSED, [{"normal_force": 0.9 * LOAD}], {}),
    "normal force after a push": (PRESSED, [PRESS, push(0.4), {"normal_force": LOAD * 1.1}], {}),
    "tangential force": (PUSHED, [PRESS, push(0.7)], {}),
    "shift of an actuator": (PUSHED, [PRESS, SHIFT], {"rig": SPRINGS}),
    "gross slip": (PUSHED, [PRESS, {"tangential_shift": (3 * LIMIT / STICK, 0.0)}], {}),
    "torque": (TURNED, [PRESS, {"torque": TORQUE}], {}),
    "force beside a twist": (PUSHED, [PRESS, {"twist": TORQUE / TWIST} | push(0.2), push(0.5)], {}),
}


# Rings that follow the normal load have a moving edge, and no tangent. A rig and a twist beside a
# force enter all bodies alike.
ONCE = "normal force after a push", "shift of an actuator", "force beside a twist"
EVERY = [
    *product(("coated",), SOLVERS[:2], CASES),
    *product(("alike",), SOLVERS[:2], [name for name in CASES if name not in ONCE]),
    *(("alike", "radial", name) for name in ("gross slip", "torque", *ONCE[1:])),
    ("coated", "radial", "tangential force"),
]


@pytest.mark.parametrize(("body", "solver", "name"), EVERY)
def test_stiffness_is_the_derivative_of_the_solved_increment(body, solver, name):
    names, steps, kind = CASES[name]
    *before, last = steps
    end = ends(solver, *steps, body=body, **kind)[-1]
    exact = difference(solver, last, names, *before, body=body, **kind)
    kept = NAMES[(PRESSED, PUSHED, TURNED).index(names)]
    assert getattr(end, kept) == pytest.approx(exact, rel=1e-7, abs=1e-9 * STICK)


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("body", BODIES)
def test_a_kept_load_has_the_stiffness_of_full_stick(solver, body):
    slipped, held, reversed_ = ends(solver, PRESS, push(0.6), PRESS, push(0.599), body=body)[1:]
    assert held.tangential_stiffness == pytest.approx(reversed_.tangential_stiffness, rel=1e-3)
    assert slipped.tangential_stiffness < 0.9 * held.tangential_stiffness


def test_a_stalled_linear_solve_leaves_the_result(monkeypatch):
    monkeypatch.setattr(tangent, "MAX_ITERATIONS", 1)
    for body in BODIES:
        end = ends("semi-analytical", PRESS, push(0.5), body=body)[-1]
        assert end.tangential_stiffness is None
        assert end.tangential_force is not None
