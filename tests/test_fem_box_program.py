"""Quadratic programs with bounds: the answer is the minimum, however it was found."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from contact_scene.solver_errors import NotConverged
from fem_reference.contact import box_program
from fem_reference.contact.box_program import (
    BoxProgram,
    BoxSolution,
    Total,
    solve_box,
)

ENOUGH = 1e-9


@st.composite
def programs(draw, largest=9, total=None, endless=None):
    """Random programs, well conditioned, some with components without room."""
    n = draw(st.integers(1, largest))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    B = rng.normal(size=(n, n))
    A = B @ B.T + 0.05 * n * np.eye(n)
    c = 3 * rng.normal(size=n)
    lower = -rng.random(n) * rng.integers(0, 2, n)
    upper = rng.random(n) * (rng.random(n) > 0.2)
    if draw(st.booleans()) if endless is None else endless:
        upper = np.full(n, np.inf)
    has_total = draw(st.booleans()) if total is None else total
    room = np.any(lower < upper)
    if not (has_total and room):
        return BoxProgram(A, c, lower, upper)
    v = 0.2 + rng.random(n)
    top = np.where(np.isfinite(upper), upper, lower + 2)
    part = draw(st.floats(0.02, 0.98))
    return BoxProgram(A, c, lower, upper, Total(v, float(v @ (lower + part * (top - lower)))))


def energy(program: BoxProgram, x):
    return 0.5 * x @ program.matrix @ x - program.right @ x


def assert_optimal(program: BoxProgram, found: BoxSolution) -> None:
    """Karush, Kuhn and Tucker's conditions, with a slack of round-off only."""
    x, size = found.values, 1 + np.max(np.abs(program.right))
    assert np.all((x >= program.lower) & (x <= program.upper))
    gradient = program.matrix @ x - program.right
    if program.total is not None:
        gradient -= found.multiplier * program.total.weights
        assert program.total.weights @ x == pytest.approx(program.total.value, abs=ENOUGH)
    inside = (x > program.lower) & (x < program.upper)
    assert np.all(np.abs(gradient[inside]) < ENOUGH * size)
    room = program.lower < program.upper
    assert np.all(gradient[room & (x == program.lower)] > -ENOUGH * size)
    assert np.all(gradient[room & (x == program.upper)] < ENOUGH * size)


@given(programs(), st.integers(0, 3**9 - 1))
def test_solution_is_optimal_from_any_guess(program: BoxProgram, code: int) -> None:
    guess = np.array([code // 3**k % 3 - 1 for k in range(len(program.right))], dtype=np.int8)
    guess[(guess > 0) & ~np.isfinite(program.upper)] = 0
    assert_optimal(program, solve_box(program, guess))


@given(programs())
def test_descent_alone_finds_the_same(program: BoxProgram) -> None:
    free = np.zeros(len(program.right), np.int8)
    steps = box_program.MOST_STEPS
    try:
        box_program.MOST_STEPS = 0
        slow = solve_box(program, free)
    finally:
        box_program.MOST_STEPS = steps
    assert_optimal(program, slow)
    assert slow.values == pytest.approx(solve_box(program, free).values, abs=1e-8)


@given(programs(total=False))
def test_bounded_least_squares_agrees(program: BoxProgram) -> None:
    room = program.lower < program.upper
    if not room.any():
        return
    held = np.where(room, 0, program.lower)
    A = program.matrix[np.ix_(room, room)]
    c = (program.right - program.matrix @ held)[room]
    L = np.linalg.cholesky(A)
    bounds = (program.lower[room], program.upper[room])
    data = np.linalg.solve(L, c)
    oracle = lsq_linear(L.T, data, bounds, method="bvls", tol=1e-14, max_iter=1000)
    assert oracle.success
    found = solve_box(program, np.zeros(len(program.right), np.int8))
    assert found.values[room] == pytest.approx(oracle.x, abs=1e-7)


@given(programs(largest=4, endless=False))
def test_no_choice_of_sides_has_less_energy(program: BoxProgram) -> None:
    found = solve_box(program, np.zeros(len(program.right), np.int8))
    least = energy(program, found.values)
    for sides in itertools.product((-1, 0, 1), repeat=len(program.right)):
        x = _face_minimum(program, np.array(sides))
        if x is not None:
            assert least <= energy(program, x) + 1e-9 * (1 + abs(least))


def _face_minimum(program: BoxProgram, sides):
    """The minimum on one face of the box, if it lies within the box."""
    x = np.where(sides < 0, program.lower, np.where(sides > 0, program.upper, 0.0))
    free = sides == 0
    k = int(free.sum())
    A, total = program.matrix, program.total
    K = np.zeros((k + 1, k + 1))
    K[:k, :k] = A[np.ix_(free, free)]
    right = np.append((program.right - A @ x)[free], 0.0)
    if total is None:
        K[k, k] = 1
    else:
        K[:k, k] = K[k, :k] = total.weights[free]
        right[k] = total.value - total.weights @ x
    if abs(np.linalg.det(K)) < 1e-12:
        return None
    x[free] = np.linalg.solve(K, right)[:k]
    if total is not None and abs(total.weights @ x - total.value) > 1e-9:
        return None
    within = np.all(x >= program.lower - 1e-12) and np.all(x <= program.upper + 1e-12)
    return x if within else None


@given(programs(), st.integers(-20, 20))
def test_units_do_not_matter(program: BoxProgram, power: int) -> None:
    """In units that differ by a power of four, whose roots are exact, every step is the same."""
    s = 4.0**power
    other = BoxProgram(
        program.matrix * s, program.right * s * s, program.lower * s, program.upper * s,
        None if program.total is None
        else Total(program.total.weights / s, program.total.value),
    )  # fmt: skip
    free = np.zeros(len(program.right), np.int8)
    one, two = solve_box(program, free), solve_box(other, free)
    assert np.array_equal(two.values, one.values * s)
    assert two.steps == one.steps


def test_contact_of_a_parabola_is_solved_by_newton_steps_alone() -> None:
    """On the problem it is for, the descent is never called upon."""
    n = np.arange(200)
    A = 1 / (1 + np.abs(n[:, None] - n)) + np.eye(200)
    gap = 1e-4 * (n - 99.5) ** 2
    program = BoxProgram(A, -gap, np.zeros(200), np.full(200, np.inf), Total(np.ones(200), 5.0))
    found = solve_box(program, np.zeros(200, np.int8))
    assert found.steps < 12
    assert_optimal(program, found)


def test_who_rests_at_a_bound_without_being_pulled_stays_there() -> None:
    """Its gradient is zero: it could be free as well, and then would be told so."""
    lower, endless = np.zeros(2), np.full(2, np.inf)
    program = BoxProgram(np.array([[4.0, 1.0], [1.0, 2.0]]), np.array([4.0, 1.0]), lower, endless)
    found = solve_box(program, np.array([0, -1], np.int8))
    assert found.values.tolist() == [1.0, 0.0]
    assert found.sides.tolist() == [0, -1]
    assert found.steps == 1


def test_a_descent_that_is_cut_short_tells_its_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """One step for each component that meets its bound, and one to see that nothing pulls."""
    monkeypatch.setattr(box_program, "MOST_STEPS", 0)
    upper = np.arange(1.0, 6.0)
    program = BoxProgram(np.eye(5), np.full(5, 10.0), np.zeros(5), upper)
    assert solve_box(program, np.zeros(5, np.int8)).steps == 6
    monkeypatch.setattr(box_program, "MOST_RELEASES", 1)
    with pytest.raises(NotConverged) as caught:
        solve_box(program, np.zeros(5, np.int8))
    assert caught.value.iterations == 5


def test_units_of_single_components_do_not_matter_to_the_descent(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Of several that pull it releases by force over the root of their own stiffness, and takes as
    many steps. Few directions are stiff, so that bounds are met that have to be left again."""
    monkeypatch.setattr(box_program, "MOST_STEPS", 0)
    free = np.zeros(12, np.int8)
    for seed in range(30):
        rng = np.random.default_rng(seed)
        B = rng.normal(size=(12, 3))
        A = B @ B.T + 0.1 * np.eye(12)
        one = BoxProgram(A, A @ (2 * rng.normal(size=12)), -rng.random(12), rng.random(12))
        s = 2.0 ** rng.integers(-3, 4, 12)
        two = BoxProgram(A * np.outer(s, s), one.right * s, one.lower / s, one.upper / s)
        found, other = solve_box(one, free), solve_box(two, free)
        assert other.steps == found.steps
        assert np.array_equal(other.values * s, found.values)


@given(programs(total=True))
def test_the_descent_starts_within_the_bounds_and_with_the_total(program: BoxProgram) -> None:
    """From anywhere else it would not be downhill along faces of the box."""
    start = box_program._feasible(program)
    slack = 1e-12 * (1 + np.max(np.abs(start)))
    assert np.all((start >= program.lower - slack) & (start <= program.upper + slack))
    if program.total is not None:
        assert program.total.weights @ start == pytest.approx(program.total.value, abs=ENOUGH)
