"""Natural map of the contact and friction laws at points, and its generalised derivative.

The laws are equivalent to the nonsmooth equations

    p = ⟨z_z⟩,  z_z = p − (w g)/d_z        q = P(z_t),  z_t = q + (w s)/d_t,

with the pressure p, the gap g, the shear q, the slip s of the indenter relative to the body, and
the point areas w. ⟨⟩ is the positive part, P the projection onto the disc of radius µ⟨z_z⟩, and d
the diagonal of the compliance matrix (Alart and Curnier 1991, Comput. Methods Appl. Mech. Eng. 92,
353). Springs between the surfaces are optional. Their compliance is equal in both directions. They
increase the approach and reduce the slip.
"""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask, Matrix, Vector
from fem_reference.contact.admissible_shear import into_discs
from fem_reference.contact.alternating_iteration import CoupledProblem, CoupledSolution

LEAST_FRICTION = 1e-6  # least friction coefficient by which the residual of shear is divided


@dataclass(frozen=True)
class Iterate:
    """Unknowns of the contact equations of an increment, at one iteration of Newton's method.

    The unknowns are the tractions, the rigid motion of the indenter, and the compliance of
    additional springs between the surfaces, which serve the continuation.

    tractions  components r, θ, z of the tractions at the points, r outermost (3 points,)
    shift      tangential shift or twist of the indenter
    approach   rigid approach [length]
    springs    compliance of the springs [length^3/force]
    """

    tractions: Vector
    shift: float
    approach: float
    springs: float = 0.0

    @property
    def values(self) -> Vector:
        """All unknowns of the contact equations of an increment in one vector (3 points + 3,).

        The order is tractions, shift or twist, approach, spring compliance. Newton's method works
        on this vector.
        """
        return np.append(self.tractions, [self.shift, self.approach, self.springs])

    @classmethod
    def of(cls, values: Vector) -> "Iterate":
        """Create an iterate of the contact equations of an increment from its vector of unknowns.

        Newton's method works on such vectors.

        values  tractions r, θ, z (3 points), then shift or twist, approach and spring compliance (3
                points + 3,)
        """
        shift, approach, springs = (float(value) for value in values[-3:])
        return cls(values[:-3], shift, approach, springs)


class Equations:
    """Contact equations of an increment: the laws at all points, then the prescribed loads.

    Newton's method and the continuation solve these equations. The contact and friction laws are
    written as equations between each traction and its projection onto the admissible tractions
    (natural map). The unknowns are tractions, rigid motion and the compliance of springs between
    the surfaces.

    problem  compliance, gap, friction and prescribed loads of the increment
    """

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

    def residual_vector(self, at: Iterate) -> Vector:
        """Compute the residual vector of the contact equations of an increment (3 points + 2,).

        The first entries are the residuals of shear (r, then θ) and pressure at the points. The
        last two entries belong to the prescribed tangential and normal load.

        at  iterate: tractions, rigid motion and spring compliance
        """
        return self._evaluate_equations(at)[0]

    def linearise(self, at: Iterate) -> tuple[Vector, Matrix, Mask]:
        """Compute the residual vector of the contact equations and its generalised derivative.

        Return also the mask of the slipping points (points,). The residual has the shape (3 points
        + 2,). The derivative (3 points + 2, 3 points + 3) is with respect to the unknowns of an
        iterate. At a kink of the equations, the derivative is that of the side on which the iterate
        is.

        at  iterate: tractions, rigid motion and spring compliance
        """
        n, K, w = self.n, self.K, self.w
        missed, z_t, z_z, bound = self._evaluate_equations(at)
        d_t, d_z = self.d_t + at.springs * w, self.d_z + at.springs * w
        length = np.hypot(*z_t)
        in_slip = length > bound
        safe = np.where(length > 0, length, 1.0)
        normal = np.where(in_slip, z_t / safe, 0.0)
        factor = np.where(in_slip, bound / safe, 1.0)
        # Outside of the contact the equations are p = 0 and q = 0. Their derivative is the
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

    def residual_norm(self, missed: Vector, at: Iterate) -> float:
        """Compute the norm of a residual vector of the contact equations of an increment [1].

        The norm is the sum of the pressure residuals relative to the normal load and of the shear
        residuals relative to the friction limit. The norm is infinite without a prescribed normal
        force and without pressure. Newton's method has converged if the norm is at most its
        tolerance.

        missed  residual vector (3 points + 2,)
        at      iterate at which the residual was computed
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
        """Convert a converged Newton iterate to tractions that obey the contact laws exactly.

        Negative pressures are set to zero. Each shear vector is limited to the friction limit. The
        iterate must not contain springs between the surfaces.

        at       converged iterate: tractions and rigid motion
        in_slip  True for slipping points (points,)
        solves   number of linear systems solved
        """
        _, z_t, z_z, bound = self._evaluate_equations(at)
        q = np.clip(into_discs(z_t, bound), -bound, bound)  # also against round-off
        return CoupledSolution(np.maximum(z_z, 0.0), q, at.approach, at.shift, in_slip, 0, solves)

    def _evaluate_equations(self, at: Iterate) -> tuple[Vector, Field, Vector, Vector]:
        """Compute the residual vector of the contact equations and its intermediate fields.

        The equations are p = ⟨z_z⟩ with z_z = p − w g/d_z, and q = P(z_t) with z_t = q + w s/d_t.
        Here p is the pressure, g the gap, q the shear, s the slip, w the area of a point and d its
        diagonal compliance. ⟨⟩ is the positive part, and P limits z_t to the friction limit µ⟨z_z⟩.
        Return the residual (3 points + 2,), z_t (2, points), z_z (points,) and the friction limit
        (points,).

        at  iterate: tractions, rigid motion and spring compliance
        """
        problem, n = self.problem, self.n
        q, p = at.tractions[: 2 * n].reshape(2, n), at.tractions[2 * n :]
        sprung = at.springs * self.w
        u = (self.K @ at.tractions).reshape(3, n) + sprung * at.tractions.reshape(3, n)
        z_z = p - (u[2] + self.w * (problem.gap - at.approach)) / (self.d_z + sprung)
        slipped = u[:2] - self.w * problem.target - at.shift * self.along
        z_t = q - slipped / (self.d_t + sprung)
        bound = problem.bound(np.maximum(z_z, 0.0))
        allowed = into_discs(z_t, bound)
        force = pressed = 0.0
        if self.force is not None:
            force = (float(np.sum(self.along * q)) - self.force) / self.scale
        if self.pressed is not None:
            pressed = (float(np.sum(self.w * p)) - self.pressed) / self.scale
        missed = np.concatenate([(q - allowed).ravel(), p - np.maximum(z_z, 0.0), [force, pressed]])
        return missed, z_t, z_z, bound
