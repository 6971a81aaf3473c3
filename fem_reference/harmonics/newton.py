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
from fem_reference.harmonics.alternation import (
    AT_LIMIT,
    CoupledProblem,
    CoupledSolution,
    approach_of,
    press,
    sides_of,
)

Field = NDArray[np.float64]
Vector = NDArray[np.float64]
Matrix = NDArray[np.float64]

MOST_STEPS = 200
MOST_HALVINGS = 7
REMEMBERED = 4  # misses; a step that gets below the largest of them is not shortened
SUFFICIENT = 1e-3


@dataclass(frozen=True)
class _Iterate:
    """Tractions (3 points,), r, θ, z outermost, shift and approach."""

    tractions: Vector
    shift: float
    approach: float


def solve_by_newton(
    problem: CoupledProblem, pressure: Vector, shear: Field, motion: tuple[float, float],
    tolerance: float,
) -> CoupledSolution:  # fmt: skip
    """Pressure and shear that meet all laws at once.

    motion     shift and approach to start from
    tolerance  of Σ w |p − ⟨z_z⟩| / Σ w p + Σ w |q − P(z_t)| / Σ w µp, with what the forces lack
    raises     NotConverged
    """
    misses: list[float] = []
    try:
        at, solves = _start(problem, pressure, shear, motion)
        system = _System(problem)
        for step in range(MOST_STEPS):
            missed, jacobian, in_slip = system.linearised(at)
            misses.append(system.size(missed, at))
            if misses[-1] <= tolerance:
                return system.solution(at, in_slip, solves + step)
            change: Vector = np.asarray(np.linalg.solve(jacobian, -missed))
            if not np.isfinite(change).all():
                break
            after = system.nearer(at, change, (1 - SUFFICIENT) * max(misses[-REMEMBERED:]))
            if after is None:
                break
            at = after
    except np.linalg.LinAlgError:
        pass
    raise NotConverged("the coupled increment", len(misses), min(misses, default=np.inf), tolerance)


def _start(
    problem: CoupledProblem, pressure: Vector, shear: Field, motion: tuple[float, float]
) -> tuple[_Iterate, int]:
    """An iterate with pressure, and the linear solves for it.

    Where there is none yet it is that of frictionless contact: between bodies apart no force
    depends on any motion, and no Newton step is defined.
    """
    (shift, approach), solves = motion, 0
    if not np.any(pressure > 0):
        pressed = press(problem, np.zeros_like(shear), sides_of(pressure))
        pressure, approach, solves = pressed.values, approach_of(problem, pressed), pressed.steps
    shifted, pressed_by = problem.tangential.shift, problem.normal.approach
    return _Iterate(
        np.concatenate([shear.ravel(), pressure]),
        shift if shifted is None else shifted,
        approach if pressed_by is None else pressed_by,
    ), solves


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

    def nearer(self, at: _Iterate, change: Vector, bound: float) -> _Iterate | None:
        """The first of ever shorter steps that misses by less than the bound; if none does, the one
        that misses least: at a kink all may lead uphill. None where that is no number."""
        nearest, least = None, np.inf
        for halvings in range(MOST_HALVINGS + 1):
            trial = self.moved(at, np.asarray(0.5**halvings * change))
            with np.errstate(over="ignore", invalid="ignore"):
                miss = self.size(self.missed(trial), trial)
            if miss < least:
                nearest, least = trial, miss
            if miss < bound:
                break
        return nearest

    def size(self, missed: Vector, at: _Iterate) -> float:
        """Of what is left: parts of the load and of what friction carries, added up; infinite where
        no load is prescribed and none is carried."""
        n, friction = self.n, self.problem.friction_coefficient
        load = self.pressed or float(np.sum(self.w * np.abs(at.tractions[2 * n :])))
        if not load > 0:
            return np.inf
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

    def solution(self, at: _Iterate, in_slip: NDArray[np.bool_], solves: int) -> CoupledSolution:
        """What the laws make of an iterate, so that they hold exactly."""
        _, z_t, z_z, bound = self._equations(at)
        p = np.maximum(z_z, 0.0)
        length = np.hypot(*z_t)
        safe = np.where(length > 0, length, 1.0)
        q = z_t * np.where(length > bound, bound / safe, 1.0)
        return CoupledSolution(p, q, at.approach, at.shift, in_slip, 0, solves)

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
