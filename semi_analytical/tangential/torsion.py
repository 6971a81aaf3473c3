"""Torsion of the indenter, led by its torque. Not imported where nothing twists.

A given twist only changes by what the surfaces have to be moved. A given torque Σ(q_y x - q_x y) Δ
is a force like the tangential force: the twist is its multiplier, as the shift is that of Σq. What
friction carries of both at once is a convex set of (T, M); in its direction a load reaches the
limit where all cells slip about one pole (the minimum over all poles of the power of friction).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from semi_analytical.multipliers import find_multiplier
from semi_analytical.tangential.admissible_shear import (
    AT_LIMIT,
    MULTIPLIER_ROUND_OFF,
    ROUND_OFF,
    everywhere,
    magnitude,
)

MAX_STEPS = 100
# Of the largest speed: rounds off the kink of the power where the pole falls on a cell.
BLUNT = 1e-8
# Relative fall of the power of friction at which its minimum is reached.
FLAT = 1e-15


@dataclass(frozen=True)
class ShearMoments:
    """Force control of the twist: Σ(q_y x - q_x y), and of the shift or not.

    rotation  (-y, x) of the cells (2, nx, ny) [length]
    torque    Σ(q_y x - q_x y) = M_z / cell area
    total     Σq = T / cell area, shape (2,); None where the shift is given
    shift     of the indenter (2,); None where Σq is given
    The motion is (shift x, shift y, twist).
    """

    rotation: VectorField
    torque: float
    total: Vector | None = None
    shift: Vector | None = None

    @cached_property
    def reach(self) -> float:
        """Largest arm: with it as unit a twist compares with a shift [length]."""
        return float(np.max(magnitude(self.rotation)))

    @cached_property
    def units(self) -> tuple[VectorField, ...]:
        """Unit motions of given force: along x and y if Σq is given, and the rotation."""
        turn = self.rotation / self.reach
        if self.total is None:
            return (turn,)
        return (*(np.broadcast_to(everywhere(e), turn.shape) for e in np.eye(2)), turn)

    @cached_property
    def given(self) -> Vector:
        """The forces of the unit motions."""
        torque = self.torque / self.reach
        return np.array([torque] if self.total is None else [*self.total, torque])

    def forces(self, q: VectorField) -> Vector:
        """The forces of a shear on the unit motions."""
        return np.array([np.sum(q * unit) for unit in self.units])

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """The unit motions."""
        return self.units

    def rigid(self, motion: Vector) -> VectorField:
        """Shift and rotation."""
        return everywhere(motion[:2]) + motion[2] * self.rotation

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """By projection; the multipliers are γ times the motion."""
        if self.shift is not None:
            y = y + everywhere(gamma * self.shift)
            guess = gamma * self.reach * motion[2:]
        else:
            guess = gamma * np.array([*motion[:2], self.reach * motion[2]])
        shifted, multiplier = self._projected(y, bound, guess)
        shift = self.shift if self.shift is not None else multiplier[:2] / gamma
        return shifted.q, np.array([*shift, multiplier[-1] / (gamma * self.reach)])

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """On the discs, with the forces."""
        return self._projected(q, bound, np.zeros(len(self.given)))[0].q

    def _projected(self, y: VectorField, bound: Field, guess: Vector) -> tuple["_Shifted", Vector]:
        def shifted_by(multiplier: Vector) -> _Shifted:
            return _Shifted.by(multiplier, y, bound, self)

        return find_multiplier(shifted_by, guess)

    def exhausts(self, bound: Field) -> bool:
        """Whether the load is at the limit of friction or beyond."""
        if not np.any(bound):
            return True
        return bool(np.any(self.given)) and self.limit(bound)[0] <= 1 + AT_LIMIT

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """All cells slip about the pole at which the load reaches the limit."""
        if not np.any(bound) or not np.any(self.given):
            return np.zeros((2, *bound.shape)), motion
        speed = self._speed(self.limit(bound)[1])
        return bound * speed / _blunt_size(speed), motion

    def limit(self, bound: Field) -> tuple[float, Vector]:
        """How many times the load friction can carry, and how the indenter then slides (k,).

        The least power of friction over all rigid motions on which the load does unit work.
        """
        start = self.given / np.sum(self.given**2)
        across = np.linalg.svd(self.given[None, :])[2][1:]
        if len(across) == 0:
            return float(np.sum(bound * magnitude(self._speed(start)))), start

        def power_at(x: Vector) -> tuple[float, Vector, Field]:
            return self._power(start + x @ across, bound)

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

    def _speed(self, velocity: Vector) -> VectorField:
        """Speed of the indenter's particles in a motion by shares of the units (k,)."""
        speed = np.zeros_like(self.rotation)
        for share, unit in zip(velocity, self.units, strict=True):
            speed = speed + share * unit
        return speed

    def _power(self, velocity: Vector, bound: Field) -> tuple[float, Vector, Field]:
        """Power of friction in full slip, with its gradient and its curvature."""
        speed = self._speed(velocity)
        size = _blunt_size(speed)
        q = bound * speed / size
        along = [np.sum(speed * unit, axis=0) / size for unit in self.units]
        curvature = [
            [
                np.sum(bound / size * (np.sum(one * other, axis=0) - a * b))
                for other, b in zip(self.units, along, strict=True)
            ]
            for one, a in zip(self.units, along, strict=True)
        ]
        return float(np.sum(bound * size)), self.forces(q), np.array(curvature)


def _blunt_size(speed: VectorField) -> Field:
    """|speed|, without the kink at the pole: a cell there may slip any way, or not at all."""
    size = magnitude(speed)
    return np.hypot(size, BLUNT * np.max(size))


Power = tuple[float, Vector, Field]


def _descended(
    power_at: Callable[[Vector], Power], x: Vector, step: Vector, power: float, fall: float
) -> tuple[Vector, Power]:
    """Along a Newton step, half as far until the power falls enough."""
    part = 1.0
    while True:
        there = power_at(x + part * step)
        if there[0] <= power - 0.1 * part * fall or part < 1e-9:
            return x + part * step, there
        part *= 0.5


@dataclass(frozen=True)
class _Shifted:
    """y + Σ λ unit cut off at the discs: see multipliers.py and admissible_shear._Shifted."""

    z: VectorField
    length: Field
    outside: Mask
    scale: Field
    q: VectorField
    units: tuple[VectorField, ...]
    defect: Vector
    capacity: float

    @classmethod
    def by(cls, multiplier: Vector, y: VectorField, bound: Field, load: ShearMoments) -> "_Shifted":
        """Shift `y` by multipliers and cut it off."""
        z = y + load._speed(multiplier)
        length = magnitude(z)
        outside = length > bound
        scale = np.where(outside, bound / np.where(outside, length, 1.0), 1.0) * (bound > 0)
        q = z * scale
        defect = load.forces(q) - load.given
        return cls(z, length, outside, scale, q, load.units, defect, float(np.sum(bound)))

    def settled(self, multiplier: Vector) -> bool:
        """Whether the defect is round-off, of the sums or of the multipliers."""
        blur = MULTIPLIER_ROUND_OFF * np.sum(self.scale) * np.sum(np.abs(multiplier))
        strength = np.sum(self.length * self.scale)
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * strength + blur)

    def newton_step(self) -> Vector:
        """Change of λ that removes the defect to first order, damped while all cells slip.

        The damping is relative to the stiffness of the cells, which does not vanish, as the trace
        of the derivative does where all cells slip along their motion.
        """
        w = np.where(self.outside, self.scale / np.where(self.outside, self.length**2, 1.0), 0.0)
        along = [np.sum(self.z * unit, axis=0) for unit in self.units]
        matrix = np.array(
            [
                [
                    np.sum(self.scale * np.sum(one * other, axis=0) - w * a * b)
                    for other, b in zip(self.units, along, strict=True)
                ]
                for one, a in zip(self.units, along, strict=True)
            ]
        )
        stiffness = sum(float(np.sum(self.scale * unit * unit)) for unit in self.units)
        damping = 1e-3 * stiffness * (np.sum(np.abs(self.defect)) / self.capacity) ** 2
        return -np.linalg.solve(matrix + damping * np.eye(len(matrix)), self.defect)
