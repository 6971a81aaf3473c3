"""Convex quadratic programs with bounds: the form of the normal problem at a given shear.

    minimise ½ xᵀA x - cᵀx   with   lower <= x <= upper   and, optionally,   v·x = t

A is symmetric and positive definite. In the normal problem, x is the pressure with the bounds
(0, ∞). The gradient A x - c - λ v is the gap, weighted with the areas of the points. The multiplier
λ of the prescribed force is the approach.

A primal-dual active-set method improves a guess of the components at their bounds (Hintermüller,
Ito and Kunisch 2002). Each step solves the equations of the free components exactly. No component
changes from one bound to the other without being free in between. This method takes few steps but
may cycle. A primal active-set method then continues: it releases one component per step, never
increases the energy and therefore terminates (Nocedal and Wright 2006, section 16.5).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from contact_scene.array_types import Field, Matrix
from contact_scene.solver_errors import NotConverged

Sides = NDArray[np.int8]

MAX_STEPS = 60
MAX_RELEASES = 50  # steps of the primal active-set method, per component
# Violation of a bound over the largest value, below which the violation is round-off.
ROUND_OFF = 1e-13


@dataclass(frozen=True)
class Total:
    """Linear condition v·x = t on the unknowns x of a quadratic program.

    In the normal problem, x is the pressure and the condition prescribes the normal force.

    weights  v (n,), positive for all components whose bounds differ; point areas for a normal force
    value    t, such as the normal force
    """

    weights: Field
    value: float


@dataclass(frozen=True)
class BoxProgram:
    """Quadratic program: minimise ½ xᵀA x - cᵀx with lower <= x <= upper.

    The normal problem has this form. The unknowns x (n,) are then the pressures of the points, with
    the lower bound 0.

    matrix        A (n, n), symmetric and positive definite
    right         c (n,)
    lower, upper  bounds of x (n,)
    total         linear condition v·x = t; None without a condition
    """

    matrix: Matrix
    right: Field
    lower: Field
    upper: Field
    total: Total | None = None


@dataclass(frozen=True)
class BoxSolution:
    """Minimiser of a quadratic program with bounds.

    values      x (n,)
    multiplier  λ of the linear condition, with A x = c + λ v for the free components; 0 without a
                condition
    sides       active set (n,): -1 at the lower bound, 0 free, +1 at the upper bound; 0 if the
                bounds are equal
    steps       number of linear systems solved
    """

    values: Field
    multiplier: float
    sides: Sides
    steps: int


def solve_box(program: BoxProgram, guess: Sides) -> BoxSolution:
    """Compute the minimiser of a quadratic program with bounds from a guess of the active set.

    The program must be feasible: t of the linear condition, if there is one, is between the values
    of v·x at the two bounds. Raise NotConverged if the active set does not converge.

    guess  -1 for components at the lower bound, 0 for free ones, +1 for those at the upper bound
           (n,)
    """
    fixed = program.lower == program.upper
    sides = np.where(fixed, -1, guess).astype(np.int8)
    seen: set[bytes] = set()
    for step in range(1, MAX_STEPS + 1):
        if program.total is not None and not np.any(sides == 0):
            break
        x, multiplier = _on_free(program, sides)
        after = _moved(program, x, multiplier, sides, fixed)
        if np.array_equal(after, sides):
            return _solution(program, x, multiplier, sides, step)
        sides = after
        if sides.tobytes() in seen:
            break
        seen.add(sides.tobytes())
    return _descend(program, fixed, len(seen))


def _on_free(program: BoxProgram, sides: Sides) -> tuple[Field, float]:
    """Solve a quadratic program ½ xᵀA x - cᵀx with a given active set of its bounds.

    Components at a bound keep the value of the bound. The equations of the free components are
    solved exactly. Return x (n,) and the multiplier λ of the linear condition v·x = t, or 0 without
    a condition.

    sides  active set: -1 at the lower bound, 0 free, +1 at the upper bound (n,)
    """
    A, c, total = program.matrix, program.right, program.total
    free = sides == 0
    x = np.where(sides < 0, program.lower, program.upper)
    x[free] = 0.0
    if not np.any(free):
        return x, 0.0
    fixed = ~free
    factor = cho_factor(A[np.ix_(free, free)], lower=True, check_finite=False)
    rest = c[free] - A[np.ix_(free, fixed)] @ x[fixed]
    y = cho_solve(factor, rest, check_finite=False)
    if total is None:
        x[free] = y
        return x, 0.0
    v = total.weights
    per_multiplier = cho_solve(factor, v[free], check_finite=False)
    missing = total.value - np.sum(v[fixed] * x[fixed]) - np.sum(v[free] * y)
    multiplier = float(missing / np.sum(v[free] * per_multiplier))
    x[free] = y + multiplier * per_multiplier
    return x, multiplier


def _gradient(program: BoxProgram, x: Field, multiplier: float) -> Field:
    """Compute the gradient A x - c - λ v of the Lagrangian of a quadratic program (n,).

    A and c define the energy ½ xᵀA x - cᵀx. The sign of the gradient at a bound decides if the
    component becomes free.

    multiplier  λ of the linear condition v·x = t
    """
    gradient = program.matrix @ x - program.right
    if program.total is not None:
        gradient -= multiplier * program.total.weights
    return np.asarray(gradient)


def _moved(
    program: BoxProgram, x: Field, multiplier: float, sides: Sides, fixed: NDArray[np.bool_]
) -> Sides:
    """Update the active set of the bounds of a quadratic program after a solve.

    Free components beyond a bound are fixed at this bound. Components at a bound become free if the
    energy decreases towards the inside.

    x           solution with the previous active set (n,)
    multiplier  λ of the linear condition v·x = t
    sides       previous active set: -1 at the lower bound, 0 free, +1 at the upper bound (n,)
    fixed       True for components whose two bounds are equal (n,)
    """
    little = ROUND_OFF * np.max(np.abs(x), initial=0.0)
    gradient = _gradient(program, x, multiplier)
    noise = ROUND_OFF * (np.abs(program.matrix) @ np.abs(x) + np.abs(program.right))
    after = sides.copy()
    free = sides == 0
    after[free & (x < program.lower - little)] = -1
    after[free & (x > program.upper + little)] = 1
    after[(sides < 0) & (gradient < -noise) & ~fixed] = 0
    after[(sides > 0) & (gradient > noise) & ~fixed] = 0
    return after


def _solution(
    program: BoxProgram, x: Field, multiplier: float, sides: Sides, steps: int
) -> BoxSolution:
    """Create the solution of a quadratic program from x, which is clipped to the bounds.

    Components whose two bounds are equal have the entry 0 in the active set of the solution.
    """
    room = program.lower < program.upper
    within = np.clip(x, program.lower, program.upper)
    return BoxSolution(within, multiplier, np.where(room, sides, 0).astype(np.int8), steps)


def _descend(program: BoxProgram, fixed: NDArray[np.bool_], spent: int) -> BoxSolution:
    """Minimise a quadratic program by the primal active-set method, from a feasible point.

    Used if the primal-dual active-set method cycles. Raise NotConverged after MAX_RELEASES steps
    per component.

    fixed  True for components whose two bounds are equal (n,)
    spent  number of linear systems that were already solved
    """
    sides = np.where(fixed, -1, 0).astype(np.int8)
    x = _feasible(program)
    size = 1 / np.sqrt(np.diag(program.matrix))
    for step in range(spent + 1, spent + MAX_RELEASES * len(x) + 1):
        goal, multiplier = _on_free(program, sides)
        part, blocking, side = _room(program, x, goal, sides)
        x = x + part * (goal - x)
        if blocking is not None:
            sides[blocking] = side
            x[blocking] = program.lower[blocking] if side < 0 else program.upper[blocking]
            continue
        moved = _moved(program, x, multiplier, sides, fixed)
        pulling = (moved == 0) & (sides != 0)
        if not np.any(pulling):
            return _solution(program, x, multiplier, sides, step)
        force = np.abs(_gradient(program, x, multiplier)) * size
        sides[np.argmax(np.where(pulling, force, -1.0))] = 0
    raise NotConverged("the active set", spent + MAX_RELEASES * len(x), np.inf, ROUND_OFF)


def _feasible(program: BoxProgram) -> Field:
    """Return a point x (n,) that satisfies the bounds and the linear condition of a program.

    Used as the initial point of the primal active-set method for a quadratic program.
    """
    lower, upper, total = program.lower, program.upper, program.total
    if total is None:
        return np.where(np.isfinite(upper), 0.5 * (lower + upper), lower)
    least = np.sum(total.weights * lower)
    endless = ~np.isfinite(upper)
    if np.any(endless):
        share = (total.value - least) / np.sum(total.weights[endless])
        return np.where(endless, lower + share, lower)
    part = (total.value - least) / (np.sum(total.weights * upper) - least)
    return np.asarray(lower + part * (upper - lower))


def _room(
    program: BoxProgram, x: Field, goal: Field, sides: Sides
) -> tuple[float, int | None, int]:
    """Compute the largest part of a step towards a minimiser that violates no bound.

    The step of a quadratic program goes from x to `goal`. Return the part of the step (0 to 1), the
    index of the component that reaches its bound first, and the bound (-1 lower, +1 upper). The
    index is None if the full step is admissible.

    x      current feasible point (n,)
    goal   minimiser of the free components (n,)
    sides  active set: -1 at the lower bound, 0 free, +1 at the upper bound (n,)
    """
    step = np.where(sides == 0, goal - x, 0.0)
    limit = np.where(step < 0, program.lower, program.upper)
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(step != 0, (limit - x) / step, np.inf)
    first = int(np.argmin(part))
    if part[first] >= 1:
        return 1.0, None, 0
    return max(0.0, float(part[first])), first, -1 if step[first] < 0 else 1
