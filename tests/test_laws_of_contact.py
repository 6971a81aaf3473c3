"""Tests of the laws of contact, friction and energy in hard load histories, with every solver."""

from functools import partial

import contact_scenes
import coupled_scenes
import numpy as np
import pytest
from contact_scenes import (
    APPROACH,
    INDENTERS,
    LIMIT,
    LOAD,
    MU,
    PRESS,
    RADIUS,
    A,
    bump,
    grid,
    slide,
    steel,
)
from coupled_scenes import bulk, coated, press, push

import slipstick
from contact_results.surface import surface_of
from contact_scene import (
    RIGID,
    Ellipsoid,
    FiniteElementDiscretisation,
    FlatPunch,
    HeightMap,
    RadialDiscretisation,
    SurfaceDiscretisation,
)
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding, UnsupportedScene
from semi_analytical import solve
from verification.judging.case import OTHER_NORMS, OVER_RINGS
from verification.observed.observed_laws import observed

TOLERANCE = 1e-8
CELLS = 24
SPACING = 3 * A / CELLS
AT = (np.arange(CELLS) - 0.5 * (CELLS - 1)) * SPACING


def assert_lawful(result, friction, bound):
    """Observed violations are within a bound; no tension, overlap or shear above µp; energy is
    lost."""
    assert observed(result).violation <= bound
    surface, lost = surface_of(result), 0.0
    for end in result.increments:
        pressure, shear = surface.scalar(end, "pressure"), surface.vector(end, "shear")
        assert np.min(pressure) >= 0
        assert np.min(end.gap) >= -TOLERANCE * end.approach
        if shear is not None:
            limit = friction.limit(pressure)
            assert np.all(np.hypot(*shear) <= limit + 1e-9 * np.max(limit))
        if end.dissipated_energy is not None:
            assert end.dissipated_energy >= lost
            lost = end.dissipated_energy


def far(x: float) -> dict:
    """A tangential shift in units of a tenth of the approach."""
    return slide(x, increments=3)


def both(x: float, load: float, increments: int = 4) -> dict:
    """Tangential and normal force in parts of the friction limit under full load and of that
    load."""
    force = {"tangential_force": (x * LIMIT, 0.0), "normal_force": load * LOAD}
    return {**force, "increments": increments}


def two_bumps() -> np.ndarray:
    one, other = ((AT[:, None] - c) ** 2 + AT**2 for c in (-0.7 * A, 0.7 * A))
    return np.minimum(one, other) / (2 * RADIUS)


def rough() -> np.ndarray:
    noise = np.random.default_rng(3).standard_normal((CELLS, CELLS))
    return bump(CELLS, SPACING) + 0.02 * APPROACH * noise


def patchy_friction() -> dict:
    values = np.random.default_rng(4).uniform(0, 2 * MU, (CELLS, CELLS))
    values[values < 0.3 * MU] = 0
    return {"map": values, "spacing": SPACING}


def surface(heights):
    return partial(HeightMap, file=heights, spacing=SPACING)


ANGLES = np.linspace(0, 2 * np.pi, 5)
CIRCLE = [push(0.8 * np.cos(t), 0.8 * np.sin(t), increments=3) for t in ANGLES]
TURN = MU * LOAD * A
PATH = press(), push(0.6)
# Load steps, and what differs from the ball; a shape takes its material from the bodies.
OF_ANY_BODIES = {
    "rough surface": ((press(), push(0.6), push(-0.3, 0.4)), {"shape": surface(rough())}),
    "two contacts": ((press(0.1), push(0.07), push(-0.07)), {"shape": surface(two_bumps())}),
    "mapped friction with zeros": (
        (press(), push(0.6), push(-0.6)),
        {"friction": patchy_friction()},
    ),
    "W and T reversed together": ((press(), push(0.8), both(-0.8, 0.85, 6)), {}),
    "shift far beyond sliding and back": ((press(), far(1), far(1000), far(0), far(-1000)), {}),
    "controls in turn": (
        ({"approach": APPROACH, "increments": 2}, far(0.5), push(0.3), press(), far(-0.5)),
        {},
    ),
    "unloading and reloading": ((both(0.5, 1), both(0, 0.01), both(0.5, 1)), {}),
    "ellipsoid, obliquely": (
        (press(0.3), push(0.15, 0.15)),
        {"shape": partial(Ellipsoid, radii=(RADIUS, 4 * RADIUS))},
    ),
    "T at the limit": ((press(), push(0.9), push(1.0)), {}),
}
OF_ALIKE_BODIES = {
    **{f"T = {x} of the limit": ((PRESS, push(x)), {}) for x in (0.99, 0.99999)},
    "tiny T": ((PRESS, push(1e-9), push(-1e-9)), {}),
    "contact of four cells": (({"normal_force": 1e-4 * LOAD}, push(0.9e-4)), {}),
    "T on a circle": ((PRESS, *CIRCLE), {}),
    "much friction": ((PRESS, push(45), push(-45)), {"friction": 5.0}),
    "torque that turns": ((PRESS, {"torque": 0.3 * TURN}, {"torque": -0.2 * TURN}), {}),
}


def strong(friction: float, poisson_ratio: float, part: float) -> tuple:
    """Pushed by a part of the limit on a homogeneous body: µ|beta| of one and more."""
    loading = press(), push(part, friction=friction)
    return loading, {"body": bulk(poisson_ratio), "friction": friction, "contacts": 2.5}


OF_UNLIKE_BODIES = {
    "µ = 2, ν = 0": strong(2.0, 0.0, 0.6),
    "µ = 5, ν = 0.3": strong(5.0, 0.3, 0.6),
    "friction coefficient of zero": ((press(), far(1)), {"friction": 0.0}),
    "E1/E2 = 1e-3": (PATH, {"body": coated(1e-3), "contacts": 12}),
    "E1/E2 = 1e3": (PATH, {"body": coated(1e3), "contacts": 0.3}),
    "thin soft incompressible layer": (PATH, {"body": coated(0.1, 0.2, 0.5), "contacts": 2}),
    # Shear lifts the surface of the soft incompressible film more than pressure.
    "contact that falls apart": (
        (press(), push(0.9, friction=2.0, increments=1)),
        {"body": coated(1e-3, 0.01, 0.5), "friction": 2.0, "contacts": 1.3},
    ),
    "flat punch": ((press(), push(0.8), push(-0.8)), {"shape": partial(FlatPunch, radius=A)}),
}
# Scenes of two equal bodies, and of a rigid ball on a coated or homogeneous body.
ALIKE, UNLIKE = contact_scenes.scene, coupled_scenes.scene
BODIES = {
    "alike": (ALIKE, steel(), OF_ANY_BODIES | OF_ALIKE_BODIES),
    "unlike": (UNLIKE, RIGID, OF_ANY_BODIES | OF_UNLIKE_BODIES),
}


@pytest.mark.parametrize(
    ("bodies", "name"),
    [(bodies, name) for bodies, (*_, histories) in BODIES.items() for name in histories],
)
def test_histories_on_cells_obey_all_laws_without_smaller_increments(bodies, name):
    make, material, histories = BODIES[bodies]
    loading, given = histories[name]
    more = dict(given)
    on = grid(CELLS, more.pop("contacts", 1.5))
    if "shape" in more:
        more["indenter"] = more.pop("shape")(material=material)
    described = make(*loading, **more)
    result = solve(described, on, TOLERANCE)
    friction = described.friction.on_grid(on.cells, on.spacing)
    assert_lawful(result, friction, OTHER_NORMS * TOLERANCE)
    for end in result.increments:
        assert end.residuals.worst <= TOLERANCE
        assert end.halvings == 0
        assert end.stick_area <= end.contact_area
        assert (end.energy_imbalance or 0.0) < 1e-6


UP_AND_DOWN = (
    press(increments=8),
    press(0.05, increments=12),
    {"approach": APPROACH, "increments": 3},
)


def torque(part: float) -> dict:
    """In parts of that at which a Hertz contact slips at all points."""
    return {"torque": part * 3 * np.pi / 16 * LIMIT * A, "increments": 3}


PUSHED = push(0.5, increments=4)
ASIDE = push(0.5 / 2**0.5, 0.5 / 2**0.5, increments=4)
ON_RINGS = {
    **{
        shape: ALIKE(PRESS, friction=None, indenter=INDENTERS[shape])
        for shape in ("sphere", "cone", "flat punch")
    },
    "to and fro": ALIKE(PRESS, *(push(x, increments=1) for x in (0.9, -0.9, 0.9))),
    "twisted": ALIKE(PRESS, torque(0.5), torque(-0.5), {"twist": 0.0}),
    **{
        f"coupled, µ = {mu}, ν = {nu}": UNLIKE(press(increments=5), body=bulk(nu), friction=mu)
        for mu, nu in ((0.1, 0.0), (1.0, 0.3), (5.0, -0.5))
    },
    "up and down": UNLIKE(*UP_AND_DOWN, body=bulk()),
    "up and down, coated": UNLIKE(*UP_AND_DOWN),
    "turned": UNLIKE(press(increments=4), PUSHED, ASIDE),
    "free to twist": UNLIKE(press(increments=4), {**PUSHED, "torque": 0.0}, ASIDE),
    "pushed, then twisted": UNLIKE(press(increments=4), push(0.5, increments=3), torque(0.4)),
    "twisted around a push": UNLIKE(
        press(increments=4), torque(0.4), push(0.5, increments=3), torque(-0.3)
    ),
    # All points then carry µp along the force: no other shear within the limit carries it.
    "at the limit": ALIKE(PRESS, push(-1.0, increments=1)),
    "at the limit, coupled": UNLIKE(press(increments=4), push(-1.0)),
    "at the limit, turned": UNLIKE(press(increments=4), push(0.5), push(0.6, 0.8)),
}
# After an augmentation the pressure of the preceding pass, which is not stored, bounds the shear.
SPRINGS_ALONE = (
    *("turned", "free to twist", "pushed, then twisted", "twisted around a push"),
    *("at the limit, coupled", "at the limit, turned"),
)
NOT_ON_RADII = (
    *("to and fro", "twisted", "coupled, µ = 5.0, ν = -0.5"),
    *("turned", "free to twist", "pushed, then twisted", "at the limit, turned"),
)


@pytest.mark.parametrize("name", ON_RINGS)
@pytest.mark.parametrize("solver", ["fem", "fem-complementarity"])
def test_histories_on_elements_obey_all_laws(solver, name):
    more = {"augmentations": 0} if name in SPRINGS_ALONE else {}
    mesh = FiniteElementDiscretisation(elements_per_radius=6, harmonics=4, overlap=1.0, **more)
    result = slipstick.solve(ON_RINGS[name], solver, mesh)
    assert_lawful(result, ON_RINGS[name].friction, OTHER_NORMS * TOLERANCE)
    assert max(end.residuals.worst for end in result.increments) < 1e-10
    assert observed(result).imbalance < 1e-4
    assert bool(observed(result).of_slip) is name.startswith("at the limit")


@pytest.mark.parametrize("name", [name for name in ON_RINGS if name not in NOT_ON_RADII])
def test_histories_on_radii_obey_all_laws(name):
    result = slipstick.solve(ON_RINGS[name], "radial", RadialDiscretisation())
    assert_lawful(result, ON_RINGS[name].friction, OVER_RINGS)


SOLVERS = {
    "semi-analytical": SurfaceDiscretisation(cells=(24, 24), tolerance=1e-9, edge="off"),
    "radial": RadialDiscretisation(rings=12),
    "fem": FiniteElementDiscretisation(elements_per_radius=8, harmonics=4, overlap=0.1),
    "fem-complementarity": FiniteElementDiscretisation(elements_per_radius=8, harmonics=4),
}
LESS = {"approach": 0.3 * APPROACH, "increments": 5}
# A scene of which the last load step exceeds what friction carries, and words of the refusal.
TOO_MUCH = {
    "torque": (ALIKE(press(), torque(1.3)), "prescribe twist"),
    "torque, coupled": (UNLIKE(press(), torque(1.3)), "prescribe twist"),
    "together": (ALIKE(press(), torque(0.8), push(0.8)), "together exceed the friction limit"),
    "less pressure": (ALIKE(press(), push(0.5), LESS), "prescribe tangential_shift instead"),
}


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", TOO_MUCH)
def test_more_than_friction_carries_is_refused(name, solver):
    """Nothing in the scene tells it: the pressure is part of the solution."""
    described, words = TOO_MUCH[name]
    with pytest.raises(GrossSliding, match=words) as caught:
        slipstick.solve(described, solver, SOLVERS[solver])
    assert f"step {len(described.loading)}, increment" in str(caught.value)


STICKS, SLIPS, SLIDES, APART = (
    ContactStatus.FULL_STICK,
    ContactStatus.PARTIAL_SLIP,
    ContactStatus.GROSS_SLIDING,
    ContactStatus.SEPARATED,
)
NOTHING = (0.0, 0.0)
# Load steps after pressing, and the state at their end: status, tangential force, and shift (None:
# undefined; ANY: not the same in all solvers).
ANY = "any"
ENDS = {
    "at the limit": (ALIKE, (push(1.0),), SLIDES, (LIMIT, 0.0), None),
    "at the limit, obliquely": (ALIKE, (push(0.6, 0.8),), SLIDES, (0.6 * LIMIT, 0.8 * LIMIT), None),
    "at the limit, coupled": (UNLIKE, (push(1.0),), SLIDES, (LIMIT, 0.0), None),
    "less pressure at the limit": (
        ALIKE,
        (push(0.5), press(0.5)),
        SLIDES,
        (0.5 * LIMIT, 0.0),
        None,
    ),
    "far": (ALIKE, (far(100),), SLIDES, (LIMIT, 0.0), (10 * APPROACH, 0.0)),
    "far, coupled": (UNLIKE, (far(100),), SLIDES, (LIMIT, 0.0), (10 * APPROACH, 0.0)),
    "hardly pushed": (ALIKE, (push(1e-9),), STICKS, (1e-9 * LIMIT, 0.0), ANY),
    "twisted": (ALIKE, (torque(0.5),), SLIPS, NOTHING, NOTHING),
    "unloaded": (ALIKE, (push(0.5), both(0.0, 0.0)), APART, NOTHING, ANY),
}


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("name", ENDS)
def test_a_load_ends_in_one_state_with_every_solver(name, solver):
    make, steps, status, force, shift = ENDS[name]
    end = slipstick.solve(make(press(increments=2), *steps), solver, SOLVERS[solver]).steps[-1]
    assert end.status is status
    np.testing.assert_allclose(end.tangential_force, force, atol=1e-6 * LIMIT, rtol=0)
    if shift is None:
        assert end.tangential_shift is None
    elif shift is not ANY:
        np.testing.assert_allclose(end.tangential_shift, shift, atol=1e-9 * APPROACH, rtol=0)


@pytest.mark.parametrize("solver", SOLVERS)
def test_little_friction_shears_in_proportion_to_it(solver):
    """But for terms of the order µ, and the overlap of a penalty; its passes scatter by round-off
    over µ."""
    found, on, least, near = [], SOLVERS[solver], 1e-7, 1e-4
    if solver == "fem":
        on = FiniteElementDiscretisation(elements_per_radius=8, harmonics=4, overlap=1e-5)
        least, near = 1e-6, 1e-3
    for mu in (1e-4, least):
        loading = press(increments=1), push(0.6, friction=mu, increments=1)
        described = UNLIKE(*loading, body=bulk(0.3), friction=mu)
        end = slipstick.solve(described, solver, on).steps[-1]
        found.append((end.tangential_shift[0] / mu, end.stick_area))
    np.testing.assert_allclose(found[1], found[0], rtol=near)


TILTED = {"moment": (0.1 * LOAD * A, 0.3 * LOAD * A)}
TWISTED = {"torque": 0.2 * TURN}
BY_LOAD = {
    **dict.fromkeys(["push", "push, coupled"], (push(0.7, increments=1), "tangential_shift")),
    **dict.fromkeys(["torsion", "torsion, coupled"], (TWISTED, "twist")),
    **dict.fromkeys(["tilt", "tilt, coupled"], (TILTED, "tilt")),
}


@pytest.mark.parametrize("solver", [name for name in SOLVERS if name != "fem"])
@pytest.mark.parametrize("name", BY_LOAD)
def test_a_load_and_its_motion_lead_to_the_same_state(name, solver):
    """But for the springs of a penalty, whose last overlap depends on the way there."""
    load, motion = BY_LOAD[name]
    make = UNLIKE if name.endswith("coupled") else ALIKE
    if load is TILTED and solver != "semi-analytical":
        with pytest.raises(UnsupportedScene, match="moment"):
            slipstick.plan(make(press(), load), solver)
        return

    def solved(step):
        return slipstick.solve(make(press(), {**step, "increments": 1}), solver, SOLVERS[solver])

    by_load = solved(load)
    end = by_load.steps[-1]
    by_motion = solved({motion: getattr(end, motion)})
    surface, other = surface_of(by_load), by_motion.steps[-1]
    near = 1e-5 * end.peak_pressure
    np.testing.assert_allclose(
        surface.scalar(other, "pressure"), surface.scalar(end, "pressure"), atol=near
    )
    if load is not TILTED or make is UNLIKE:  # otherwise there is no shear
        np.testing.assert_allclose(
            surface.vector(other, "shear"), surface.vector(end, "shear"), atol=near
        )
