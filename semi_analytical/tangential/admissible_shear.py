"""Shear tractions that friction allows: |q| <= bound in every cell, with a given sum or without.

The exact projection on {discs, and Σq = total} is what makes the shear problem robust: every
iterate carries the load and obeys Coulomb's bound, and the multiplier of the sum is the rigid
shift (see multipliers.py).
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from semi_analytical.multipliers import find_multiplier

# What rounding leaves of a sum of shears, relative to the sum of their magnitudes.
ROUND_OFF = 1e-14
# Relative distance from the friction limit at which force control loses the shift: what would still
# stick, a thousandth of the contact wide (the cube root), is less than a cell.
AT_LIMIT = 1e-9
# What rounding leaves of the multiplier, relative to it; all cells that stick move with it.
MULTIPLIER_ROUND_OFF = 5e-16


class TangentialLoad(Protocol):
    """What leads the indenter in its plane. Its motion is a vector: the shift, and what else it
    can do."""

    def rigid(self, motion: Vector) -> VectorField:
        """Displacement of the indenter's particles, to broadcast with (2, nx, ny) [length]."""

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """The admissible shear nearest to y + γ rigid(motion), and the motion of the load.

        motion  first guess where the load leaves it free
        """

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """The nearest shear that friction allows and that carries the load."""

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Rigid motions whose forces are given, fields of this shape (2, nx, ny)."""

    @property
    def given(self) -> Vector:
        """The given forces, in the order of the free motions [force / cell area]."""

    def forces(self, q: VectorField) -> Vector:
        """Those of a shear."""

    def exhausts(self, bound: Field) -> bool:
        """Whether friction can carry no more than the load, or nothing at all."""

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """The shear and the motion where all cells slip."""


@dataclass(frozen=True)
class ShearSum:
    """Force control: the sum Σq of all cell shears, T / cell area, shape (2,).

    summed  components with a resultant; the others are odd about a mirror plane: with their images
            they have none, and do not move the indenter
    """

    total: Vector
    summed: tuple[bool, bool] = (True, True)

    def rigid(self, motion: Vector) -> VectorField:
        """The shift, everywhere the same."""
        return everywhere(motion)

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """By projection; the multiplier of the sum is γ times the shift."""
        q, multiplier = project(y, bound, self.total, gamma * motion, self.summed)
        return q, multiplier / gamma

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """On the discs, with the sum."""
        return project(q, bound, self.total, summed=self.summed)[0]

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Along x and along y, or one of these."""
        return tuple(np.broadcast_to(everywhere(e), shape) for e in np.eye(2)[list(self.summed)])

    @property
    def given(self) -> Vector:
        """The sum."""
        return self.total[list(self.summed)]

    def forces(self, q: VectorField) -> Vector:
        """The sum of a shear."""
        return np.array([np.sum(one) for one, summed in zip(q, self.summed, strict=True) if summed])

    def exhausts(self, bound: Field) -> bool:
        """Whether the force is at the friction limit or beyond."""
        return float(np.hypot(*self.total)) >= float(np.sum(bound)) * (1 - AT_LIMIT)

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """All cells pull along the force."""
        if not np.any(bound):
            return np.zeros((2, *bound.shape)), motion
        return bound * everywhere(self.total / np.hypot(*self.total)), motion


@dataclass(frozen=True)
class FixedShift:
    """Displacement control: the tangential shift of the indenter, shape (2,) [length]."""

    shift: Vector

    def rigid(self, motion: Vector) -> VectorField:
        """The shift, everywhere the same."""
        return everywhere(motion)

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Cell by cell."""
        return project_on_discs(y + everywhere(gamma * self.shift), bound), self.shift

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """On the discs."""
        return project_on_discs(q, bound)

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """None."""
        return ()

    @property
    def given(self) -> Vector:
        """No force."""
        return np.zeros(0)

    def forces(self, q: VectorField) -> Vector:
        """No force."""
        return np.zeros(0)

    def exhausts(self, bound: Field) -> bool:
        """Only where there is no friction at all."""
        return not np.any(bound)

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Without friction nothing is carried."""
        return np.zeros((2, *bound.shape)), self.shift


@dataclass(frozen=True)
class SprungShift(FixedShift):
    """Displacement control through a spring: the shift of the actuator, shape (2,) [length].

    The spring is part of the compliance. `nearest` returns the shear that carries the force in the
    spring after the step, not before: without that, a soft spring turns every change of the shift
    into slip of all cells. Its motion is that of the contact.

    compliance  displacement by the spring per sum of the shear [length^3/force]
    summed      see `ShearSum`
    """

    compliance: float
    summed: tuple[bool, bool] = (True, True)

    def extension(self, q: VectorField) -> Vector:
        """Extension of the spring under a shear (2,) [length]."""
        return np.asarray(self.compliance * np.sum(q, axis=(1, 2)) * self.summed)

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """P(y + λ) with λ/γ the motion of the contact: Σq + λ/(γc) = δ*/c."""
        c = self.compliance
        total = self.shift * self.summed / c
        stiffness = 1 / (gamma * c)
        q, multiplier = project(y, bound, total, gamma * motion, self.summed, stiffness)
        return q, multiplier / gamma

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """On the discs, with the same sum where friction can carry it: a soft spring would turn a
        change of the sum into a large motion."""
        total = np.sum(q, axis=(1, 2)) * self.summed
        if np.hypot(*total) >= np.sum(bound) * (1 - AT_LIMIT):
            return project_on_discs(q, bound)
        return project(q, bound, total, summed=self.summed)[0]


class NaturalShear(NamedTuple):
    """The natural map at a shear q: z = q + γ (ω + c - u), its projection P(z), the slip ω + c - u,
    the motion ω of the load, and Σ|q - P(z)| over the sum of the bound."""

    z: VectorField
    projected: VectorField
    slipped: VectorField
    motion: Vector
    error: float


def natural_shear(
    load: TangentialLoad,
    q: VectorField,
    apart: VectorField,
    bound: Field,
    gamma: float,
    motion: Vector,
) -> NaturalShear:
    """Evaluate the natural map. With a spring z has the motion of the contact after the step, the
    slip that of the present extension; in a solution they are equal.

    apart   c - u (2, nx, ny) [length]
    motion  first guess
    """
    if isinstance(load, SprungShift):
        extension = load.extension(q)
        y = q + gamma * (apart + everywhere(extension))
        projected, reached = load.nearest(y, bound, gamma, load.shift - extension)
        z, motion = y + gamma * everywhere(reached), load.shift
        slipped = apart + everywhere(motion)
    else:
        projected, motion = load.nearest(q + gamma * apart, bound, gamma, motion)
        slipped = apart + load.rigid(motion)
        z = q + gamma * slipped
    error = float(np.sum(magnitude(projected - q)) / np.sum(bound))
    return NaturalShear(z, projected, slipped, motion, error)


def magnitude(v: VectorField) -> Field:
    """Length of the vectors (2, ...), shape (...)."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1])


def everywhere(v: Vector) -> VectorField:
    """A vector (2,) as a field that broadcasts with (2, nx, ny)."""
    return v[:, None, None]


def project_on_discs(y: VectorField, bound: Field) -> VectorField:
    """The nearest shear with |q| <= bound, cell by cell."""
    length = magnitude(y)
    return np.asarray(y * np.where(length > bound, bound / np.where(length > 0, length, 1.0), 1.0))


def project(
    y: VectorField,
    bound: Field,
    total: Vector,
    guess: Vector | None = None,
    summed: tuple[bool, bool] = (True, True),
    stiffness: float = 0.0,
) -> tuple[VectorField, Vector]:
    """The nearest shear with |q| <= bound and Σq = total, and the multiplier λ of the sum.

    y      any shear (2, nx, ny)
    bound  friction limit µp (nx, ny); |total| must be less than its sum
    guess  where to start the search for λ
    summed  components that have a sum; λ is zero of others
    stiffness  of a spring, over γ: Σq + stiffness λ = total
    """
    if guess is None:
        open_cells = bound > 0
        excess = np.sum(y, axis=(1, 2), where=open_cells) - total
        guess = -excess / np.count_nonzero(open_cells) * summed
    shifted, multiplier = find_multiplier(
        lambda m: _Shifted.by(m, y, bound, total, summed, stiffness), guess
    )
    return shifted.q, multiplier


@dataclass(frozen=True)
class _Shifted:
    """y + λ cut off at the discs.

    z, length  y + λ (2, nx, ny) and its length (nx, ny)
    outside    where that is longer than the bound
    scale, q   factor of the cut (nx, ny), and q = scale z
    defect     Σq + stiffness λ - total (2,), the gradient of the dual function of λ; zero of what
               has no sum
    summed     components that have a sum
    stiffness  see `project`
    capacity   sum of the bound
    """

    z: VectorField
    length: Field
    outside: Mask
    scale: Field
    q: VectorField
    defect: Vector
    summed: tuple[bool, bool]
    stiffness: float
    capacity: float

    @classmethod
    def by(
        cls,
        multiplier: Vector,
        y: VectorField,
        bound: Field,
        total: Vector,
        summed: tuple[bool, bool],
        stiffness: float,
    ) -> "_Shifted":
        """Shift `y` by a multiplier and cut it off."""
        z = y + everywhere(multiplier)
        length = magnitude(z)
        outside = length > bound
        scale = np.where(outside, bound / np.where(outside, length, 1.0), 1.0) * (bound > 0)
        q = z * scale
        defect = (np.sum(q, axis=(1, 2)) + stiffness * multiplier - total) * summed
        return cls(z, length, outside, scale, q, defect, summed, stiffness, float(np.sum(bound)))

    @property
    def strength(self) -> float:
        """Σ|q|."""
        return float(np.sum(self.length * self.scale))

    def settled(self, multiplier: Vector) -> bool:
        """Whether the defect is round-off, of the sum or of the multiplier."""
        answer = np.sum(self.scale) + self.stiffness
        blur = MULTIPLIER_ROUND_OFF * answer * np.sum(np.abs(multiplier))
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * self.strength + blur)

    def newton_step(self) -> Vector:
        """Change of λ that removes the defect to first order.

        A cell on its disc answers only across its own direction; a small multiple of the
        identity keeps the step finite while all cells are on theirs and vanishes with the defect.
        """
        w = np.where(self.outside, self.scale / np.where(self.outside, self.length**2, 1.0), 0.0)
        x, y = self.z
        xx, yy = np.sum(self.scale - w * x * x), np.sum(self.scale - w * y * y)
        xy = -np.sum(w * x * y) if all(self.summed) else 0.0
        damping = 1e-3 * (xx + yy) * np.sum(np.abs(self.defect)) / self.capacity
        damping += self.stiffness
        matrix = np.array([[xx + damping, xy], [xy, yy + damping]])
        return -np.linalg.solve(matrix, self.defect)
