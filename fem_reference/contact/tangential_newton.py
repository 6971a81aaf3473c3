"""Shear at given pressure: sticking or slipping points by projected Newton steps.

With the bound µp given, the shear minimises ½ qᵀKq − cᵀq over all vectors within their discs whose
resultant is T: a convex problem, whose multiplier is the shift ω of the indenter.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from contact_scene.array_types import Field, Mask, Matrix, Vector
from contact_scene.solver_errors import NotConverged
from fem_reference.contact.admissible_shear import project
from fem_reference.loads import TangentialTarget

MAX_STEPS = 100
# Below, the energy along a step is round-off, and a Newton step is taken without line search.
ENERGY_ROUND_OFF = 1e-5
# Least fraction of the limit at which the shear is a scale of its own error.
LEAST_SHEAR = 1e-6
GRADIENT_STEPS = 2


@dataclass(frozen=True)
class ShearProblem:
    """One tangential problem on contact points.

    compliance  K (2 points, 2 points), components outermost: w u_t = K q
    target      c = w (u_t − ω of the state before, less u_t by the new pressure) (2, points)
    areas       w (points,)
    along       T = Σ along · q, and along ω is w times the displacement of a shift (2, points)
    bound       µp > 0 (points,)
    """

    compliance: Matrix
    target: Field
    areas: Vector
    along: Field
    bound: Vector
    control: TangentialTarget

    def stiffness(self) -> Vector:
        """Compute d (points,), the metric in which discs remain discs."""
        diagonal = np.diagonal(self.compliance).reshape(2, -1)
        return np.asarray(0.5 * (diagonal[0] + diagonal[1]))

    def forced(self) -> Field:
        """c with the shift in it, where that is prescribed."""
        motion = self.control.motion
        return self.target if motion is None else self.target + motion * self.along


@dataclass(frozen=True)
class TangentialState:
    """Shear (2, points), shift, slipping points, residual and number of linear solves.

    shift  None where it is not defined
    """

    shear: Field
    shift: float | None
    in_slip: Mask
    residual: float
    solves: int


def solve_shear(problem: ShearProblem, start: Field, tolerance: float) -> TangentialState:
    """The shear and the shift, or the resultant's part of them that is prescribed.

    tolerance  of Σ w|q − P(q − ∇/d)| / Σ w|q|
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
    """Integrate the length of vectors over the contact."""
    return float(np.sum(areas * np.sqrt(vectors[0] ** 2 + vectors[1] ** 2)))


def _lowest(K: Matrix, slope: Field, q: Field, end: Field) -> tuple[Field, float]:
    """Return the point of least energy between q and `end`, and the decrease of the energy."""
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
    """Compute the Newton point: equilibrium at fixed sets of sticking and slipping points.

    Unknown are both components where it sticks, and where it slips the component across n = z/|z|;
    along n the shear is the bound. Turning a vector of the length of the bound away from its slip
    costs (|z| − bound) d / bound.
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
