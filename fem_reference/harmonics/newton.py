"""Pressure and shear together by Newton's method, for where taking turns does not converge.

Below thin incompressible films, and wherever µ|β| is far above one, each turn of pressure and shear
carries the other further away. The laws of contact and friction are equations with kinks,

    p = ⟨z_z⟩,  z_z = p − (w g)/d_z        q = P(z_t),  z_t = q + (w s)/d_t,

with P the projection onto the disc of radius µ⟨z_z⟩ and s how far the indenter has gone past the
body (Alart and Curnier 1991, Comput. Methods Appl. Mech. Eng. 92, 353); their derivatives are taken
on the side of a kink where the iterate is.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene.solver_errors import NotConverged
from fem_reference.harmonics.alternation import AT_LIMIT, CoupledProblem, CoupledSolution

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]

MOST_STEPS = 200
MOST_HALVINGS = 7
REMEMBERED = 4  # misses; a step has to get below the largest of them
SUFFICIENT = 1e-3


@dataclass(frozen=True)
class _Iterate:
    """Tractions (3 points,), r, θ, z outermost, shift and approach, and by how much they miss."""

    tractions: Vector
    shift: float
    approach: float


def solve_by_newton(
    problem: CoupledProblem, pressure: Vector, shear: Field, motion: tuple[float, float],
    tolerance: float,
) -> CoupledSolution:  # fmt: skip
    """Pressure and shear that meet all laws at once.

    motion     shift and approach to start from
    tolerance  of Σ w |p − ⟨z⟩| / Σ w p and of Σ w |q − P(z)| / Σ w µp
    raises     NotConverged
    """
    system = _System(problem)
    shift, approach = motion
    load, press = problem.tangential.shift, problem.normal.approach
    at = _Iterate(
        np.concatenate([shear.ravel(), pressure]),
        shift if load is None else load,
        approach if press is None else press,
    )
    misses: list[float] = []
    for step in range(MOST_STEPS):
        missed, jacobian, in_slip = system.linearised(at)
        miss = system.size(missed, at)
        if miss <= tolerance:
            return system.solution(at, in_slip, step)
        misses.append(miss)
        try:
            change: Vector = np.asarray(np.linalg.solve(jacobian, -missed))
        except np.linalg.LinAlgError:
            break
        if not np.isfinite(change).all():
            break
        length, bound = 1.0, (1 - SUFFICIENT) * max(misses[-REMEMBERED:])
        for _ in range(MOST_HALVINGS):
            trial = system.moved(at, np.asarray(length * change))
            if system.size(system.missed(trial), trial) < bound:
                break
            length *= 0.5
        at = system.moved(at, np.asarray(length * change))
    raise NotConverged("the coupled increment", len(misses), min(misses), tolerance)


class _System:
    """The equations of an increment; unknown motions come after the tractions."""

    def __init__(self, problem: CoupledProblem) -> None:
        compliance = problem.compliance
        self.problem = problem
        self.w, self.K = compliance.areas, compliance.matrix
        self.n = len(self.w)
        diagonal = np.diagonal(self.K).reshape(3, -1)
        self.d_t, self.d_z = 0.5 * (diagonal[0] + diagonal[1]), diagonal[2]
        self.along = compliance.along_x
        self.force, self.pressed = problem.tangential.force, problem.normal.force
        self.scale = float(np.mean(self.w))

    def missed(self, at: _Iterate) -> Vector:
        """What is left of the equations."""
        return self._equations(at)[0]

    def linearised(self, at: _Iterate) -> tuple[Vector, Matrix, NDArray[np.bool_]]:
        """The same with its derivative, and the points that slip."""
        n, K = self.n, self.K
        missed, z_t, z_z, bound = self._equations(at)
        length = np.hypot(*z_t)
        in_slip = length > bound
        safe = np.where(length > 0, length, 1.0)
        normal = np.where(in_slip, z_t / safe, 0.0)
        kept = np.where(in_slip, bound / safe, 1.0)
        count = 3 * n + 2
        by_z = np.zeros((n, count))
        by_z[:, : 3 * n] = -K[2 * n :] / self.d_z[:, None]
        by_z[np.arange(n), 2 * n + np.arange(n)] += 1
        by_z[:, -1] = self.w / self.d_z
        by_z[z_z <= 0] = 0.0
        by_t = np.zeros((2, n, count))
        for c in range(2):
            by_t[c, :, : 3 * n] = -K[c * n : (c + 1) * n] / self.d_t[:, None]
            by_t[c, np.arange(n), c * n + np.arange(n)] += 1
            by_t[c, :, -2] = self.along[c] / self.d_t
        radial = np.einsum("cn,cnk->nk", normal, by_t)
        carrying = np.where(self._carries, self.problem.friction_coefficient, 0.0)
        turned = kept[:, None] * (by_t - normal[:, :, None] * radial)
        turned += normal[:, :, None] * carrying[:, None] * by_z
        jacobian = np.zeros((count, count))
        jacobian[: 2 * n] = -turned.reshape(2 * n, count)
        jacobian[2 * n : 3 * n] = -by_z
        jacobian[np.arange(3 * n), np.arange(3 * n)] += 1
        if self.force is None:
            jacobian[-2, -2] = 1.0
        else:
            jacobian[-2, : 2 * n] = self.along.ravel() / self.scale
        if self.pressed is None:
            jacobian[-1, -1] = 1.0
        else:
            jacobian[-1, 2 * n : 3 * n] = self.w / self.scale
        return missed, jacobian, in_slip & (bound > 0)

    def size(self, missed: Vector, at: _Iterate) -> float:
        """Of what is left, relative to the load and to what friction carries."""
        n, friction = self.n, self.problem.friction_coefficient
        load = self.pressed or float(np.sum(self.w * np.abs(at.tractions[2 * n :])))
        by_shear = np.sum(self.w * np.hypot(*missed[: 2 * n].reshape(2, n)))
        by_shear += self.scale * abs(missed[-2]) if self.force is not None else 0.0
        by_pressure = np.sum(self.w * np.abs(missed[2 * n : 3 * n]))
        by_pressure += self.scale * abs(missed[-1]) if self.pressed is not None else 0.0
        return float(by_pressure + by_shear / max(friction, AT_LIMIT)) / load

    def moved(self, at: _Iterate, change: Vector) -> _Iterate:
        """Another iterate."""
        return replace(
            at,
            tractions=at.tractions + change[: 3 * self.n],
            shift=at.shift + float(change[-2]),
            approach=at.approach + float(change[-1]),
        )

    def solution(self, at: _Iterate, in_slip: NDArray[np.bool_], steps: int) -> CoupledSolution:
        """What the laws make of an iterate, so that they hold exactly."""
        _, z_t, z_z, bound = self._equations(at)
        p = np.maximum(z_z, 0.0)
        length = np.hypot(*z_t)
        safe = np.where(length > 0, length, 1.0)
        q = z_t * np.where(length > bound, bound / safe, 1.0)
        return CoupledSolution(p, q, at.approach, at.shift, in_slip, 1, steps)

    @property
    def _carries(self) -> NDArray[np.bool_]:
        return self.problem.compliance.carries_shear

    def _equations(self, at: _Iterate) -> tuple[Vector, Field, Vector, Vector]:
        """What is missed, z_t (2, points), z_z and µ⟨z_z⟩ (points,)."""
        problem, n = self.problem, self.n
        q, p = at.tractions[: 2 * n].reshape(2, n), at.tractions[2 * n :]
        u = (self.K @ at.tractions).reshape(3, n)
        z_z = p - (u[2] + self.w * (problem.gap - at.approach)) / self.d_z
        z_t = q - (u[:2] - self.w * problem.target - at.shift * self.along) / self.d_t
        bound = problem.bound(np.maximum(z_z, 0.0))
        length = np.hypot(*z_t)
        safe = np.where(length > 0, length, 1.0)
        allowed = z_t * np.where(length > bound, bound / safe, 1.0)
        force = pressed = 0.0
        if self.force is not None:
            force = (float(np.sum(self.along * q)) - self.force) / self.scale
        if self.pressed is not None:
            pressed = (float(np.sum(self.w * p)) - self.pressed) / self.scale
        missed = np.concatenate([(q - allowed).ravel(), p - np.maximum(z_z, 0.0), [force, pressed]])
        return missed, z_t, z_z, bound
