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
    """Interface of the prescribed load of the tangential problem.

    The load is a force or shift, and a torque or twist. The tangential problem determines the shear
    and the rigid motion of the indenter under this load. The rigid motion is the shift (2,), or
    shift and twist (3,).
    """

    def rigid(self, motion: Vector) -> VectorField:
        """Compute the displacement of the indenter's surface points by shift and twist [length].

        The result broadcasts with (2, nx, ny). By default the rigid motion is a shift.

        motion  shift (2,) [length], or shift and twist (3,)
        """
        return everywhere(motion)

    def project_trial(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Compute the admissible shear nearest to a trial shear, and the indenter's rigid motion.

        A shear is admissible if |q| <= bound in all cells and its forces have the prescribed
        values. The shear y + γ rigid(motion) is projected on the admissible shears. The motion is
        chosen so that the projection has the prescribed forces. Return the admissible shear and
        this motion.

        y       trial shear without the rigid motion (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny)
        gamma   γ, traction per displacement [force/length^3]
        motion  initial guess of the rigid motion
        """

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return the shear nearest to a given one that has the prescribed forces, within friction.

        Friction limits the shear of each cell to |q| <= bound.

        q      given shear (2, nx, ny) [force/length^2]
        bound  friction limit µp (nx, ny)
        """

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Return the unit rigid motions of the indenter that the load leaves free.

        A rigid motion (shift along x or y, twist) is free if its conjugate force or torque is
        prescribed. The motions are displacement fields (2, nx, ny). By default there is none.

        shape  shape of a field, (2, nx, ny)
        """
        return ()

    @property
    def prescribed_forces(self) -> Vector:
        """Prescribed tangential forces and torque, divided by the cell area (k,).

        The order is that of `free_motions`: one force per rigid motion that is free.
        """
        return np.zeros(0)

    def forces(self, q: VectorField) -> Vector:
        """Compute the forces and the torque of a shear (2, nx, ny), divided by the cell area (k,).

        Only prescribed forces are computed. The order is that of `free_motions`: each entry is
        conjugate to one of these rigid motions.

        q  shear (2, nx, ny) [force/length^2]
        """
        return np.zeros(0)

    def exhausts(self, bound: Field) -> bool:
        """Return True if the prescribed load reaches or exceeds the friction limit (gross slip).

        All cells slip then, and the rigid motion is undefined under force control.

        bound  friction limit µp (nx, ny); may be zero everywhere
        """

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return the shear (2, nx, ny) and the rigid motion of the indenter in gross slip.

        In gross slip the shear of all cells is at the friction limit.

        bound   friction limit µp (nx, ny)
        motion  rigid motion that is returned where gross slip does not determine it
        """


@dataclass(frozen=True)
class ShearSum(TangentialLoad):
    """Force control of the tangential problem: the tangential force is prescribed.

    The force is the sum Σq of the shear over all cells times the cell area.

    total   tangential force over cell area (2,) [force/length^2]
    summed  for x and y: true if the shear along this axis has a resultant. On a reduced domain, a
            component that is odd about a mirror plane has the sum zero, and the indenter does not
            move along it
    """

    total: Vector
    summed: tuple[bool, bool] = (True, True)

    def project_trial(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Compute the shear with the prescribed force nearest to a trial shear, within friction.

        The shear y + γ shift is projected on |q| <= bound. The shift is chosen so that the sum of
        the projection is the prescribed sum. Return the projected shear and the shift.

        y       trial shear without the shift (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny)
        gamma   γ, traction per displacement [force/length^3]
        motion  initial guess of the shift (2,) [length]
        """
        q, multiplier = project(y, bound, self.total, gamma * motion, self.summed)
        return q, multiplier / gamma

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return the shear with the prescribed force nearest to a given one, within friction.

        Friction limits the shear of each cell to |q| <= bound.

        q      given shear (2, nx, ny) [force/length^2]
        bound  friction limit µp (nx, ny)
        """
        return project(q, bound, self.total, summed=self.summed)[0]

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Return the unit shifts of the indenter along x and y as fields (2, nx, ny).

        The shifts are free under a prescribed tangential force. On a reduced domain, a shift is
        omitted if the shear along it has no resultant by symmetry.

        shape  shape of a field, (2, nx, ny)
        """
        return tuple(np.broadcast_to(everywhere(e), shape) for e in np.eye(2)[list(self.summed)])

    @property
    def prescribed_forces(self) -> Vector:
        """Prescribed tangential force divided by the cell area: up to two components (k,).

        On a reduced domain, a component of the shear that is odd about a mirror plane has no
        resultant and is omitted.
        """
        return self.total[list(self.summed)]

    def forces(self, q: VectorField) -> Vector:
        """Compute the tangential force of a shear, divided by the cell area: the sum over all
        cells.

        On a reduced domain, a component of the shear that is odd about a mirror plane has no
        resultant and is omitted.

        q  shear (2, nx, ny) [force/length^2]
        """
        return np.array([np.sum(one) for one, summed in zip(q, self.summed, strict=True) if summed])

    def exhausts(self, bound: Field) -> bool:
        """Return True if the prescribed tangential force is at or above the friction limit Σµp.

        Force and limit are compared after division by the cell area.

        bound  friction limit µp of each cell (nx, ny)
        """
        return float(np.hypot(*self.total)) >= float(np.sum(bound)) * (1 - AT_LIMIT)

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return the shear in gross slip: the friction limit in the direction of the force.

        The second result is the given rigid motion, because gross slip under force control does not
        determine the motion. Without friction the shear is zero.

        bound   friction limit µp (nx, ny)
        motion  rigid motion to return
        """
        if not np.any(bound):
            return np.zeros((2, *bound.shape)), motion
        return bound * everywhere(self.total / np.hypot(*self.total)), motion


@dataclass(frozen=True)
class FixedShift(TangentialLoad):
    """Displacement control of the tangential problem: the shift of the indenter is prescribed.

    The tangential force follows from the solution.

    shift  tangential shift (2,) [length]
    """

    shift: Vector

    def project_trial(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Scale the trial shear of each cell to the friction limit where the limit is exceeded.

        The trial shear is y + γ shift. Return the scaled shear and the prescribed shift of the
        indenter.

        y       trial shear without the shift (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny)
        gamma   γ, traction per displacement [force/length^3]
        motion  not used, because the shift is prescribed
        """
        return project_on_discs(y + everywhere(gamma * self.shift), bound), self.shift

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Scale the shear of each cell to the friction limit where the shear exceeds this limit.

        No tangential force is prescribed.

        q      shear (2, nx, ny) [force/length^2]
        bound  friction limit µp (nx, ny)
        """
        return project_on_discs(q, bound)

    def exhausts(self, bound: Field) -> bool:
        """Return True if friction is zero in all cells.

        Under a prescribed shift, gross slip is certain before the solution only without friction.

        bound  friction limit µp (nx, ny)
        """
        return not np.any(bound)

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return zero shear and the prescribed shift: the state of a contact without friction.

        Under a prescribed shift only zero friction counts as gross slip.

        bound   friction limit µp (nx, ny), zero everywhere
        motion  not used, because the shift is prescribed
        """
        return np.zeros((2, *bound.shape)), self.shift


@dataclass(frozen=True)
class SprungShift(FixedShift):
    """Tangential displacement control through a spring of the test rig.

    The shift of the actuator is prescribed. The shift of the contact is the shift of the actuator
    minus the extension of the spring. `project_trial` uses the spring force of the projected shear.
    With the force of the previous iterate, a soft spring would convert every change of the shift
    into slip of all cells.

    shift       shift of the actuator (2,) [length]
    compliance  extension of the spring per sum of the shear over the cells [length^3/force]
    summed      for x and y: true if the shear along this axis has a resultant; on a reduced domain,
                a component that is odd about a mirror plane has the sum zero
    """

    compliance: float
    summed: tuple[bool, bool] = (True, True)

    def extension(self, q: VectorField) -> Vector:
        """Compute the extension of the test rig's spring under the tangential force of a shear.

        The extension (2,) [length] is the difference between the shifts of actuator and contact.

        q  shear (2, nx, ny) [force/length^2]
        """
        return np.asarray(self.compliance * np.sum(q, axis=(1, 2)) * self.summed)

    def project_trial(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Compute the shear near a trial shear that is in equilibrium with the rig's spring.

        The spring of the test rig connects actuator and indenter. The projected shear is q = P(y +
        λ), with P the projection on |q| <= bound and λ = γ times the shift of the contact.
        Equilibrium requires Σq + λ/(γ c) = δ/c, with the actuator shift δ and the spring compliance
        c. Return q and λ/γ, the shift of the contact.

        y       trial shear without the shift (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny)
        gamma   γ, traction per displacement [force/length^3]
        motion  initial guess of the shift of the contact (2,) [length]
        """
        c = self.compliance
        total = self.shift * self.summed / c
        stiffness = 1 / (gamma * c)
        q, multiplier = project(y, bound, total, gamma * motion, self.summed, stiffness)
        return q, multiplier / gamma

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return the shear within friction nearest to a given one, if possible with equal sum.

        The sum determines the extension of the test rig's spring. With a soft spring a change of
        the sum would mean a large change of the shift. If friction cannot carry the sum, the shear
        of each cell is scaled to the friction limit.

        q      given shear (2, nx, ny) [force/length^2]
        bound  friction limit µp (nx, ny)
        """
        total = np.sum(q, axis=(1, 2)) * self.summed
        if np.hypot(*total) >= np.sum(bound) * (1 - AT_LIMIT):
            return project_on_discs(q, bound)
        return project(q, bound, total, summed=self.summed)[0]


class NaturalShear(NamedTuple):
    """Value of the friction law, written as a natural map q -> P(z), at a shear q.

    P is the projection on the admissible shears: within the friction limit and with the prescribed
    forces. The shear is a solution of the tangential problem if P(z) = q.

    z          q + γ (ω + c - u) (2, nx, ny): ω rigid motion, c displacement that stick requires, u
               displacement, γ a stiffness
    projected  P(z) (2, nx, ny)
    slipped    slip ω + c - u of the indenter relative to the body (2, nx, ny) [length]
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
    """Evaluate the friction law, written as a natural map q -> P(z), at a shear q.

    Semismooth Newton methods use the natural map. z is q + γ times the slip, and P is the
    projection on the admissible shears. The shear is a solution if P(z) = q. With a spring, z has
    the motion of the contact that is in equilibrium with the spring, and the slip has that of the
    present extension. The two motions are equal in a solution.

    load    prescribed tangential load
    q       shear (2, nx, ny)
    apart   displacement that stick requires minus actual displacement (2, nx, ny) [length]
    bound   friction limit µp (nx, ny)
    gamma   γ, inverse self-compliance of a cell or a patch of cells [force/length^3]
    motion  initial guess of the rigid motion
    """
    if isinstance(load, SprungShift):
        extension = load.extension(q)
        y = q + gamma * (apart + everywhere(extension))
        projected, reached = load.project_trial(y, bound, gamma, load.shift - extension)
        z, motion = y + gamma * everywhere(reached), load.shift
        slipped = apart + everywhere(motion)
    else:
        projected, motion = load.project_trial(q + gamma * apart, bound, gamma, motion)
        slipped = apart + load.rigid(motion)
        z = q + gamma * slipped
    error = float(np.sum(magnitude(projected - q)) / np.sum(bound))
    return NaturalShear(z, projected, slipped, motion, error)


def magnitude(v: VectorField) -> Field:
    """Compute the length of each two-component vector of a field (2, ...), such as the shear."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1])


def everywhere(v: Vector) -> VectorField:
    """Return a vector (2,) as a uniform vector field (2, 1, 1), which broadcasts with (2, nx, ny).

    v  vector, such as the shift of the indenter
    """
    return v[:, None, None]


def project_on_discs(y: VectorField, bound: Field) -> VectorField:
    """Scale the shear of each cell to the friction limit where the shear exceeds this limit.

    The direction of the shear is preserved. The operation is the projection on the friction discs
    |q| <= bound.

    y      shear (2, nx, ny) [force/length^2]
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
    """Compute the shear with a prescribed sum nearest to a given one, within friction.

    The result is q = P(y + λ), with P the projection on |q| <= bound of each cell. The multiplier λ
    of the sum is a uniform traction (2,). Return q and λ.

    y          given shear (2, nx, ny) [force/length^2]
    bound      friction limit µp (nx, ny); |total| must be less than its sum
    total      prescribed sum of the shear over the cells (2,)
    guess      initial guess of λ (2,); None for an estimate
    summed     components with a prescribed sum; λ is zero along the others
    stiffness  stiffness of a test rig's spring, over γ: the sum then obeys Σq + stiffness λ = total
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

    The shear z contains the multiplier of the prescribed forces, such as a uniform traction.
    `multipliers.py` solves for the multiplier whose projected shear q has the prescribed forces.

    defect     forces of the projected shear minus prescribed forces
    z, length  shear (2, ...) and its magnitude (...)
    outside    cells where the magnitude exceeds the friction limit
    scale, q   factor of the projection (...), and q = scale z
    capacity   sum of the friction limit over the cells
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

    def has_prescribed_forces(self, multiplier: Vector) -> bool:
        """Return True if the projected shear has the prescribed forces up to rounding errors.

        The Newton iteration for the multiplier stops then.

        multiplier  multiplier for which the projection was computed
        """
        response = np.sum(self.scale) + self.stiffness
        blur = MULTIPLIER_ROUND_OFF * response * np.sum(np.abs(multiplier))
        strength = np.sum(self.length * self.scale)
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * strength + blur)

    @property
    def radial(self) -> Field:
        """Weight w (…) of the radial part of the derivative of the projection z -> q in each cell.

        z is the shear before and q the shear after the projection on the friction limit. The
        derivative is the matrix scale - w z zᵀ. The weight is zero where |z| is within the friction
        limit, because q = z there.
        """
        return np.where(self.outside, self.scale / np.where(self.outside, self.length**2, 1.0), 0.0)


class _ShiftedSum(ProjectedShear):
    """Projection of a shear y + λ on the friction discs |q| <= bound, for one uniform traction λ.

    The defect is Σq + stiffness λ - total, with the prescribed sum `total` of the shear. It is zero
    along components without a prescribed sum. `project` solves for the λ with zero defect.
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
        """Compute the damped Newton step of the uniform traction λ that reduces the defect of Σq.

        The derivative of the sum is singular if all cells slip in one direction, because a slipping
        cell changes only perpendicular to its shear. A multiple of the identity keeps the matrix
        regular. It vanishes with the defect.
        """
        (x, y), w = self.z, self.radial
        xx, yy = np.sum(self.scale - w * x * x), np.sum(self.scale - w * y * y)
        xy = -np.sum(w * x * y) if all(self.summed) else 0.0
        damping = 1e-3 * (xx + yy) * np.sum(np.abs(self.defect)) / self.capacity
        damping += self.stiffness
        matrix = np.array([[xx + damping, xy], [xy, yy + damping]])
        return -np.linalg.solve(matrix, self.defect)
