"""The penalty model as springs in series with the bodies: two convex halves in turn.

With the shear held, the normal springs and the bodies minimise a convex energy; with the pressure
held, so do the tangential springs, whose energy is quadratic up to the friction limit and linear
beyond it. Newton's method with an exact line search on the energy cannot fail on either half.
Only the alternation may: it contracts as long as friction and coupling are not both strong.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.penalty.newton import Iterate, defect
from fem_reference.contact.penalty.spring_contact import PenaltyLaw, Response
from fem_reference.contact.penalty.step import newton_step
from fem_reference.contact.penalty.surface import ElasticSurface, Target

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Springs = Callable[[Field], Response]

MOST_SWEEPS = 200
MOST_ITERATIONS = 100
BISECTIONS = 40
INNER = 0.1  # part of the tolerance to which each half is solved
# So near to the solution the energy drowns in round-off: bare Newton steps, while they gain.
NEAR = 1e-6
STALLED = 0.5
MOST_IDLE = 10  # sweeps without gain, by round-off or because the alternation does not contract
NORMAL, TANGENTIAL = slice(0, 1), slice(1, None)


def solve_by_springs(
    surface: ElasticSurface, law: PenaltyLaw, target: Target, start: Iterate, tolerance: float
) -> Iterate:
    """Alternate until the residual is within the tolerance, or falls no more.

    The caller reads from `residual` whether it has converged.
    """
    start = _pressed_on(surface, law, target, start)
    residual, _ = defect(surface, law, start, target)
    at = replace(start, residual=residual, history=(residual,), iterations=0, sweeps=0)
    best, idle = np.inf, 0
    while at.residual > tolerance and at.sweeps < MOST_SWEEPS and idle < MOST_IDLE:
        at = _half(surface, law.normal_springs, law.stiffness, target, at, NORMAL, tolerance)
        if len(at.traction) > 1:
            springs = partial(law.tangential_springs, pressure=at.traction[0])
            at = _half(surface, springs, law.stiffness, target, at, TANGENTIAL, tolerance)
        residual, _ = defect(surface, law, at, target)
        history = (*at.history, residual)
        at = replace(at, residual=residual, history=history, sweeps=at.sweeps + 1)
        best, idle = min(best, residual), 0 if residual < best else idle + 1
    return at


def _pressed_on(
    surface: ElasticSurface, law: PenaltyLaw, target: Target, start: Iterate
) -> Iterate:
    """A start with contact: without it a free approach has no stiffness.

    Half of the points are pressed: from a contact that is too large the active points are found
    in fewer steps than from one that is too small.
    """
    overlap = surface.overlap(start.traction, start.coordinates)
    if not target.free[0] or np.any(law.response(overlap).in_contact):
        return start
    coordinates = start.coordinates.copy()
    coordinates[0] -= np.median(overlap[0])
    return replace(start, coordinates=coordinates)


def _half(
    surface: ElasticSurface,
    springs: Springs,
    stiffness: float,
    target: Target,
    at: Iterate,
    components: slice,
    tolerance: float,
) -> Iterate:
    """Relax some components while the tractions of the others are held."""
    traction, coordinates = at.traction.copy(), at.coordinates.copy()
    traction[components], coordinates[components], iterations = relax(
        surface.part(components, at.traction),
        springs,
        stiffness,
        target.part(components),
        (at.traction[components], at.coordinates[components]),
        INNER * tolerance,
    )
    iterations += at.iterations
    return replace(at, traction=traction, coordinates=coordinates, iterations=iterations)


def relax(
    surface: ElasticSurface,
    springs: Springs,
    stiffness: float,
    target: Target,
    start: tuple[Field, Vector],
    tolerance: float,
) -> tuple[Field, Vector, int]:
    """Least energy of bodies and springs: tractions, rigid coordinates, linear systems solved.

    tolerance  of the L1 norm of traction minus springs', over that of the springs'
    """
    traction, coordinates = start
    before = np.inf
    for iteration in range(MOST_ITERATIONS):
        overlap = surface.overlap(traction, coordinates)
        response = springs(overlap)
        missing = response.traction - traction
        unbalanced = np.where(target.free, target.value - surface.resultant(traction), 0.0)
        missed = np.sum(surface.weights * np.abs(missing))
        missed += np.sum(np.abs(unbalanced) / surface.lever)
        carried = np.sum(surface.weights * np.abs(response.traction))
        settled = missed >= STALLED * before and missed <= NEAR * carried
        if missed <= tolerance * carried or settled:
            return traction, coordinates, iteration
        step, move = newton_step(surface, stiffness, response, missing, unbalanced, target.free)
        length = 1.0
        if missed > NEAR * carried:
            length = _least_energy(surface, springs, target, (traction, overlap), (step, move))
        traction, coordinates = traction + length * step, coordinates + length * move
        before = missed
    return traction, coordinates, MOST_ITERATIONS


def _least_energy(
    surface: ElasticSurface,
    springs: Springs,
    target: Target,
    at: tuple[Field, Field],
    change: tuple[Field, Vector],
) -> float:
    """The step length in (0, 1] of least energy: where its slope, which only grows, vanishes.

    at      tractions and overlaps; change  of tractions and coordinates
    """
    (traction, overlap), (step, move) = at, change
    displaced = surface.displacement(step)
    moved = surface.motion * move[:, None] - displaced

    def slope(length: float) -> float:
        sprung = springs(overlap + length * moved).traction
        work = displaced * (traction + length * step - sprung) * surface.weights
        excess = (surface.resultant(sprung) - target.value) * move
        return float(np.sum(work) + np.sum(excess[target.free]))

    if slope(1.0) <= 0:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if slope(middle) < 0 else (low, middle)
    return high
