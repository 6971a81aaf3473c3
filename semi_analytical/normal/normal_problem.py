"""Active-set Newton method for the normal problem: p >= 0, gap >= 0, p gap = 0 under a load.

Among all admissible pressures the contact pressure minimises the energy ½ p·A p + h·p (Kalker 1990,
chapter 4). Each step estimates the contact set (p > 0 or overlap), solves the linear problem on it
by preconditioned conjugate gradients and makes the solution admissible. A line search accepts steps
that reduce the energy sufficiently. If it fails, cells in tension leave the contact set
successively (Lawson and Hanson 1974), so that the contact sets cannot cycle.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask
from contact_scene.solver_errors import NotConverged
from semi_analytical.normal.normal_load import (
    Map,
    Motion,
    NormalLoad,
    Projection,
)

MAX_STEPS = 200
MAX_ITERATIONS_PER_STEP = 200
# Limit for one solve; plate-like films on 48 x 48 cells take up to 8 000.
MAX_ITERATIONS = 20_000
MAX_HALVINGS = 5
# Reduction of the residual norm by a linear solve: while the contact set changes, and while cells
# leave it. The solutions are intermediate.
MOVING = 0.3
ROUGHLY = 0.5
# Least decrease of the energy relative to that by its slope (Armijo's condition).
LEAST_FALL = 0.1


@dataclass(frozen=True)
class NormalSolution:
    """Solution of the normal problem (contact without penetration, given shear) under one load.

    pressure, displacement  p [force/length^2] and normal surface displacement u_z [length], each
                            (nx, ny)
    motion                  rigid motion of the indenter: approach, and tilt under prescribed
                            moments
    iterations              iterations of all linear solves
    first_residual          residual of the initial guess, dimensionless
    """

    pressure: Field
    displacement: Field
    motion: Motion
    iterations: int
    first_residual: float


@dataclass(frozen=True)
class _Problem:
    """Normal problem of one increment: pressure without penetration under a load.

    displace, precondition  map from pressure (nx, ny) to normal displacement, and its approximate
                            inverse
    h                       undeformed gap (nx, ny) [length]; zero where it is infinite
    allowed                 cells of finite gap, which can come into contact (nx, ny)
    load                    prescribed normal load
    """

    displace: Map
    precondition: Map
    h: Field
    allowed: Mask
    load: NormalLoad

    def residual(self, p: Field, g: Field, overlap: float) -> float:
        """Return the larger of the complementarity and penetration residuals of the normal problem.

        Complementarity is Σ|g| p / Σp (pressure acts where the gap is open), penetration the
        largest overlap of the deformed bodies. Each is divided by the overlap of the undeformed
        bodies.

        p        pressure (nx, ny)
        g        gap (nx, ny) [length]; negative where the deformed bodies overlap
        overlap  overlap of the undeformed bodies [length]
        """
        total = p.sum()  # zero where a step under a fixed approach has overshot
        complementarity = np.vdot(np.abs(g), p) / total if total > 0 else 0.0
        penetration = -np.where(self.allowed, g, 0.0).min()
        # A NaN is larger than any number.
        return float(np.maximum(complementarity, penetration) / overlap)


def solve_normal(
    displace: Map,
    precondition: Map,
    gap: Field,
    load: NormalLoad,
    start: Field,
    tolerance: float,
    enough: float = 0.0,
) -> NormalSolution:
    """Compute the contact pressure and the rigid motion of the indenter for an undeformed gap.

    The active-set Newton method of this module is used.

    displace      function pressure (nx, ny) -> normal displacement (nx, ny); symmetric, positive
                  definite
    precondition  approximate inverse of `displace`; symmetric, positive definite
    gap           undeformed gap (nx, ny) [length]; infinite where contact is impossible
    load          prescribed normal force or approach, and moments
    start         initial pressure (nx, ny), not zero everywhere
    tolerance     limit of complementarity Σ|g|p / (δ Σp) and penetration max(-g) / δ,
                  dimensionless; g is the gap and δ the overlap of the undeformed bodies
    enough        reduction of the initial residual that suffices, if above the tolerance
    raises        NotConverged
    """
    allowed = np.isfinite(gap)
    h = np.where(allowed, gap, 0.0)
    problem = _Problem(displace, precondition, h, allowed, load)
    p = load.admissible(np.where(allowed, start, 0.0))
    u = displace(p)
    iterations, first, last = 0, np.inf, None
    for number in range(MAX_STEPS):
        s = u + h
        motion = load.motion(p, s)
        g = s - load.closure(motion)
        residual = problem.residual(p, g, load.overlap(motion, h, allowed))
        first = residual if number == 0 else first
        aim = max(tolerance, enough * first)
        if residual <= aim:
            return NormalSolution(p, u, motion, iterations, first)
        if iterations > MAX_ITERATIONS:
            break
        contact = allowed & ((p > 0) | (g < 0))
        # The reduction reaches the tolerance once the contact set is final; it is weak before.
        settled = last is not None and bool((contact == last).all())
        depth = max(0.0 if settled else MOVING, 0.3 * aim / residual)
        last = contact
        newton, newton_u, spent = _solve_on(contact, problem, p, u, g, depth)
        iterations += spent
        p, u, spent = _line_search(newton, newton_u, problem, p, u, g)
        iterations += spent
    raise NotConverged("the pressure", iterations, residual, tolerance)


def _solve_on(
    contact: Mask, problem: _Problem, p: Field, u: Field, g: Field, depth: float
) -> tuple[Field, Field, int]:
    """Solve for the pressure that closes the gap on a fixed contact set.

    The linear problem of one Newton step is solved: pressures may become negative. Return pressure,
    displacement and number of conjugate-gradient iterations.

    contact  contact set, which contains all cells under pressure (nx, ny)
    p, u, g  pressure, displacement and gap at the start (nx, ny)
    depth    reduction of the residual norm at which the iteration stops
    """
    projected = problem.load.projection(contact.astype(np.float64))
    return close_gap(problem.displace, problem.precondition, projected, p, u, g, depth)


def close_gap(
    displace: Map,
    precondition: Map,
    projected: Projection,
    p: Field,
    u: Field,
    g: Field,
    depth: float,
) -> tuple[Field, Field, int]:
    """Solve for the pressure that closes the gap on a contact set, by conjugate gradients.

    Return pressure, displacement and number of iterations.

    displace      function pressure (nx, ny) -> normal displacement (nx, ny)
    precondition  approximate inverse of `displace`
    projected     projection of pressure changes on the contact set and on constant prescribed
                  forces
    p, u, g       pressure, displacement and gap at the start (nx, ny)
    depth         reduction of the residual norm at which the iteration stops
    """
    p, u, r = p.copy(), u.copy(), projected(-g)
    t = z = projected(precondition(r))
    rz = first = np.vdot(r, z)
    iterations = 0
    while rz > depth**2 * first and iterations < MAX_ITERATIONS_PER_STEP:
        iterations += 1
        A_t = displace(t)
        step = rz / np.vdot(t, A_t)
        p += step * t
        u += step * A_t
        r -= step * projected(A_t)
        z = projected(precondition(r))
        rz, last = np.vdot(r, z), rz
        t = z + (rz / last) * t
    return p, u, iterations


def _line_search(
    newton: Field,
    newton_u: Field,
    problem: _Problem,
    p: Field,
    u: Field,
    g: Field,
) -> tuple[Field, Field, int]:
    """Accept the pressure of a Newton step, with negative values set to zero, or a shorter step.

    The energy must decrease sufficiently. Under a stiff coating pressure lifts adjacent cells, and
    setting all negative pressures to zero at once may raise the energy repeatedly. Cells then leave
    the contact set successively. Return pressure, displacement and iterations.

    newton, newton_u  pressure and displacement after the full Newton step (nx, ny)
    p, u, g           pressure, displacement and gap of the last accepted point (nx, ny)
    """
    step = 1.0
    for _ in range(MAX_HALVINGS):
        target = newton if step == 1 else p + step * (newton - p)
        target_u = newton_u if step == 1 else u + step * (newton_u - u)
        if target.min() < 0:
            target = problem.load.admissible(target)
            target_u = problem.displace(target)
        if _decreases_energy(target - p, target_u - u, g):
            return target, target_u, 0
        step /= 2
    return _remove_tension(newton, newton_u, problem, p, u, g)


def _remove_tension(
    newton: Field,
    newton_u: Field,
    problem: _Problem,
    p: Field,
    u: Field,
    g: Field,
) -> tuple[Field, Field, int]:
    """Remove cells with negative pressure from the contact set, until none is left.

    The method is that of Lawson and Hanson (1974, ch. 23). Each pass moves towards the Newton point
    until `many` cells reach zero pressure, at most half of the negative ones. If the energy does
    not decrease sufficiently, `many` is halved. With `many` = 1 the energy always decreases, so
    that every pass removes at least one cell. Return pressure, displacement and iterations.

    newton, newton_u  pressure and displacement after the full Newton step (nx, ny)
    p, u, g           pressure, displacement and gap of the last accepted point (nx, ny)
    """
    contact = (p > 0) | (newton != 0)
    iterations, many = 0, newton.size
    while np.any(newton < 0):
        if iterations > MAX_ITERATIONS:
            return p, u, iterations
        # Fraction of the step at which each cell in tension reaches zero pressure.
        part_of_way = np.where(newton < 0, p / np.where(newton < 0, p - newton, 1.0), np.inf)
        parts = np.sort(part_of_way[newton < 0])
        many = max(1, min(2 * many, len(parts) // 2))
        while True:
            part = parts[many - 1]
            target, target_u = p + part * (newton - p), u + part * (newton_u - u)
            if part == parts[0]:
                break
            target = problem.load.admissible(target)
            target_u = problem.displace(target)
            iterations += 1
            if _decreases_energy(target - p, target_u - u, g):
                break
            many //= 2
        contact = contact & (part_of_way > part)
        p, u, g = np.where(contact, target, 0.0), target_u, g + (target_u - u)
        newton, newton_u, spent = _solve_on(contact, problem, p, u, g, ROUGHLY)
        iterations += spent
    return newton, newton_u, iterations


def _decreases_energy(d: Field, d_u: Field, g: Field) -> bool:
    """Return True if a change of the pressure decreases the elastic contact energy sufficiently.

    The criterion is Armijo's condition: the decrease is at least 10 % of the decrease by the slope.

    d, d_u  changes of pressure and displacement (nx, ny)
    g       gap before the change (nx, ny), the gradient of the energy
    """
    slope = np.vdot(d, g)
    return bool(slope + 0.5 * np.vdot(d, d_u) <= LEAST_FALL * slope)
