"""Pressure and radial shear in one linear system, once it is all but known what touches and slips.

With the sides given - apart or touching, sticking or slipping one way or the other - pressure and
shear solve linear equations:

    touching   A p + Bᵀ q - δ w = -h         apart      p = 0
    sticking   C q + B p = s                 slipping   q = ±µ p

Where the solution contradicts a side, that side is changed, and no slip is reversed at once. This
is Newton's method for the piecewise linear problem (Alart and Curnier 1991): it ends after few
steps from nearby sides, however strong the friction, and may never end from others.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, solve

from fem_reference.contact.box_program import ROUND_OFF, Sides
from fem_reference.contact.complementarity.contact_problem import ContactProblem
from fem_reference.loads import NormalTarget

Field = NDArray[np.float64]

MOST_STEPS = 25


@dataclass(frozen=True)
class Coupled:
    """Pressure, approach and shear in equilibrium, and what that took.

    contact   -1 where the surfaces are apart, 0 where they touch
    slipping  0 where they stick, ±1 where they slip against a shear of that sign
    steps     linear systems solved
    sweeps    solutions of pressure and shear in turn
    """

    pressure: Field
    approach: float
    shear: Field
    contact: Sides
    slipping: Sides
    steps: int = 0
    sweeps: int = 0


def settle(
    problem: ContactProblem,
    target: NormalTarget,
    before: Field,
    contact: Sides,
    slipping: Sides,
) -> Coupled | int:
    """The coupled increment from nearby sides, or else the number of linear systems wasted.

    before  displacement of the surfaces past each other before the increment, over the hats
    """
    touching, sides = contact == 0, slipping.copy()
    seen: set[bytes] = set()
    for step in range(1, MOST_STEPS + 1):
        try:
            p, q, approach = _on_sides(problem, target, before, touching, sides)
        except LinAlgError:
            return step
        now, then = _moved(problem, p, q, approach, before, touching, sides)
        if np.array_equal(now, touching) and np.array_equal(then, sides):
            apart = np.where(touching, 0, -1).astype(np.int8)
            p = np.maximum(p, 0.0)
            return Coupled(p, approach, _within(problem, p, q), apart, sides, step)
        touching, sides = now, then
        if touching.tobytes() + sides.tobytes() in seen or not touching.any():
            return step
        seen.add(touching.tobytes() + sides.tobytes())
    return MOST_STEPS


def _within(problem: ContactProblem, p: Field, q: Field) -> Field:
    """Without the round-off beyond the friction limit."""
    assert problem.sideways is not None
    bound = problem.sideways.friction.limit(p)
    return np.asarray(np.clip(q, -bound, bound))


def _on_sides(
    problem: ContactProblem,
    target: NormalTarget,
    before: Field,
    touching: NDArray[np.bool_],
    sides: Sides,
) -> tuple[Field, Field, float]:
    """Pressure, shear and approach where nothing leaves its side."""
    sideways = problem.sideways
    assert sideways is not None
    assert sideways.by_pressure is not None
    A, B, C = problem.normal, sideways.by_pressure, sideways.compliance
    ring = np.arange(len(before))
    c, s = ring[touching], ring[touching & (sides == 0) & (ring > 0)]
    slope = sideways.friction.slope() * sides[c]
    # Slipping shear follows the pressure of its ring.
    normal = A[np.ix_(c, c)] + B.T[np.ix_(c, c)] * slope
    shear = B[np.ix_(s, c)] + C[np.ix_(s, c)] * slope
    system = np.block([[normal, B.T[np.ix_(c, s)]], [shear, C[np.ix_(s, s)]]])
    right = np.concatenate([-problem.gap[c], before[s]])
    w = np.concatenate([problem.weights[c], np.zeros(len(s))])
    found = solve(system, np.column_stack([right, w]))
    if target.force is None:
        assert target.approach is not None
        approach = target.approach
    else:
        force = target.force / (2 * np.pi)
        approach = float((force - np.sum(w * found[:, 0])) / np.sum(w * found[:, 1]))
    both = found[:, 0] + approach * found[:, 1]
    p, q = np.zeros(len(ring)), np.zeros(len(ring))
    p[c] = both[: len(c)]
    q[c] = slope * p[c]
    q[s] = both[len(c) :]
    return p, q, approach


def _moved(
    problem: ContactProblem,
    p: Field,
    q: Field,
    approach: float,
    before: Field,
    touching: NDArray[np.bool_],
    sides: Sides,
) -> tuple[NDArray[np.bool_], Sides]:
    """The sides that a solution asks for: apart where it pulls or there is a gap, and so on."""
    sideways = problem.sideways
    assert sideways is not None
    assert sideways.by_pressure is not None
    A, B, C = problem.normal, sideways.by_pressure, sideways.compliance
    gap = A @ p + B.T @ q + problem.gap - approach * problem.weights
    slip = C @ q + B @ p - before
    noise = ROUND_OFF * (np.abs(A) @ np.abs(p) + np.abs(problem.gap))
    little = ROUND_OFF * np.max(np.abs(p))
    now = np.where(touching, p >= -little, gap < -noise)
    bound = sideways.friction.limit(np.maximum(p, 0.0))
    noise = ROUND_OFF * (np.abs(C) @ np.abs(q) + np.abs(B) @ np.abs(p) + np.abs(before))
    then = sides.copy()
    sticks = touching & (sides == 0)
    beyond = sticks & (np.abs(q) > bound + ROUND_OFF * np.max(np.abs(q)))
    then[beyond] = np.sign(q[beyond])
    # Slip against the shear goes on; with it, the ring sticks.
    then[touching & (sides != 0) & (sides * slip > noise)] = 0
    then[0] = 0
    return now, then.astype(np.int8)
