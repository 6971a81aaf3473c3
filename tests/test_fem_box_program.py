"""Quadratic programs with bounds: the answer is the minimum, however it was found."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

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
    steps = box_program.MAX_STEPS
    try:
        box_program.MAX_STEPS = 0
        slow = solve_box(program, free)
    finally:
        box_program.MAX_STEPS = steps
    assert_optimal(program, slow)
    assert slow.values == pytest.approx(solve_box(program, free).values, abs=1e-8)


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


def test_who_rests_at_a_bound_without_being_pulled_stays_there() -> None:
    """Its gradient is zero: it could be free as well, and then would be told so."""
    lower, endless = np.zeros(2), np.full(2, np.inf)
    program = BoxProgram(np.array([[4.0, 1.0], [1.0, 2.0]]), np.array([4.0, 1.0]), lower, endless)
    found = solve_box(program, np.array([0, -1], np.int8))
    assert found.values.tolist() == [1.0, 0.0]
    assert found.sides.tolist() == [0, -1]
    assert found.steps == 1
