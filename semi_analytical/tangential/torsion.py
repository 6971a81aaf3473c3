"""Torsion of the indenter under a prescribed torque. Not imported without torsion.

A prescribed twist only adds to the displacement that stick requires. A prescribed torque Σ(q_y x -
q_x y) Δ is a constraint as the tangential force is: the twist is its multiplier, as the shift is
that of Σq. The loads (T, M) that friction can carry form a convex set. A load reaches its boundary
when all cells slip about one pole, which minimises the power of friction (upper-bound theorem of
limit analysis).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from semi_analytical.multipliers import find_multiplier
from semi_analytical.tangential.admissible_shear import (
    AT_LIMIT,
    ProjectedShear,
    everywhere,
    magnitude,
)

MAX_STEPS = 100
# Smoothing of |speed| at the pole, relative to the largest speed.
BLUNT = 1e-8
# Relative decrease of the power of friction at which the iteration stops.
FLAT = 1e-15


@dataclass(frozen=True)
class ShearMoments:
    """Prescribed torque Σ(q_y x - q_x y), with prescribed Σq or prescribed shift.

    rotation  (-y, x) of the cells (2, nx, ny) [length]
    torque    Σ(q_y x - q_x y) = M_z / cell area
    total     Σq = T / cell area, shape (2,); None where the shift is prescribed
    shift     of the indenter (2,); None where Σq is prescribed
    The motion is (shift x, shift y, twist).
    """

    rotation: VectorField
    torque: float
    total: Vector | None = None
    shift: Vector | None = None

    @cached_property
    def reach(self) -> float:
        """Largest arm, the unit in which a twist is comparable with a shift [length]."""
        return float(np.max(magnitude(self.rotation)))

    @cached_property
    def units(self) -> tuple[VectorField, ...]:
        """Unit motions of prescribed force: along x and y if Σq is prescribed, and the rotation."""
        turn = self.rotation / self.reach
        if self.total is None:
            return (turn,)
        return (*(np.broadcast_to(everywhere(e), turn.shape) for e in np.eye(2)), turn)

    @cached_property
    def given(self) -> Vector:
        """Prescribed forces on the unit motions."""
        torque = self.torque / self.reach
        return np.array([torque] if self.total is None else [*self.total, torque])

    def forces(self, q: VectorField) -> Vector:
        """Compute the forces of a shear on the unit motions."""
        return np.array([np.sum(q * unit) for unit in self.units])

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Return the unit motions."""
        return self.units

    def rigid(self, motion: Vector) -> VectorField:
        """Compute the displacement by shift and rotation."""
        return everywhere(motion[:2]) + motion[2] * self.rotation

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Project with the prescribed forces; their multipliers are γ times the motion."""
        if self.shift is not None:
            y = y + everywhere(gamma * self.shift)
            guess = gamma * self.reach * motion[2:]
        else:
            guess = gamma * np.array([*motion[:2], self.reach * motion[2]])
        q, multiplier = self._projected(y, bound, guess)
        shift = self.shift if self.shift is not None else multiplier[:2] / gamma
        return q, np.array([*shift, multiplier[-1] / (gamma * self.reach)])

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Project on the discs and the prescribed forces."""
        return self._projected(q, bound, np.zeros(len(self.given)))[0]

    def _projected(self, y: VectorField, bound: Field, guess: Vector) -> tuple[VectorField, Vector]:
        loaded, units = self._loaded(bound)
        of_loaded, limit = y[:, loaded], bound[loaded]

        shifted, multiplier = find_multiplier(
            lambda m: _ShiftedMoments(m, of_loaded, limit, units, self.given), guess
        )
        q = np.zeros_like(y)
        q[:, loaded] = shifted.q
        return q, multiplier

    def _loaded(self, bound: Field) -> tuple[Mask, Field]:
        """Select the cells that carry shear, and their unit motions (k, 2, n)."""
        loaded = bound > 0
        return loaded, np.stack([unit[:, loaded] for unit in self.units])

    def exhausts(self, bound: Field) -> bool:
        """Return whether the load is at or above the friction limit."""
        if not np.any(bound):
            return True
        return bool(np.any(self.given)) and self.limit(bound)[0] <= 1 + AT_LIMIT

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return the shear in gross slip about the pole of the friction limit."""
        if not np.any(bound) or not np.any(self.given):
            return np.zeros((2, *bound.shape)), motion
        loaded, units = self._loaded(bound)
        speed = np.tensordot(self.limit(bound)[1], units, 1)
        q = np.zeros((2, *bound.shape))
        q[:, loaded] = bound[loaded] * speed / _blunt_size(speed)
        return q, motion

    def limit(self, bound: Field) -> tuple[float, Vector]:
        """Compute the load factor at the friction limit, and the direction of sliding (k,).

        Newton's method minimises the power of friction over all rigid motions on which the load
        does unit work. The load factor is the minimum.
        """
        loaded, units = self._loaded(bound)
        limit = bound[loaded]
        start = self.given / np.sum(self.given**2)
        across = np.linalg.svd(self.given[None, :])[2][1:]
        if len(across) == 0:
            return float(limit @ magnitude(np.tensordot(start, units, 1))), start

        def power_at(x: Vector) -> tuple[float, Vector, Field]:
            return _power(start + x @ across, limit, units)

        x = np.zeros(len(across))
        power, slope, curvature = power_at(x)
        for _ in range(MAX_STEPS):
            gradient = across @ slope
            inverse = np.linalg.pinv(across @ curvature @ across.T, rcond=1e-14, hermitian=True)
            step = -inverse @ gradient
            fall = -float(gradient @ step)
            if fall <= FLAT * power:
                break
            x, (power, slope, curvature) = _descended(power_at, x, step, power, fall)
        return power, start + x @ across


def _power(velocity: Vector, limit: Vector, units: Field) -> tuple[float, Vector, Field]:
    """Compute the power of friction in gross slip, with its gradient and Hessian.

    velocity  components along the unit motions (k,)
    limit     friction limit of the loaded cells (n,)
    units     their unit motions (k, 2, n)
    """
    speed = np.tensordot(velocity, units, 1)
    size = _blunt_size(speed)
    weight = limit / size
    along = _along(units, speed) / size
    curvature = _products(units, weight) - (along * weight) @ along.T
    return float(limit @ size), _forces(units, weight * speed), curvature


def _forces(units: Field, q: Field) -> Vector:
    """Compute the forces (k,) of a shear (2, n) on the unit motions."""
    return np.asarray(units.reshape(len(units), -1) @ q.ravel())


def _along(units: Field, vector: Field) -> Field:
    """Compute the products (k, n) of the unit motions and a vector of each cell (2, n)."""
    return np.asarray(units[:, 0] * vector[0] + units[:, 1] * vector[1])


def _products(units: Field, weight: Vector) -> Field:
    """Compute the weighted sums (k, k) of the products of pairs of unit motions."""
    flat = units.reshape(len(units), -1)
    return np.asarray((units * weight).reshape(flat.shape) @ flat.T)


def _blunt_size(speed: VectorField) -> Field:
    """Compute |speed|, smoothed at the pole, where the slip direction of a cell is undefined."""
    size = magnitude(speed)
    return np.hypot(size, BLUNT * np.max(size))


Power = tuple[float, Vector, Field]


def _descended(
    power_at: Callable[[Vector], Power], x: Vector, step: Vector, power: float, fall: float
) -> tuple[Vector, Power]:
    """Apply a Newton step with bisection until the power decreases sufficiently (Armijo)."""
    part = 1.0
    while True:
        there = power_at(x + part * step)
        if there[0] <= power - 0.1 * part * fall or part < 1e-9:
            return x + part * step, there
        part *= 0.5


class _ShiftedMoments(ProjectedShear):
    """Projection of y + Σ λ unit on the discs of the loaded cells (2, n).

    given  prescribed forces on the unit motions
    """

    def __init__(
        self, multiplier: Vector, y: Field, limit: Vector, units: Field, given: Vector
    ) -> None:
        super().__init__(y + np.tensordot(multiplier, units, 1), limit)
        self._units = units
        self.defect = _forces(units, self.q) - given

    def newton_step(self) -> Vector:
        """Compute the Newton step of λ, damped while all cells slip.

        The damping is relative to the stiffness of the cells. The trace of the derivative is no
        measure: it vanishes where all cells slip along their motion.
        """
        along, products = _along(self._units, self.z), _products(self._units, self.scale)
        matrix = products - (along * self.radial) @ along.T
        stiffness = float(np.trace(products))
        damping = 1e-3 * stiffness * (np.sum(np.abs(self.defect)) / self.capacity) ** 2
        return -np.linalg.solve(matrix + damping * np.eye(len(matrix)), self.defect)
