"""Tangential problem at a given pressure: sticking and slipping points by projected Newton steps.

With the given friction limit µp, the shear q minimises the energy ½ qᵀKq − cᵀq. Each shear vector
lies within a disc of radius µp, and the resultant may be prescribed as T. The problem is convex.
The multiplier of the resultant is the shift ω of the indenter.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from contact_scene.array_types import Field, Mask, Matrix, Vector
from contact_scene.solver_errors import NotConverged
from fem_reference.contact.admissible_shear import project
from fem_reference.loads import TangentialTarget

MAX_STEPS = 100
# Relative residual below which the decrease of the energy is round-off. Newton steps are then
# taken without line search.
ENERGY_ROUND_OFF = 1e-5
# Least shear, as a fraction of the friction limit, to which the residual is relative.
LEAST_SHEAR = 1e-6
GRADIENT_STEPS = 2


@dataclass(frozen=True)
class ShearProblem:
    """Tangential problem of contact at a given pressure: the shear of least energy.

    The energy is ½ qᵀKq − cᵀq of the shear q at the contact points. Each shear vector must lie
    within the friction limit of its point. The resultant of the shear may be prescribed.

    compliance  K (2 points, 2 points), components outermost, with w u_t = K q
    target      c = w (u_t − ω of the previous state − u_t by the new pressure) (2, points): the
                area-weighted displacement by shear under full stick and zero shift; ω is the rigid
                motion
    areas       areas w that the points represent (points,) [length^2]
    along       factors of the shear in the load T = Σ along · q; also w times the displacement per
                unit shift (2, points)
    bound       friction limit µp > 0 (points,) [force/length^2]
    control     prescribed tangential load or motion
    """

    compliance: Matrix
    target: Field
    areas: Vector
    along: Field
    bound: Vector
    control: TangentialTarget


@dataclass(frozen=True)
class TangentialState:
    """Solution of the tangential contact problem at a given pressure: shear and shift.

    shear     shear at the points (2, points) [force/length^2]
    shift     shift [length] or twist [radian] of the indenter; None at the friction limit, where it
              is undefined
    in_slip   True for slipping points (points,)
    residual  relative residual of the shear [1]
    solves    number of linear systems solved
    """

    shear: Field
    shift: float | None
    in_slip: Mask
    residual: float
    solves: int


def solve_shear(problem: ShearProblem, start: Field, tolerance: float) -> TangentialState:
    """Solve the tangential problem at a given pressure: the shear, and the shift of the indenter.

    The shear minimises the energy ½ qᵀKq − cᵀq, and each shear vector is within the friction limit
    of its point. Newton steps for fixed stick and slip zones alternate with a projection onto the
    admissible shears.

    problem    compliance, friction limit and prescribed load of the tangential problem
    start      initial guess of the shear (2, points)
    tolerance  limit of Σ w|q − P(q − ∇/d)| / Σ w|q| [1], with the areas w, the gradient ∇ of the
               energy, the projection P onto the admissible shears and the weights d of its norm
    raises     NotConverged
    """
    K, motion = problem.compliance, problem.control.motion
    c = problem.target if motion is None else problem.target + motion * problem.along
    # Equal weights of both components leave the friction limit of a point a disc.
    d = np.mean(np.diagonal(K).reshape(2, -1), axis=0)
    along, bound, total = problem.along, problem.bound, problem.control.load
    least = LEAST_SHEAR * np.sum(problem.areas * bound)
    q, _ = project(start, bound, d, along, total)
    residual, solves = np.inf, 0
    for _ in range(MAX_STEPS):
        slope = (K @ q.ravel()).reshape(q.shape) - c
        nearest, omega = project(q - slope / d, bound, d, along, total)
        z = q - slope / d + omega * along / d
        length = np.sqrt(z[0] ** 2 + z[1] ** 2)
        moved = nearest - q
        scale = max(_integrate_magnitude(problem.areas, nearest), least)
        residual = _integrate_magnitude(problem.areas, moved) / scale
        in_slip = length > bound
        if residual <= tolerance:
            shift = omega if motion is None else motion
            return TangentialState(q, shift, in_slip, residual, solves)
        aimed = _newton_point(problem, c, z, length, in_slip, d)
        aimed, _ = project(aimed, bound, d, along, total)
        solves += 1
        if residual < ENERGY_ROUND_OFF:
            q = aimed
            continue
        q, gained = _line_minimum(K, slope, q, aimed)
        if gained > -1e-4 * np.sum(slope * moved):
            continue
        for _ in range(GRADIENT_STEPS):
            slope = (K @ q.ravel()).reshape(q.shape) - c
            nearest, _ = project(q - slope / d, bound, d, along, total)
            q, _ = _line_minimum(K, slope, q, nearest)
    raise NotConverged("the shear", solves, residual, tolerance)


def _integrate_magnitude(areas: Vector, vectors: Field) -> float:
    """Compute the integral of the magnitude of a shear field over the contact area [force].

    Used to compute the relative residual of the tangential problem: the integral of the change of
    the shear over the integral of the shear.

    areas    areas that the points represent (points,) [length^2]
    vectors  shear vectors, or changes of shear vectors, at the points (2, points)
    """
    return float(np.sum(areas * np.sqrt(vectors[0] ** 2 + vectors[1] ** 2)))


def _line_minimum(K: Matrix, slope: Field, q: Field, end: Field) -> tuple[Field, float]:
    """Compute the shear of least energy on the line between two shear fields.

    The energy is that of the tangential problem, ½ qᵀKq − cᵀq. Return the shear (2, points) and the
    decrease of the energy from the start of the line. Used as the line search of a Newton step.

    K       compliance matrix of the contact points (2 points, 2 points)
    slope   gradient K q − c of the energy at the start of the line (2, points)
    q, end  shear fields at the start and the end of the line (2, points)
    """
    step = end - q
    falls = float(np.sum(slope * step))
    curvature = float(np.sum(step.ravel() * (K @ step.ravel())))
    if falls >= 0 or curvature <= 0:
        return q, 0.0
    part = min(1.0, -falls / curvature)
    return q + part * step, -part * (falls + 0.5 * part * curvature)


def _newton_point(
    problem: ShearProblem, c: Field, z: Field, length: Vector, in_slip: Mask, d: Vector
) -> Field:
    """Compute the shear that solves the tangential problem while stick and slip zones are fixed.

    The result (2, points) is the end of one Newton step. Unknowns are both components at sticking
    points. At slipping points the component along the direction n = z/|z| is equal to the friction
    limit, and the component perpendicular to n is unknown. A change of the direction of a slipping
    vector adds the stiffness (|z| − bound) d / bound.

    problem  compliance, friction limit and prescribed load of the tangential problem
    c        linear term of the energy ½ qᵀKq − cᵀq (2, points)
    z        shear minus gradient/d, plus the multiplier term of a prescribed load (2, points)
    length   |z| (points,)
    in_slip  True for slipping points (points,)
    d        weights of the norm Σ d |q|² (points,)
    """
    K, bound = problem.compliance, problem.bound
    points = len(bound)
    stick, slip = np.flatnonzero(~in_slip), np.flatnonzero(in_slip)
    sticking = np.concatenate([stick, points + stick])
    n = z[:, slip] / length[slip]
    fixed = np.zeros_like(z)
    fixed[:, slip] = bound[slip] * n
    turning = (length[slip] - bound[slip]) * d[slip] / bound[slip]

    def restrict_rows(rows: Matrix) -> Matrix:
        """Restrict the rows of a matrix to the unknowns of a Newton step of the tangential problem.

        The unknowns are both shear components at sticking points, then the component perpendicular
        to the shear direction at slipping points.

        rows  matrix with a row for each component of each point (2 points, k)
        """
        across = rows[points + slip]
        across *= n[0][:, None]
        across -= rows[slip] * n[1][:, None]
        return np.concatenate([rows[sticking], across])

    system = restrict_rows(np.ascontiguousarray(restrict_rows(K).T))
    system[np.diag_indices_from(system)] += np.concatenate([np.zeros(len(sticking)), turning])
    factor = cho_factor(system, lower=True, overwrite_a=True, check_finite=False)
    sources = np.stack([c.ravel() - K @ fixed.ravel(), problem.along.ravel()], axis=1)
    sources = restrict_rows(sources)
    x, by_shift = cho_solve(factor, sources, check_finite=False).T
    if problem.control.load is not None:
        carried = np.sum(problem.along * fixed) + np.sum(sources[:, 1] * x)
        x = x + (problem.control.load - carried) / np.sum(sources[:, 1] * by_shift) * by_shift
    q = fixed
    q[:, stick] = x[: len(sticking)].reshape(2, -1)
    q[:, slip] += np.stack([-n[1], n[0]]) * x[len(sticking) :]
    return q
