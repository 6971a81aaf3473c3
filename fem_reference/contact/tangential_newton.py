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
    """Tangential problem on the contact points at a given pressure.

    compliance  K (2 points, 2 points), components outermost, with w u_t = K q
    target      c = w (u_t − ω of the previous state − u_t by the new pressure) (2, points): the
                area-weighted displacement by shear under full stick and zero shift
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

    def stiffness(self) -> Vector:
        """Compute the weights d of the metric Σ d |q|², in which discs remain discs (points,).

        d is the mean of the two diagonal entries of the compliance matrix at a point.
        """
        diagonal = np.diagonal(self.compliance).reshape(2, -1)
        return np.asarray(0.5 * (diagonal[0] + diagonal[1]))

    def forced(self) -> Field:
        """Return the linear term c of the energy of the shear, including a prescribed shift.

        The shape is (2, points). Without a prescribed shift, c is the target of the problem.
        """
        motion = self.control.motion
        return self.target if motion is None else self.target + motion * self.along


@dataclass(frozen=True)
class TangentialState:
    """Solution of the tangential problem at a given pressure.

    shear     shear at the points (2, points) [force/length^2]
    shift     shift [length] or twist [radian]; None at the friction limit, where it is undefined
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
    """Solve the tangential problem: the shear, and the shift if the load is prescribed.

    start      initial guess of the shear (2, points)
    tolerance  limit of Σ w|q − P(q − ∇/d)| / Σ w|q| [1], with the gradient ∇ of the energy and the
               projection P onto the admissible shears
    raises     NotConverged
    """
    K, c, d = problem.compliance, problem.forced(), problem.stiffness()
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
        scale = max(_sum(problem.areas, nearest), least)
        residual = _sum(problem.areas, moved) / scale
        in_slip = length > bound
        if residual <= tolerance:
            shift = omega if problem.control.motion is None else problem.control.motion
            return TangentialState(q, shift, in_slip, residual, solves)
        aimed = _newton_point(problem, c, z, length, in_slip, d)
        aimed, _ = project(aimed, bound, d, along, total)
        solves += 1
        if residual < ENERGY_ROUND_OFF:
            q = aimed
            continue
        q, gained = _lowest(K, slope, q, aimed)
        if gained > -1e-4 * np.sum(slope * moved):
            continue
        for _ in range(GRADIENT_STEPS):
            slope = (K @ q.ravel()).reshape(q.shape) - c
            nearest, _ = project(q - slope / d, bound, d, along, total)
            q, _ = _lowest(K, slope, q, nearest)
    raise NotConverged("the shear", solves, residual, tolerance)


def _sum(areas: Vector, vectors: Field) -> float:
    """Compute the integral of the length of vectors over the contact area.

    areas    areas that the points represent (points,) [length^2]
    vectors  shear vectors at the points (2, points)
    """
    return float(np.sum(areas * np.sqrt(vectors[0] ** 2 + vectors[1] ** 2)))


def _lowest(K: Matrix, slope: Field, q: Field, end: Field) -> tuple[Field, float]:
    """Return the shear of least energy on the line from q to `end`, and the decrease of the energy.

    The energy is that of the tangential problem, ½ qᵀKq − cᵀq.

    K       compliance matrix (2 points, 2 points)
    slope   gradient of the energy at q (2, points)
    q, end  shear fields at the ends of the line (2, points)
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
    """Compute the shear that Newton's method predicts for fixed stick and slip zones.

    Unknowns are both components at sticking points, and at slipping points the component
    perpendicular to n = z/|z|. The component along n is equal to the friction limit. A change of
    the direction of a slipping vector adds the stiffness (|z| − bound) d / bound.

    c        linear term of the energy (2, points)
    z        shear minus gradient/d, plus the multiplier term of a prescribed load (2, points)
    length   |z| (points,)
    in_slip  True for slipping points (points,)
    d        weights of the metric (points,)
    """
    K, bound = problem.compliance, problem.bound
    points = len(bound)
    stick, slip = np.flatnonzero(~in_slip), np.flatnonzero(in_slip)
    sticking = np.concatenate([stick, points + stick])
    n = z[:, slip] / length[slip]
    fixed = np.zeros_like(z)
    fixed[:, slip] = bound[slip] * n
    turning = (length[slip] - bound[slip]) * d[slip] / bound[slip]

    def on_unknowns(rows: Matrix) -> Matrix:
        """Restrict rows (2 points, k) of a matrix to the unknowns of the Newton step.

        These are both components at sticking points, then the perpendicular one at slipping points.
        """
        across = rows[points + slip]
        across *= n[0][:, None]
        across -= rows[slip] * n[1][:, None]
        return np.concatenate([rows[sticking], across])

    system = on_unknowns(np.ascontiguousarray(on_unknowns(K).T))
    system[np.diag_indices_from(system)] += np.concatenate([np.zeros(len(sticking)), turning])
    factor = cho_factor(system, lower=True, overwrite_a=True, check_finite=False)
    sources = np.stack([c.ravel() - K @ fixed.ravel(), problem.along.ravel()], axis=1)
    sources = on_unknowns(sources)
    x, by_shift = cho_solve(factor, sources, check_finite=False).T
    if problem.control.load is not None:
        carried = np.sum(problem.along * fixed) + np.sum(sources[:, 1] * x)
        x = x + (problem.control.load - carried) / np.sum(sources[:, 1] * by_shift) * by_shift
    q = fixed
    q[:, stick] = x[: len(sticking)].reshape(2, -1)
    q[:, slip] += np.stack([-n[1], n[0]]) * x[len(sticking) :]
    return q
