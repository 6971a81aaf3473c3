"""Convex quadratic programs with non-negative unknowns: the normal problem at a given shear.

    minimise ½ xᵀA x - cᵀx   with   x >= 0   and, optionally,   v·x = t

A is symmetric and positive definite. In the normal problem, x is the pressure. The gradient
A x - c - λ v is the gap, weighted with the areas of the points. The multiplier λ of the prescribed
force is the approach.

A primal-dual active-set method improves a guess of the free components, which are the points in
contact (Hintermüller, Ito and Kunisch 2002). Each step solves the equations of the free components
exactly. This method takes few steps but may cycle. A primal active-set method then continues: it
releases one component per step, never increases the energy and therefore terminates (Nocedal and
Wright 2006, section 16.5).
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from contact_scene.array_types import Field, Mask, Matrix
from contact_scene.solver_errors import NotConverged

MAX_STEPS = 60
MAX_RELEASES = 50  # steps of the primal active-set method, per component
# Negative value over the largest value, below which the value is round-off.
ROUND_OFF = 1e-13


@dataclass(frozen=True)
class Total:
    """Linear condition v·x = t on the unknowns x of a quadratic program.

    In the normal problem of contact, x is the pressure of the points. The condition states that the
    sum of the pressures times the areas is the prescribed normal force.

    weights  v > 0 (n,), such as the areas of the points
    value    t, such as the normal force
    """

    weights: Field
    value: float


@dataclass(frozen=True)
class PressureProgram:
    """Quadratic program of the normal contact problem: minimise ½ xᵀA x - cᵀx with x >= 0.

    The unknowns x (n,) are the pressures of the points. The gradient A x - c, minus λ v with the
    multiplier λ of a condition, is the gap times the areas of the points.

    matrix  A (n, n), symmetric and positive definite
    right   c (n,)
    total   linear condition v·x = t for the normal force; None without a condition
    """

    matrix: Matrix
    right: Field
    total: Total | None = None


@dataclass(frozen=True)
class PressureSolution:
    """Solution of the normal contact problem: minimiser of a quadratic program with x >= 0.

    The components of x are the pressures of the points.

    values      x (n,)
    multiplier  λ of the linear condition v·x = t, with A x = c + λ v for the free components; 0
                without a condition. Under a prescribed normal force, λ is the approach
    free        True for free components, the points in contact; False for components at zero (n,)
    steps       number of linear systems solved
    """

    values: Field
    multiplier: float
    free: Mask
    steps: int


def solve_program(program: PressureProgram, guess: Mask) -> PressureSolution:
    """Compute the minimiser of a quadratic program with x >= 0 from a guess of its free components.

    In the normal contact problem, x (n,) is the pressure and the free components are the points in
    contact. Raise NotConverged if the set of free components does not converge.

    program  quadratic program, minimise ½ xᵀA x - cᵀx with x >= 0 and, optionally, v·x = t
    guess    True for components that are probably positive (n,)
    """
    free = guess
    seen: set[bytes] = set()
    for step in range(1, MAX_STEPS + 1):
        if program.total is not None and not np.any(free):
            break
        x, multiplier = _solve_free(program, free)
        after = _update_free(program, x, multiplier, free)
        if np.array_equal(after, free):
            return PressureSolution(np.maximum(x, 0.0), multiplier, free, step)
        free = after
        if free.tobytes() in seen:
            break
        seen.add(free.tobytes())
    return _minimise_by_descent(program, len(seen))


def _solve_free(program: PressureProgram, free: Mask) -> tuple[Field, float]:
    """Compute the minimiser of ½ xᵀA x - cᵀx among all x that are zero outside a given set.

    In the normal contact problem, x is the pressure and the set contains the points in contact.
    Return x (n,) and the multiplier λ of the linear condition v·x = t, or 0 without a condition.

    program  quadratic program with A, c, v and t
    free     True for the free components, whose values are computed (n,)
    """
    A, c, total = program.matrix, program.right, program.total
    x = np.zeros(len(c))
    if not np.any(free):
        return x, 0.0
    factor = cho_factor(A[np.ix_(free, free)], lower=True, check_finite=False)
    x[free] = cho_solve(factor, c[free], check_finite=False)
    if total is None:
        return x, 0.0
    v = total.weights[free]
    per_multiplier = cho_solve(factor, v, check_finite=False)
    multiplier = float((total.value - np.sum(v * x[free])) / np.sum(v * per_multiplier))
    x[free] += multiplier * per_multiplier
    return x, multiplier


def _lagrangian_gradient(program: PressureProgram, x: Field, multiplier: float) -> Field:
    """Compute the gradient A x - c - λ v of the Lagrangian of a quadratic program (n,).

    In the normal contact problem, x is the pressure, λ the approach, and the gradient the gap times
    the area of each point.

    program     quadratic program, minimise ½ xᵀA x - cᵀx with x >= 0 and v·x = t
    x           vector at which the gradient is computed (n,)
    multiplier  λ of the linear condition v·x = t
    """
    gradient = program.matrix @ x - program.right
    if program.total is not None:
        gradient -= multiplier * program.total.weights
    return np.asarray(gradient)


def _update_free(program: PressureProgram, x: Field, multiplier: float, free: Mask) -> Mask:
    """Update the set of free components of a quadratic program with x >= 0 after a solve (n,).

    In the normal contact problem the free components are the points in contact. Free components
    with a negative value leave the set and are fixed at zero. Fixed components with a negative
    gradient, which is an overlap, enter the set.

    program     quadratic program, minimise ½ xᵀA x - cᵀx with x >= 0 and v·x = t
    x           solution with the previous free components (n,)
    multiplier  λ of the linear condition v·x = t
    free        previous free components (n,)
    """
    little = ROUND_OFF * np.max(np.abs(x), initial=0.0)
    noise = ROUND_OFF * (np.abs(program.matrix) @ np.abs(x) + np.abs(program.right))
    released = _lagrangian_gradient(program, x, multiplier) < -noise
    return np.asarray(np.where(free, ~(x < -little), released))


def _minimise_by_descent(program: PressureProgram, spent: int) -> PressureSolution:
    """Minimise a quadratic program with x >= 0 by the primal active-set method, which cannot cycle.

    Used if the faster primal-dual active-set method cycles. The iteration starts with all
    components free. A step towards the minimiser of the free components ends where the first of
    them becomes zero. Raise NotConverged after MAX_RELEASES steps per component.

    program  quadratic program, minimise ½ xᵀA x - cᵀx with x >= 0 and v·x = t
    spent    number of linear systems that were already solved
    """
    total, count = program.total, len(program.right)
    free = np.ones(count, dtype=bool)
    x = np.full(count, 0.0 if total is None else total.value / np.sum(total.weights))
    size = 1 / np.sqrt(np.diag(program.matrix))
    for step in range(spent + 1, spent + MAX_RELEASES * count + 1):
        goal, multiplier = _solve_free(program, free)
        change = goal - x
        part = np.divide(-x, change, out=np.full(count, np.inf), where=change < 0)
        first = int(np.argmin(part))
        x = x + min(part[first], 1.0) * change
        if part[first] < 1:
            free[first], x[first] = False, 0.0
            continue
        pulling = _update_free(program, x, multiplier, free) & ~free
        if not np.any(pulling):
            return PressureSolution(np.maximum(x, 0.0), multiplier, free, step)
        force = np.abs(_lagrangian_gradient(program, x, multiplier)) * size
        free[np.argmax(np.where(pulling, force, -1.0))] = True
    raise NotConverged("the active set", spent + MAX_RELEASES * count, np.inf, ROUND_OFF)
