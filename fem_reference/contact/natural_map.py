"""Natural map of contact and friction on points, and its generalised derivative.

    p = ⟨z_z⟩,  z_z = p − (w g)/d_z        q = P(z_t),  z_t = q + (w s)/d_t,

with P the projection onto the disc of radius µ⟨z_z⟩ and s the slip of the indenter relative to the
body (Alart and Curnier 1991, Comput. Methods Appl. Mech. Eng. 92, 353). Springs between the
surfaces, equally soft in both directions, may increase the approach and reduce the slip.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Matrix, Vector
from fem_reference.contact.alternating_iteration import CoupledProblem, CoupledSolution

LEAST_FRICTION = 1e-6  # least divisor of the error of shear, over the pressure


@dataclass(frozen=True)
class Iterate:
    """Tractions (3 points,), r, θ, z outermost, shift, approach, and the compliance of springs
    between the surfaces [length^3/force]."""

    tractions: Vector
    shift: float
    approach: float
    springs: float = 0.0

    @property
    def values(self) -> Vector:
        """All of them (3 points + 3,)."""
        return np.append(self.tractions, [self.shift, self.approach, self.springs])

    @classmethod
    def of(cls, values: Vector) -> "Iterate":
        """Create the iterate with these values."""
        shift, approach, springs = (float(value) for value in values[-3:])
        return cls(values[:-3], shift, approach, springs)


class Equations:
    """The equations of an increment; those of the loads come last."""

    def __init__(self, problem: CoupledProblem) -> None:
        compliance = problem.compliance
        self.problem = problem
        self.w, self.K = compliance.areas, compliance.matrix
        self.n = len(self.w)
        diagonal = np.diagonal(self.K).reshape(3, -1)
        self.d_t, self.d_z = 0.5 * (diagonal[0] + diagonal[1]), diagonal[2]
        self.along = compliance.along
        self.force, self.pressed = problem.tangential.load, problem.normal.force
        self.scale = float(np.mean(self.w))

    def missed(self, at: Iterate) -> Vector:
        """Compute the residual of the equations (3 points + 2,)."""
        return self._equations(at)[0]

    def linearised(self, at: Iterate) -> tuple[Vector, Matrix, Mask]:
        """Compute the residual, its generalised derivative, and the mask of slipping points.

        The derivative is with respect to the values of an iterate (3 points + 2, 3 points + 3). At
        a kink it is that of the side of the iterate.
        """
        n, K, w = self.n, self.K, self.w
        missed, z_t, z_z, bound = self._equations(at)
        d_t, d_z = self.d_t + at.springs * w, self.d_z + at.springs * w
        length = np.hypot(*z_t)
        in_slip = length > bound
        safe = np.where(length > 0, length, 1.0)
        normal = np.where(in_slip, z_t / safe, 0.0)
        factor = np.where(in_slip, bound / safe, 1.0)
        # Outside of contact p and q are zero: their rows of the derivative are those of the
        # identity.
        on = np.flatnonzero(z_z > 0)
        points, count = np.arange(len(on)), 3 * n + 3
        w, d_t, d_z = w[on], d_t[on], d_z[on]
        by_z = np.zeros((len(on), count))
        by_z[:, : 3 * n] = -K[2 * n + on] / d_z[:, None]
        by_z[points, 2 * n + on] += 1 - at.springs * w / d_z
        by_z[:, -2] = w / d_z
        by_z[:, -1] = -z_z[on] * w / d_z
        by_t = np.zeros((2, len(on), count))
        for c in range(2):
            by_t[c, :, : 3 * n] = -K[c * n + on] / d_t[:, None]
            by_t[c, points, c * n + on] += 1 - at.springs * w / d_t
            by_t[c, :, -3] = self.along[c, on] / d_t
            by_t[c, :, -1] = -z_t[c, on] * w / d_t
        slope = self.problem.friction.slope(z_z[on])
        carrying = np.where(self.problem.compliance.carries_shear[on], slope, 0.0)
        normal, factor = normal[:, on], factor[on]
        turned = normal[0, :, None] * by_t[0] + normal[1, :, None] * by_t[1]
        turned = carrying[:, None] * by_z - factor[:, None] * turned
        jacobian = np.zeros((3 * n + 2, count))
        for c in range(2):
            jacobian[c * n + on] = -factor[:, None] * by_t[c] - normal[c, :, None] * turned
        jacobian[2 * n + on] = -by_z
        jacobian[np.arange(3 * n), np.arange(3 * n)] += 1
        if self.force is None:
            jacobian[-2, -3] = 1.0
        else:
            jacobian[-2, : 2 * n] = self.along.ravel() / self.scale
        if self.pressed is None:
            jacobian[-1, -2] = 1.0
        else:
            jacobian[-1, 2 * n : 3 * n] = self.w / self.scale
        return missed, jacobian, in_slip & (bound > 0)

    def size(self, missed: Vector, at: Iterate) -> float:
        """Compute the norm of a residual [1].

        It is the sum of its parts relative to the normal load and to the friction limit. It is
        infinite without a prescribed load and without tractions.
        """
        n, p = self.n, at.tractions[2 * self.n :]
        load = self.pressed or float(np.sum(self.w * np.abs(p)))
        if not load > 0:
            return np.inf
        by_shear = np.sum(self.w * np.hypot(*missed[: 2 * n].reshape(2, n)))
        by_shear += self.scale * abs(missed[-2]) if self.force is not None else 0.0
        by_pressure = np.sum(self.w * np.abs(missed[2 * n : 3 * n]))
        by_pressure += self.scale * abs(missed[-1]) if self.pressed is not None else 0.0
        return (
            float(by_pressure + by_shear / max(self.problem.mean_friction(p), LEAST_FRICTION))
            / load
        )

    def solution(self, at: Iterate, in_slip: Mask, solves: int) -> CoupledSolution:
        """Project an iterate without springs, so that the laws hold exactly."""
        _, z_t, z_z, bound = self._equations(at)
        p = np.maximum(z_z, 0.0)
        length = np.hypot(*z_t)
        safe = np.where(length > 0, length, 1.0)
        q = np.clip(z_t * np.where(length > bound, bound / safe, 1.0), -bound, bound)
        return CoupledSolution(p, q, at.approach, at.shift, in_slip, 0, solves)

    def _equations(self, at: Iterate) -> tuple[Vector, Field, Vector, Vector]:
        """Compute the residual, z_t (2, points), z_z and µ⟨z_z⟩ (points,)."""
        problem, n = self.problem, self.n
        q, p = at.tractions[: 2 * n].reshape(2, n), at.tractions[2 * n :]
        sprung = at.springs * self.w
        u = (self.K @ at.tractions).reshape(3, n) + sprung * at.tractions.reshape(3, n)
        z_z = p - (u[2] + self.w * (problem.gap - at.approach)) / (self.d_z + sprung)
        slipped = u[:2] - self.w * problem.target - at.shift * self.along
        z_t = q - slipped / (self.d_t + sprung)
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
