"""Tests of the solver of pressure alone on small dense problems: conditions of contact, also under
moments."""

from functools import partial

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, pressed, rough_inverse

from contact_scene.solver_errors import NotConverged
from contact_solver import pressure
from contact_solver.dense_inverse import inverse_on
from contact_solver.pressure import PressureProblem, solve_pressure
from contact_solver.rigid_motion import RigidMotion, RigidMotions
from semi_analytical.increments.normal_target import NormalTarget

TOLERANCE = 1e-11
POINTS = 20


def solved(A, h, load, start=None, tolerance=TOLERANCE, *, exact=False):
    inverse = partial(inverse_on, A) if exact else lambda contact: rough_inverse(A)
    problem = PressureProblem(as_map(A), inverse, h, load)
    return solve_pressure(problem, np.ones(len(h)) if start is None else start, tolerance)


@st.composite
def contacts(draw):
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    h = draw(st.sampled_from([0.1, 1.0, 10.0])) * rng.random(POINTS)
    h[rng.random(h.size) < draw(st.sampled_from([0.0, 0.4]))] = np.inf
    h[0] = 0.0
    return compliance(rng, h.size), h


def assert_contact(A, h, solution):
    """No tension, no overlap, no gap under pressure: the conditions have one solution."""
    p, finite = solution.pressure, np.isfinite(h)
    u, (approach,) = A @ p, solution.motion
    gap = (u + h - approach)[finite]
    assert np.all(p >= 0)
    assert np.all(p[~finite] == 0)
    assert np.min(gap) >= -TOLERANCE * approach
    assert np.sum(np.abs(gap) * p[finite]) <= TOLERANCE * approach * np.sum(p)
    np.testing.assert_allclose(solution.displacement, u, rtol=0, atol=1e-10 * np.max(np.abs(u)))


@given(contacts(), st.floats(0.01, 10), st.booleans(), st.integers(0, 2**32 - 1), st.booleans())
def test_solution_obeys_the_conditions_of_contact(contact, size, forced, seed, exact):
    solution = solved(
        *contact,
        pressed(size) if forced else pressed(approach=size),
        np.random.default_rng(seed).random(POINTS) + 1e-3,
        exact=exact,
    )
    assert_contact(*contact, solution)
    assert (np.sum(solution.pressure) if forced else solution.motion[0]) == pytest.approx(
        size, rel=1e-13
    )
    assert solution.iterations < 200  # 59 at most in 1 000 draws


@pytest.mark.parametrize("limit", ["MAX_STEPS", "MAX_ITERATIONS"])
def test_a_stop_above_the_tolerance_is_an_error(rng, monkeypatch, limit):
    monkeypatch.setattr(pressure, limit, 1)
    with pytest.raises(NotConverged, match="the pressure") as caught:
        solved(compliance(rng, 20), rng.random(20), pressed(3.0))
    assert caught.value.residual > caught.value.tolerance == TOLERANCE


@pytest.mark.parametrize(
    ("shape", "most", "touching"),
    [((20, 1), 60, False), ((12, 12), 60, False), ((12, 12), 30, True)],
)
def test_cells_that_lift_others_take_few_iterations(shape, most, touching, rng):
    """A compliance that oscillates, as below stiff films: cutting off tension may raise the energy.

    With other descent rules it takes hundreds of iterations or does not converge. If half of the
    cells touch without pressure, contact sets alternate where solves on a wrong set go on."""
    at = np.indices(shape).reshape(2, -1)
    far = np.hypot(*(at[:, :, None] - at[:, None]))
    A = np.exp(-far / 20) * np.cos(far / 1.5)
    A += (1e-3 - min(np.linalg.eigvalsh(A)[0], 0)) * np.eye(len(A))
    u = A @ np.maximum(rng.random(len(A)) - 0.5, 0)
    gap = np.max(u) - u if touching else 3 * rng.random(len(A))
    solution = solved(A, gap, pressed(approach=float(np.max(u)) if touching else 1.0))
    assert_contact(A, gap, solution)
    assert solution.iterations < most  # 43, 51, 20; 105, 63, 20 if each step is solved to the end


Y, X = (one.ravel() for one in np.meshgrid(np.arange(5) - 2.0, np.arange(4) - 1.5))
EVERYWHERE = np.ones(POINTS, dtype=bool)


def sums(p):
    return np.array([np.sum(p), np.sum(p * Y), np.sum(p * X)])


@st.composite
def carried(draw):
    """Sums of some pressure on some of the cells, and those cells."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    cells = rng.random(POINTS) < draw(st.floats(0.4, 1.0))
    assume(np.count_nonzero(cells) >= 4)
    p = cells * (0.01 + rng.random(POINTS) ** draw(st.sampled_from([1, 8])))
    return rng, cells, sums(p)


def motions(target, *, forced=True):
    """Approach and tilts under moments, and under a normal force or at an approach of 2."""
    total, *moments = target
    approach = RigidMotion(np.ones((1, 1)), total if forced else None, 2.0)
    tilts = (RigidMotion(arm[None], moment) for arm, moment in zip((Y, X), moments, strict=True))
    return RigidMotions(1, (approach, *tilts))


def problem_of(target, cells=EVERYWHERE, *, forced=True, matrix=None, gap=0.0):
    matrix = np.eye(POINTS) if matrix is None else matrix
    gap = np.where(cells, gap, np.inf)
    load = motions(target, forced=forced)
    return PressureProblem(as_map(matrix), lambda contact: rough_inverse(matrix), gap, load)


class Model:
    """Arms of cells, as the contact model has them."""

    arms = np.stack([Y, X])


def touches(target, cells, *, forced=True):
    total, *moments = target
    load = NormalTarget(*((total, None) if forced else (None, 2.0)), moment=tuple(moments))
    return load.touches(Model, np.where(cells, 0.0, np.inf))


@given(carried(), st.sampled_from([1e-6, 1.0, 1e6]))
def test_admissible_pressure_has_no_tension_and_carries_force_and_moments(problem, size):
    rng, cells, target = problem
    assume(touches(target, cells))
    p = problem_of(target, cells).admissible(size * cells * rng.random(POINTS))
    assert np.all(p >= 0)
    assert np.all(p[~cells] == 0)
    np.testing.assert_allclose(sums(p), target, atol=1e-12 * (target[0] + size))


@given(carried())
def test_what_other_points_carry_is_taken_off_force_and_moments(problem):
    rng, cells, target = problem
    elsewhere = ~cells * rng.random(POINTS)
    rest = motions(target).less(elsewhere[None]).held.prescribed_forces
    np.testing.assert_allclose(rest + sums(elsewhere), target, atol=1e-12)
    led = motions(target, forced=False).less(elsewhere[None])
    np.testing.assert_array_equal(led.held.prescribed_forces, rest[1:])
    np.testing.assert_array_equal(led.values, [2.0, 0.0, 0.0])


@given(carried(), st.booleans())
def test_a_plane_gap_is_closed_by_its_own_motion(problem, forced):
    rng, _, target = problem
    motion = np.array([2.0, *rng.normal(size=2)])
    of = problem_of(target, forced=forced)
    found = of.motion(rng.random(POINTS), of.closure(motion))
    np.testing.assert_allclose(found, motion, atol=1e-9)


@pytest.mark.parametrize(
    ("arm", "carried"), [(1.4, True), (1.49, True), (1.51, False), (9.0, False)]
)
def test_a_force_beyond_the_outermost_cells_is_not_carried(arm, carried):
    target = np.array([3.0, 0.0, 3.0 * arm])
    assert touches(target, EVERYWHERE) is carried
    if carried:
        found = sums(problem_of(target).admissible(np.ones(POINTS)))
        np.testing.assert_allclose(found, target, atol=1e-12)
    else:
        with pytest.raises(NotConverged, match="the pressure under its moments"):
            problem_of(target).admissible(np.ones(POINTS))


@pytest.mark.parametrize(("M_y", "carried"), [(1.0, True), (-1.0, False), (0.0, True)])
def test_under_a_given_approach_only_the_side_of_the_moment_matters(M_y, carried):
    assert touches(np.array([0.0, 0.0, M_y]), X > 0, forced=False) is carried
