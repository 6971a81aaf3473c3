"""Tests of the solver of pressure alone on small dense problems: conditions of contact."""

from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from random_compliance import as_map, compliance, pressed, rough_inverse

from contact_scene.solver_errors import NotConverged
from contact_solver import pressure
from contact_solver.conjugate_gradients import solve_in_zones
from contact_solver.dense_inverse import inverse_on
from contact_solver.pressure import PressureProblem, solve_pressure

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
