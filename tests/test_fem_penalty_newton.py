"""Newton's method and the springs in series on the condensed surface of a finite-element body."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from fem_penalty_surfaces import LOAD, elastic_surface, law_on, pressed, untouched

from fem_reference.contact.penalty.gauss_points import gauss_points
from fem_reference.contact.penalty.newton import Iterate, solve_by_newton
from fem_reference.contact.penalty.springs import TANGENTIAL, relax, solve_by_springs
from fem_reference.contact.penalty.step import newton_step

TIGHT = 1e-11
SLIDING = 3 * np.pi / 16 * LOAD  # torque over µ


def settled(surface, law, target):
    """The state under a target, and the law that remembers it."""
    found = solve_by_springs(surface, law, target, untouched(surface), TIGHT)
    multiplier = found.traction.copy()
    multiplier[0] = 0.0
    overlap = surface.overlap(found.traction, found.coordinates)
    return found, replace(law, multiplier=multiplier, reference=overlap[1:])


def unbalance(surface, law, target, at: Iterate) -> np.ndarray:
    """The equations that a Newton step linearises: law minus traction, load minus resultant."""
    response = law.response(surface.overlap(at.traction, at.coordinates))
    missing = (response.traction - at.traction).ravel()
    load = (target.value - surface.resultant(at.traction))[target.free]
    return np.concatenate([missing, load])


def same_states(surface, law, iterates) -> bool:
    """Whether the same points touch and slip: no kink lies between."""
    responses = [law.response(surface.overlap(x.traction, x.coordinates)) for x in iterates]
    first = responses[0]
    return all(
        np.array_equal(first.in_contact, x.in_contact) and np.array_equal(first.in_slip, x.in_slip)
        for x in responses
    )


@pytest.mark.parametrize("components", ["z", "zr", "zt", "zrt"])
def test_newton_step_is_that_of_the_true_tangent(components: str, rng) -> None:
    """Along the step the equations fall at the rate of their own size, to 1e-6."""
    surface = elastic_surface(components)
    law = law_on(surface, 10.0, 0.3)
    target = pressed(surface, torque=0.1 * SLIDING if components[-1] == "t" else None)
    start, law = settled(surface, law, target)
    tried = 0
    for _ in range(40):
        shaken = start.traction * (1 + 0.01 * rng.standard_normal(start.traction.shape))
        moved = start.coordinates + 0.002 * rng.uniform(-1, 1, len(target.free)) * target.free
        at = Iterate(shaken, moved)
        response = law.response(surface.overlap(at.traction, at.coordinates))
        if not np.any(response.in_contact & ~response.in_slip):
            continue  # a free coordinate that nothing resists: the step is a makeshift
        step, move = newton_step(
            surface, law.stiffness, response, response.traction - at.traction,
            target.value - surface.resultant(at.traction), target.free,
        )  # fmt: skip
        # Small enough for the curvature of slip, large enough for round-off.
        h = 1e-6 / max(1.0, float(np.max(np.abs(step))))
        ahead, behind = (
            Iterate(at.traction + x * step, at.coordinates + x * move) for x in (h, -h)
        )
        if not same_states(surface, law, (at, ahead, behind)):
            continue
        tried += 1
        here = unbalance(surface, law, target, at)
        rate = unbalance(surface, law, target, ahead) - unbalance(surface, law, target, behind)
        assert np.max(np.abs(rate / (2 * h) + here)) <= 1e-6 * np.max(np.abs(here))
    assert tried > 3


@pytest.mark.parametrize("part", [0.3, 0.6])
def test_newton_ends_quadratically(part: float) -> None:
    """A twisted contact with radial shear from pressing: two components, a truly curved law."""
    surface, mu = elastic_surface("zrt", per_radius=16), 0.3
    start, law = settled(surface, law_on(surface, 10.0, mu, per_radius=16), pressed(surface))
    target = pressed(surface, torque=part * mu * SLIDING)
    found = solve_by_newton(surface, law, target, start, 1e-12)
    errors = np.array(found.history)
    assert errors[-1] <= 1e-12
    tail = (errors[:-1] < 2e-2) & (errors[:-1] > 1e-7)
    assert np.count_nonzero(tail) >= 2
    assert np.all(errors[1:][tail] <= 20 * errors[:-1][tail] ** 2)


@pytest.mark.parametrize("components", ["zr", "zt", "zrt"])
@pytest.mark.parametrize("factor", [1.0, 10.0, 30.0])
def test_newton_and_springs_agree(components: str, factor: float) -> None:
    surface, mu = elastic_surface(components), 0.3
    start, law = settled(surface, law_on(surface, factor, mu), pressed(surface))
    twisted = components[-1] == "t"
    target = pressed(surface, 1.1, 0.4 * mu * SLIDING if twisted else None)
    # Beyond the start by the growth of a Hertz contact: points go on slipping as they have.
    ahead = replace(start, traction=1.03 * start.traction, coordinates=1.06 * start.coordinates)
    newton = solve_by_newton(surface, law, target, ahead, TIGHT)
    springs = solve_by_springs(surface, law, target, start, TIGHT)
    assert max(newton.residual, springs.residual) <= TIGHT
    assert newton.sweeps == 0 < springs.sweeps
    scale = np.max(newton.traction)
    assert springs.traction == pytest.approx(newton.traction, abs=1e-9 * scale)
    assert springs.coordinates == pytest.approx(newton.coordinates, rel=1e-9, abs=1e-12)


CORNERS = [
    (0.5, 0.1, 1.0),
    (0.5, 1.0, 100.0),
    (4.0, 0.1, 1000.0),
    (4.0, 1.0, 1.0),
    (1.0, 0.3, 10.0),
]
MAP = [
    pytest.param(*case, marks=pytest.mark.slow)
    for case in product((0.5, 1.0, 2.0, 4.0), (0.1, 0.3, 1.0), (1.0, 10.0, 100.0, 1000.0))
    if case not in CORNERS
]


@pytest.mark.parametrize(("ratio", "mu", "factor"), CORNERS + MAP)
def test_springs_converge_for_every_penalty(ratio: float, mu: float, factor: float) -> None:
    """Coated bodies, pressed in steps equal in contact radius, from nothing."""
    surface = elastic_surface("zr", ratio)
    law, state = law_on(surface, factor, mu, ratio), untouched(surface)
    for step in range(1, 6):
        state = solve_by_springs(surface, law, pressed(surface, (step / 5) ** 3), state, 1e-9)
        assert state.residual <= 1e-9
        overlap = surface.overlap(state.traction, state.coordinates)
        multiplier = np.vstack([np.zeros_like(state.traction[:1]), state.traction[1:]])
        law = replace(law, multiplier=multiplier, reference=overlap[1:])


@pytest.mark.parametrize("components", ["zr", "zrt"])
def test_springs_hold_the_least_energy(components: str, rng) -> None:
    """Of the bodies and the tangential springs at held pressure: every other shear has more."""
    surface = elastic_surface(components)
    target = pressed(surface, torque=None)
    state, law = settled(surface, law_on(surface, 10.0, 0.3), target)
    p = state.traction[0]
    part, held = surface.part(TANGENTIAL, state.traction), target.part(TANGENTIAL)
    nothing = np.zeros_like(state.traction[1:]), np.zeros(len(held.free))
    shear, _, _ = relax(
        part, lambda v: law.tangential_springs(v, p), law.stiffness, held, nothing, TIGHT
    )

    def energy(q) -> float:
        u = part.displacement(q)
        trial = law.trial_shear(-u - part.gap)
        size, limit = np.hypot.reduce(np.abs(trial), axis=0), law.friction.largest * p
        elastic = size**2 / (2 * law.stiffness)
        sliding = (limit * size - limit**2 / 2) / law.stiffness
        springs = np.where(size <= limit, elastic, sliding)
        return float(np.sum(part.weights * (0.5 * np.sum(q * u, axis=0) + springs)))

    least = energy(shear)
    for _ in range(20):
        other = shear + 1e-3 * np.max(p) * rng.standard_normal(shear.shape)
        assert energy(other) > least


def test_lost_contact_is_found_again() -> None:
    """From an approach at which nothing touches, a force brings the bodies together."""
    surface = elastic_surface("z")
    law, target = law_on(surface, 10.0, 0.0), pressed(surface)
    apart = replace(untouched(surface), coordinates=np.array([-5.0]))
    one, other = (
        solve_by_springs(surface, law, target, start, TIGHT)
        for start in (apart, untouched(surface))
    )
    assert one.residual <= TIGHT
    assert one.traction == pytest.approx(other.traction, abs=1e-9)


def test_gauss_points_measure_the_surface() -> None:
    """Weights and traces integrate quadratics exactly."""
    nodes = np.array([0.0, 0.5, 1.0, 1.2, 1.4, 1.9, 2.4])
    points = gauss_points(nodes)
    assert np.sum(points.weights) == pytest.approx(2.4**2 / 2, rel=1e-14)
    assert np.sum(points.weights * points.radii**2) == pytest.approx(2.4**4 / 4, rel=1e-14)
    assert points.trace @ (1 + 2 * nodes - nodes**2) == pytest.approx(
        1 + 2 * points.radii - points.radii**2, rel=1e-13
    )
    assert np.all(np.diff(points.radii) > 0)
