"""Tangential loads, and projection on the shears that Coulomb's friction law admits.

A shear is admissible if |q| <= bound (friction limit) in every cell and, under force control, if it
has the prescribed sum. Every iterate is projected exactly on this convex set. The multiplier of the
sum is the rigid shift (see multipliers.py).
"""

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from semi_analytical.multipliers import find_multiplier

# Rounding error of a sum of shears, relative to the sum of their magnitudes.
ROUND_OFF = 1e-14
# Relative distance from the friction limit below which the shift is undefined: the stick zone, by
# the cube root a thousandth of the contact wide, is smaller than a cell.
AT_LIMIT = 1e-9
# Relative rounding error of the multiplier, which shifts the shear of all sticking cells.
MULTIPLIER_ROUND_OFF = 5e-16


class TangentialLoad(Protocol):
    """Interface of the load of the tangential problem: prescribed forces or prescribed rigid
    motion.

    The rigid motion of a load is the shift (2,), or shift and twist (3,).
    """

    def rigid(self, motion: Vector) -> VectorField:
        """Compute the tangential displacement by a rigid motion, which broadcasts with (2, nx, ny)
        [length].

        By default the motion is a shift.
        """
        return everywhere(motion)

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Project y + γ rigid(motion) on the admissible shears; return the shear and the free rigid
        motion.

        y       shear (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny)
        gamma   γ, traction per displacement [force/length^3]
        motion  initial guess of the free components of the rigid motion
        """

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Project a shear q (2, nx, ny) on the shears that satisfy the friction limit and the
        prescribed forces."""

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Return the unit rigid motions whose conjugate forces are prescribed, as fields (2, nx,
        ny)."""
        return ()

    @property
    def given(self) -> Vector:
        """Prescribed forces divided by the cell area, in the order of the free motions."""
        return np.zeros(0)

    def forces(self, q: VectorField) -> Vector:
        """Compute the forces of a shear that are conjugate to the free motions, divided by the
        cell area."""
        return np.zeros(0)

    def exhausts(self, bound: Field) -> bool:
        """Return True if the load is at or above the friction limit, which may be zero.

        bound  friction limit µp (nx, ny)
        """

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return the shear (2, nx, ny) and the rigid motion in gross slip.

        bound   friction limit µp (nx, ny)
        motion  rigid motion that is returned where gross slip does not determine it
        """


@dataclass(frozen=True)
class ShearSum(TangentialLoad):
    """Force control of the tangential problem: the sum Σq of the shear over all cells is
    prescribed.

    total   tangential force over cell area (2,) [force/length^2]
    summed  components with a resultant; the others are odd about a mirror plane: their sum over the
            window is zero, and the indenter does not move along them
    """

    total: Vector
    summed: tuple[bool, bool] = (True, True)

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Project y + γ shift on the shears with the prescribed sum; return the shear and the
        shift.

        The multiplier of the sum is γ times the shift.

        y       shear (2, nx, ny)
        bound   friction limit µp (nx, ny)
        motion  initial guess of the shift (2,)
        """
        q, multiplier = project(y, bound, self.total, gamma * motion, self.summed)
        return q, multiplier / gamma

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Project a shear on the discs |q| <= bound of all cells and on the prescribed sum."""
        return project(q, bound, self.total, summed=self.summed)[0]

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Return the unit shifts along the components with a resultant, as fields (2, nx, ny)."""
        return tuple(np.broadcast_to(everywhere(e), shape) for e in np.eye(2)[list(self.summed)])

    @property
    def given(self) -> Vector:
        """Prescribed sum of the shear, along the components with a resultant."""
        return self.total[list(self.summed)]

    def forces(self, q: VectorField) -> Vector:
        """Compute the sum of a shear over the cells, along the components with a resultant."""
        return np.array([np.sum(one) for one, summed in zip(q, self.summed, strict=True) if summed])

    def exhausts(self, bound: Field) -> bool:
        """Return True if the prescribed force is at or above the friction limit Σ bound."""
        return float(np.hypot(*self.total)) >= float(np.sum(bound)) * (1 - AT_LIMIT)

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return the shear in gross slip: the friction limit in the direction of the prescribed
        force.

        The rigid motion is returned unchanged.
        """
        if not np.any(bound):
            return np.zeros((2, *bound.shape)), motion
        return bound * everywhere(self.total / np.hypot(*self.total)), motion


@dataclass(frozen=True)
class FixedShift(TangentialLoad):
    """Displacement control of the tangential problem: the shift of the indenter is prescribed.

    shift  tangential shift (2,) [length]
    """

    shift: Vector

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Project y + γ shift on the friction discs cell by cell; return the shear and the
        prescribed shift."""
        return project_on_discs(y + everywhere(gamma * self.shift), bound), self.shift

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Project a shear on the discs |q| <= bound of all cells."""
        return project_on_discs(q, bound)

    def exhausts(self, bound: Field) -> bool:
        """Return True if the friction limit is zero in all cells."""
        return not np.any(bound)

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return zero shear and the prescribed shift; under a prescribed shift only zero
        friction gives gross slip."""
        return np.zeros((2, *bound.shape)), self.shift


@dataclass(frozen=True)
class SprungShift(FixedShift):
    """Displacement control through a spring of the test rig: the shift of the actuator is
    prescribed.

    The spring is part of the compliance. `nearest` uses the spring force after the step: with the
    force before the step, a soft spring would convert every change of the shift into slip of all
    cells. The motion is that of the contact.

    shift       shift of the actuator (2,) [length]
    compliance  displacement of the spring per sum of the shear [length^3/force]
    summed      see `ShearSum`
    """

    compliance: float
    summed: tuple[bool, bool] = (True, True)

    def extension(self, q: VectorField) -> Vector:
        """Compute the extension of the spring (2,) [length] under the force of a shear (2, nx,
        ny)."""
        return np.asarray(self.compliance * np.sum(q, axis=(1, 2)) * self.summed)

    def nearest(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Project y + λ such that Σq + λ/(γc) = δ/c, with the actuator shift δ and the spring
        compliance c.

        Return the shear q and λ/γ, the motion of the contact.
        """
        c = self.compliance
        total = self.shift * self.summed / c
        stiffness = 1 / (gamma * c)
        q, multiplier = project(y, bound, total, gamma * motion, self.summed, stiffness)
        return q, multiplier / gamma

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Project a shear on the friction discs with its sum preserved, if friction can carry the
        sum.

        With a soft spring a change of the sum would be a large motion.
        """
        total = np.sum(q, axis=(1, 2)) * self.summed
        if np.hypot(*total) >= np.sum(bound) * (1 - AT_LIMIT):
            return project_on_discs(q, bound)
        return project(q, bound, total, summed=self.summed)[0]


class NaturalShear(NamedTuple):
    """Value of the natural map P(z) of the tangential problem at a shear q, with P the projection.

    The shear is a solution if P(z) = q.

    z          q + γ (ω + c - u) (2, nx, ny): ω rigid motion, c displacement that stick requires, u
               displacement
    projected  P(z) (2, nx, ny)
    slipped    slip ω + c - u (2, nx, ny) [length]
    motion     rigid motion ω of the load
    error      residual Σ|q - P(z)| / Σ bound
    """

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
    """Evaluate the natural map of the tangential problem, used by semismooth Newton methods.

    With a spring, z has the motion of the contact after the step and the slip that of the present
    extension; the two are equal in a solution.

    load    prescribed tangential load
    q       shear (2, nx, ny)
    apart   displacement that stick requires minus actual displacement, c - u (2, nx, ny) [length]
    bound   friction limit µp (nx, ny)
    gamma   γ, inverse self-compliance of a cell [force/length^3]
    motion  initial guess of the rigid motion
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
    """Compute the length (...) of the two-component vectors of a field (2, ...)."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1])


def everywhere(v: Vector) -> VectorField:
    """Return a vector (2,) as a uniform vector field that broadcasts with (2, nx, ny)."""
    return v[:, None, None]


def project_on_discs(y: VectorField, bound: Field) -> VectorField:
    """Project a shear y (2, nx, ny) on |q| <= bound, cell by cell.

    bound  friction limit µp (nx, ny)
    """
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
    """Project a shear on the set |q| <= bound, Σq = total; return the shear and the multiplier λ of
    the sum.

    y          any shear (2, nx, ny)
    bound      friction limit µp (nx, ny); |total| must be less than its sum
    total      prescribed sum of the shear (2,)
    guess      initial guess of λ (2,)
    summed     components with a prescribed sum; λ is zero along the others
    stiffness  stiffness of a spring, over γ: Σq + stiffness λ = total
    """
    if guess is None:
        open_cells = bound > 0
        excess = np.sum(y, axis=(1, 2), where=open_cells) - total
        guess = -excess / np.count_nonzero(open_cells) * summed
    shifted, multiplier = find_multiplier(
        lambda m: _ShiftedSum(m, y, bound, total, summed, stiffness), guess
    )
    return shifted.q, multiplier


class ProjectedShear:
    """Projection of a shear z on the friction discs |q| <= bound, for one value of a multiplier.

    `multipliers.py` solves for the multiplier whose projected shear has the prescribed forces.

    defect     forces of the projected shear minus prescribed forces
    z, length  shear (2, ...) and its magnitude (...)
    outside    cells where the magnitude exceeds the bound
    scale, q   factor of the projection (...), and q = scale z
    capacity   sum of the bound
    """

    defect: Vector
    stiffness = 0.0

    def __init__(self, z: VectorField, bound: Field) -> None:
        self.z, self.length = z, magnitude(z)
        self.outside = self.length > bound
        cut = bound / np.where(self.outside, self.length, 1.0)
        self.scale = np.where(self.outside, cut, 1.0) * (bound > 0)
        self.q = z * self.scale
        self.capacity = float(np.sum(bound))

    def settled(self, multiplier: Vector) -> bool:
        """Return True if the defect of the prescribed forces is at the level of rounding errors.

        multiplier  multiplier for which the projection was computed
        """
        response = np.sum(self.scale) + self.stiffness
        blur = MULTIPLIER_ROUND_OFF * response * np.sum(np.abs(multiplier))
        strength = np.sum(self.length * self.scale)
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * strength + blur)

    @property
    def radial(self) -> Field:
        """Weight w of the derivative of the projected shear, which is scale - w z z (...).

        The weight is zero in cells where |z| is within the friction limit.
        """
        return np.where(self.outside, self.scale / np.where(self.outside, self.length**2, 1.0), 0.0)


class _ShiftedSum(ProjectedShear):
    """Projection of y + λ on the friction discs, with the defect Σq + stiffness λ - total.

    The defect is zero along components without a prescribed sum. Arguments as for `project`.
    """

    def __init__(
        self,
        multiplier: Vector,
        y: VectorField,
        bound: Field,
        total: Vector,
        summed: tuple[bool, bool],
        stiffness: float,
    ) -> None:
        super().__init__(y + everywhere(multiplier), bound)
        self.summed, self.stiffness = summed, stiffness
        self.defect = (np.sum(self.q, axis=(1, 2)) + stiffness * multiplier - total) * summed

    def newton_step(self) -> Vector:
        """Compute the regularised Newton step of the multiplier λ that reduces the defect.

        A cell on its disc changes only perpendicular to its shear. A multiple of the identity keeps
        the matrix regular while all cells are on their discs, and vanishes with the defect.
        """
        (x, y), w = self.z, self.radial
        xx, yy = np.sum(self.scale - w * x * x), np.sum(self.scale - w * y * y)
        xy = -np.sum(w * x * y) if all(self.summed) else 0.0
        damping = 1e-3 * (xx + yy) * np.sum(np.abs(self.defect)) / self.capacity
        damping += self.stiffness
        matrix = np.array([[xx + damping, xy], [xy, yy + damping]])
        return -np.linalg.solve(matrix, self.defect)
