"""Tests of the solvers of pressure alone and of shear alone on small dense problems."""

from functools import partial

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, graded_inverse, pressed, pushed, rough_inverse

from contact_scene.solver_errors import NotConverged
from contact_solver import pressure
from contact_solver.admissible_shear import (
    admissible_shear,
    magnitude,
    project_on_discs,
    project_trial,
)
from contact_solver.binned_preconditioner import BinnedPreconditioner
from contact_solver.conjugate_gradients import Point, solve_in_zones
from contact_solver.dense_inverse import inverse_on
from contact_solver.gross_slip import exhausts_friction, full_slip
from contact_solver.pressure import PressureProblem, solve_pressure
from contact_solver.shear import ShearProblem, solve_shear

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


def test_a_solution_is_left_as_it_is(rng):
    A, h = compliance(rng, 20), rng.random(20)
    first = solved(A, h, pressed(3.0))
    assert solved(A, h, pressed(3.0), first.pressure, 2 * TOLERANCE).iterations == 0


def test_conjugate_gradients_end_where_forces_leave_no_free_direction():
    """The force on a single point prescribes its pressure; its residual is round-off."""
    change, _, iterations = solve_in_zones(
        np.copy, lambda d, d_u: 0.0 * d_u, np.copy, np.array([1e-17]), 1e-2, 10
    )
    assert iterations == 1
    assert change == 0


def test_an_operator_that_is_not_positive_is_reported(rng):
    A = -compliance(rng, 20)
    with pytest.raises(NotConverged) as caught:
        solved(A, rng.random(20), pressed(3.0))
    assert not caught.value.residual <= TOLERANCE
    assert caught.value.tolerance == TOLERANCE


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


# ---- The shear solver against the conditions of stick and slip, and against a general optimis


FEW = 12
AT_REST = Point(np.zeros((2, FEW)), np.zeros((2, FEW)))


def random_surface(seed, size):
    """Compliance, friction limit and target of a random surface."""
    rng = np.random.default_rng(seed)
    bound = rng.random(FEW) * (rng.random(FEW) < 0.8)
    bound[:2] = 0.5
    target = size * rng.standard_normal((2, FEW))
    return compliance(rng, 2 * bound.size), bound, target


def problems():
    return st.builds(random_surface, st.integers(0, 2**32 - 1), st.sampled_from([0.0, 0.3, 3.0]))


def graded(A, own=1.0):
    return lambda zones: BinnedPreconditioner(zones, graded_inverse(A), own)


def shear_solved(problem, load, tolerance=TOLERANCE):
    A, bound, target = problem
    own = float(np.mean(np.diag(A)))
    problem = ShearProblem(as_map(A), graded(A, own), bound, target, load, own)
    return solve_shear(problem, AT_REST, np.zeros(2), tolerance)


def assert_sticks_or_slips(problem, solution):
    """Coulomb's law in every cell: no slip inside the disc, slip along the shear on its edge."""
    A, bound, target = problem
    q = solution.shear
    slip = solution.motion[:, None] + target - as_map(A)(q)
    assert np.all(magnitude(q) <= bound * (1 + 1e-12))
    missing = bound * magnitude(slip) - q[0] * slip[0] - q[1] * slip[1]
    assert np.sum(missing) <= 1e-8 * np.sum(bound) * np.max(magnitude(slip)[bound > 0] + 1)
    inside = (bound > 0) & ~solution.in_slip
    assert np.all(magnitude(slip)[inside] <= 1e-8)


ANGLES = st.floats(0, 2 * np.pi)


@given(problems(), st.sampled_from([0.0, 1e-6, 0.3, 0.9, 0.999, 0.9999]), ANGLES)
@example(random_surface(336, 0.3), 0.999, 3.085098754601997)
@example(random_surface(1348, 0.3), 0.999, 4.599260885499501)
def test_shear_under_a_force_sticks_or_slips_and_carries_it(problem, part, angle):
    total = part * np.sum(problem[1]) * np.array([np.cos(angle), np.sin(angle)])
    solution = shear_solved(problem, pushed(total))
    assert_sticks_or_slips(problem, solution)
    np.testing.assert_allclose(
        np.sum(solution.shear, axis=1), total, atol=1e-12 * np.sum(problem[1])
    )


@given(problems(), st.sampled_from([0.0, 1e-3, 1.0, 1e3]), ANGLES)
def test_shear_under_a_shift_sticks_or_slips(problem, size, angle):
    shift = size * np.array([np.cos(angle), np.sin(angle)])
    solution = shear_solved(problem, pushed(shift=shift))
    np.testing.assert_array_equal(solution.motion, shift)
    assert_sticks_or_slips(problem, solution)


@pytest.mark.parametrize("value", [np.nan, np.inf])
@pytest.mark.parametrize("call", [1, 2, 3])
def test_a_displacement_that_is_no_number_ends_as_not_converged(value, call, rng):
    A, bound = compliance(rng, 24), 0.2 + rng.random(FEW)
    calls = []

    def displace(q):
        calls.append(q)
        u = as_map(A)(q)
        if len(calls) == call:
            u[0, 0] = value
        return u

    load = pushed(np.array([0.5, 0.1]) * np.sum(bound))
    problem = ShearProblem(displace, graded(A), bound, np.zeros((2, FEW)), load, 1.0)
    with np.errstate(all="ignore"), pytest.raises(NotConverged):
        solve_shear(problem, AT_REST, np.zeros(2), TOLERANCE)


# ---- The projection on admissible shears: feasible, nearest, and it gives the sum exactly.


ROUND_OFF = 1e-12


def round_off(problem):
    """Of a projected shear: its own, and what was lost where a long vector was cut to the disc."""
    y, bound, _ = problem
    return ROUND_OFF * np.max(bound) + 1e-14 * np.max(np.abs(y))


@st.composite
def disc_problems(draw):
    """Any shear, a friction limit with zeros in it, and a sum that it can carry."""
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    points = draw(st.integers(4, 49))
    bound = rng.random(points) * (rng.random(points) < draw(st.floats(0.3, 1.0)))
    assume(np.count_nonzero(bound) >= 2)
    y = draw(st.sampled_from([1e-6, 1.0, 1e3])) * rng.standard_normal((2, points))
    part = draw(st.sampled_from([0.0, 1e-9, 0.3, 0.9, 0.999, 1 - 1e-6]))
    angle = draw(st.floats(0, 2 * np.pi))
    total = part * np.sum(bound) * np.array([np.cos(angle), np.sin(angle)])
    return y, bound, total


def assert_feasible(q, problem):
    _, bound, total = problem
    assert np.all(magnitude(q) <= bound * (1 + ROUND_OFF))
    assert np.max(np.abs(np.sum(q, axis=1) - total)) <= bound.size * round_off(problem)


@given(disc_problems())
def test_projection_is_feasible_and_a_shift_cut_off_at_the_discs(problem):
    """q = P(y + λ) with one vector λ for all cells, the optimality conditions of the projection."""
    y, bound, total = problem
    q, multiplier = project_trial(pushed(total), y, bound, 1.0, np.zeros(2))
    assert_feasible(q, problem)
    expected = project_on_discs(y + multiplier[:, None], bound)
    np.testing.assert_allclose(q, expected, rtol=0, atol=10 * round_off(problem))


@pytest.mark.parametrize("part", [1e-30, 1e-15, 1e-9, 1e-3])
def test_a_tiny_sum_is_carried_to_its_own_precision(part, rng):
    bound = rng.random(81)
    total = part * np.sum(bound) * np.array([0.6, -0.8])
    q = admissible_shear(pushed(total), part * rng.standard_normal((2, 81)), bound)
    assert np.max(np.abs(np.sum(q, axis=1) - total)) < 1e-13 * part * np.sum(bound)


@given(disc_problems())
def test_without_a_sum_every_cell_is_projected_alone(problem):
    y, bound, _ = problem
    q = project_on_discs(y, bound)
    inside = magnitude(y) <= bound
    np.testing.assert_array_equal(q[:, inside], y[:, inside])
    outside = ~inside & (bound > 0)
    np.testing.assert_allclose(magnitude(q)[outside], bound[outside], rtol=1e-14)
    np.testing.assert_allclose(q[0] * y[1], q[1] * y[0], atol=1e-12 * np.max(np.abs(y)))
    assert np.all(q[:, bound == 0] == 0)


def test_a_force_and_the_shift_that_it_leads_to_have_the_same_shear(rng):
    y, bound = rng.standard_normal((2, 20)), rng.random(20)
    total, gamma, unknown = np.sum(bound) * np.array([0.4, -0.5]), 3.0, np.zeros(2)
    q, shift = project_trial(pushed(total), y, bound, gamma, unknown)
    led, same = project_trial(pushed(shift=shift), y, bound, gamma, unknown)
    np.testing.assert_allclose(led, q, rtol=0, atol=100 * ROUND_OFF)
    np.testing.assert_array_equal(same, shift)


def test_a_force_is_exhausted_by_the_sum_of_the_limits_and_then_all_slips_along_it(rng):
    bound, motion, along = rng.random(20), np.array([1.0, 2.0]), np.array([0.6, -0.8])
    carried = np.sum(bound)
    assert not exhausts_friction(pushed(0.9 * carried * along), bound)
    assert exhausts_friction(pushed(carried * along), bound)
    assert exhausts_friction(pushed(1.1 * carried * along), bound)
    q, kept = full_slip(pushed(carried * along), bound, motion)
    np.testing.assert_allclose(q, bound * along[:, None], rtol=ROUND_OFF)
    np.testing.assert_array_equal(kept, motion)
