"""Tangential loads, and projection on the shears that Coulomb's friction law admits.

A shear is admissible if |q| <= bound (friction limit) in every cell and if it has the prescribed
force Σq Δ and torque Σ(q_y x - q_x y) Δ. Every iterate is projected exactly on this convex set. The
rigid motions of the indenter, shift and twist, are the multipliers (see multipliers.py). The forces
and torques that friction can carry form a convex set, too. A load reaches its boundary when all
cells slip about one pole, which minimises the power of friction (upper-bound theorem of limit
analysis).
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Indices, Matrix, Vector, VectorField
from contact_scene.friction_limit import reaches_limit
from semi_analytical.multipliers import find_multiplier

# Rounding error of a sum of shears, relative to the sum of their magnitudes.
ROUND_OFF = 1e-14
# Relative rounding error of the multiplier, which shifts the shear of all sticking cells.
MULTIPLIER_ROUND_OFF = 5e-16
MAX_STEPS = 100
# Smoothing of |speed| at the pole, relative to the largest speed.
BLUNT = 1e-8
# Relative decrease of the power of friction at which the iteration stops.
FLAT = 1e-15


@dataclass(frozen=True)
class TangentialLoad:
    """Prescribed tangential load: force or shift, and a torque where torsion is force-controlled.

    A prescribed twist is not part of the load. It changes the displacement that stick requires. The
    rigid motion of the indenter is the shift, or (shift x, shift y, twist) under a torque. Its free
    components are the multipliers of the prescribed forces. Forces are divided by the cell area.

    total       Σq (2,): tangential force; None where the shift is prescribed
    shift       shift of the indenter (2,) [length], or of the actuator of a test rig with a spring;
                None where the force is prescribed
    torque      Σ(q_y x - q_x y), if `rotation` is given
    rotation    (-y, x) of the cells (2, nx, ny) [length]; None where no torque is prescribed
    compliance  extension of the rig's spring per Σq [length^3/force]; 0 without a spring. Under a
                torque it is 0, and only the displacement operator contains the spring
    summed      for x and y: true if the shear along this axis has a resultant. On a reduced domain,
                a component that is odd about a mirror plane has the sum zero, and the indenter does
                not move along it
    """

    total: Vector | None = None
    shift: Vector | None = None
    torque: float = 0.0
    rotation: VectorField | None = None
    compliance: float = 0.0
    summed: tuple[bool, bool] = (True, True)

    @cached_property
    def reach(self) -> float:
        """Length that makes a twist comparable with a shift [length].

        It is the largest distance of a cell from the origin, or 1 without a prescribed torque.
        """
        return 1.0 if self.rotation is None else float(np.max(magnitude(self.rotation)))

    @cached_property
    def _free(self) -> Indices:
        """Indices of the components of the rigid motion (shift x, shift y, twist) that are free.

        A shift is free under a prescribed force, or if a spring connects the indenter with the
        actuator. The twist is free under a prescribed torque.
        """
        shifts = self.total is not None or self.compliance > 0
        free = [shifts and one for one in self.summed]
        return np.flatnonzero([*free, self.rotation is not None])

    @cached_property
    def prescribed_forces(self) -> Vector:
        """Prescribed tangential force and torque (k,), in the order of `free_motions`.

        The torque is divided by the largest distance of a cell from the origin.
        """
        forces = [] if self.total is None else [*self.total[[*self.summed]]]
        return np.array(forces if self.rotation is None else [*forces, self.torque / self.reach])

    def forces(self, q: VectorField) -> Vector:
        """Compute those forces (k,) of a shear that the load prescribes.

        q  shear (2, nx, ny) [force/length^2]
        """
        forces = [] if self.total is None else [*np.sum(q, axis=(1, 2))[[*self.summed]]]
        if self.rotation is not None:
            forces.append(np.sum(q * self.rotation) / self.reach)
        return np.array(forces)

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Return the unit rigid motions conjugate to the prescribed forces, as fields (2, nx, ny).

        The motions are shifts along x and y, and the rotation divided by the largest distance of a
        cell from the origin.

        shape  shape of a field, (2, nx, ny)
        """
        shifts = np.zeros((0, 2)) if self.total is None else np.eye(2)[[*self.summed]]
        units = [np.broadcast_to(everywhere(shift), shape) for shift in shifts]
        if self.rotation is not None:
            units.append(self.rotation / self.reach)
        return tuple(units)

    def rigid(self, motion: Vector) -> VectorField:
        """Compute the displacement of surface points by a rigid motion of the indenter [length].

        The result broadcasts with (2, nx, ny).

        motion  shift (2,), or (shift x, shift y, twist) under a torque
        """
        shift = everywhere(motion[:2])
        return shift if self.rotation is None else shift + motion[2] * self.rotation

    def extension(self, q: VectorField) -> Vector:
        """Compute the extension of the test rig's spring under the tangential force of a shear.

        The extension (2,) [length] is the difference between the shifts of actuator and contact.

        q  shear (2, nx, ny) [force/length^2]
        """
        return np.asarray(self.compliance * np.sum(q, axis=(1, 2)) * self.summed)

    def project_trial(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Compute the admissible shear nearest to a trial shear, and the rigid motion.

        The shear is q = P(y + γ rigid(motion)), with P the projection on |q| <= bound. The free
        components of the motion are chosen so that q has the prescribed forces. With a spring, the
        motion is that of the contact in equilibrium with the spring: the force of the previous
        iterate would convert every change of the shift into slip. Equilibrium requires Σq + λ/(γ c)
        = δ/c, with λ = γ times the shift, the actuator shift δ and the spring compliance c.

        y       trial shear without the rigid motion (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny)
        gamma   γ, traction per displacement [force/length^3]
        motion  initial guess of the rigid motion
        """
        forces, stiffness, found = self.prescribed_forces, 0.0, np.zeros(len(motion))
        if self.shift is not None and self.compliance:
            forces = self.shift[[*self.summed]] / self.compliance
            stiffness = 1 / (gamma * self.compliance)
        elif self.shift is not None:
            y, found[:2] = y + everywhere(gamma * self.shift), self.shift
        scale = gamma * np.array([1.0, 1.0, self.reach])[self._free]
        guess = scale * motion[self._free]
        q, multiplier = self._project(y, bound, forces, guess, stiffness)
        found[self._free] = multiplier / scale
        return q, found

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return the shear nearest to a given one that has the prescribed forces, within friction.

        With a spring the sum of the shear is kept if friction can carry it: under a soft spring its
        change would mean a large change of the shift.

        q      given shear (2, nx, ny) [force/length^2]
        bound  friction limit µp (nx, ny)
        """
        forces = self.prescribed_forces
        if self.compliance:
            forces = np.sum(q, axis=(1, 2))[[*self.summed]]
            if reaches_limit(float(np.linalg.norm(forces)), float(np.sum(bound))):
                return project_on_discs(q, bound)
        return self._project(q, bound, forces)[0]

    def _project(
        self,
        y: VectorField,
        bound: Field,
        forces: Vector,
        guess: Vector | None = None,
        stiffness: float = 0.0,
    ) -> tuple[VectorField, Vector]:
        """Compute the shear with prescribed forces nearest to a given one, and the multipliers.

        The multipliers (k,) are tractions per unit motion that are added before the projection on
        the friction limit.

        y          given shear (2, nx, ny) [force/length^2]
        bound      friction limit µp (nx, ny)
        forces     prescribed forces (k,)
        guess      initial guess of the multipliers (k,); None for an estimate without friction
        stiffness  stiffness of a test rig's spring, over γ
        """
        loaded, units = self._loaded_cells(bound)
        of_loaded, limit = y.reshape(2, -1).take(loaded, axis=1), bound.take(loaded)
        if guess is None:
            guess = (forces - units.forces(of_loaded)) / np.diag(
                units.products(np.ones(len(limit)))
            )
        shifted, multiplier = find_multiplier(
            lambda m: _ProjectedShear(m, of_loaded, limit, units, forces, stiffness), guess
        )
        return _field_with_values(shifted.q, loaded, bound.shape), multiplier

    def _loaded_cells(self, bound: Field) -> "tuple[Indices, _FreeMotions]":
        """Select the cells that can carry shear, because their friction limit is positive.

        Return their flat indices (n,) and the free rigid motions in these cells.

        bound  friction limit µp (nx, ny)
        """
        loaded, turn = np.flatnonzero(bound > 0), self.rotation
        if turn is not None:
            turn = turn.reshape(2, -1).take(loaded, axis=1) / self.reach
        return loaded, _FreeMotions(self._free[self._free < 2], turn)

    def exhausts(self, bound: Field) -> bool:
        """Return True if the prescribed forces together are at or above the friction limit.

        All cells slip then (gross slip), and the rigid motion is undefined. Without friction the
        result is True.

        bound  friction limit µp (nx, ny)
        """
        if not np.any(bound):
            return True
        return bool(np.any(self.prescribed_forces)) and reaches_limit(1.0, self.limit(bound)[0])

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return the shear (2, nx, ny) and the rigid motion of the indenter in gross slip.

        Each cell carries the friction limit in the direction of the motion of gross slip. Without
        friction or without prescribed forces the shear is zero.

        bound   friction limit µp (nx, ny)
        motion  rigid motion, whose free components are returned: gross slip does not determine them
        """
        if self.shift is not None:
            motion = np.array([*self.shift, *motion[2:]])
        if not (np.any(bound) and np.any(self.prescribed_forces)):
            return np.zeros((2, *bound.shape)), motion
        loaded, units = self._loaded_cells(bound)
        speed = units.displacement(self.limit(bound)[1])
        q = bound.take(loaded) * speed / _blunt_size(speed)
        return _field_with_values(q, loaded, bound.shape), motion

    @cached_property
    def _gross_slip(self) -> Vector:
        """Last motion of gross slip, as components (k - 1,) that do no work with the load.

        The method `limit` updates the components and uses them as its initial guess.
        """
        return np.zeros(len(self.prescribed_forces) - 1)

    def limit(self, bound: Field) -> tuple[float, Vector]:
        """Compute the ratio of the limit load to the prescribed load, and the motion of gross slip.

        At the limit load all cells slip. Force and torque are increased by one common factor.
        Newton's method minimises the power of friction over all rigid motions on which the load
        does unit work. The minimum is the ratio (upper-bound theorem of limit analysis). The motion
        (k,) is given in components along `free_motions`.

        bound  friction limit µp (nx, ny)
        """
        start = self.prescribed_forces / np.sum(self.prescribed_forces**2)
        if self.rotation is None:
            return float(np.sum(bound) * np.linalg.norm(start)), start
        loaded, units = self._loaded_cells(bound)
        limit = bound.take(loaded)
        across = np.linalg.svd(self.prescribed_forces[None, :])[2][1:]
        if len(across) == 0:
            return float(limit @ magnitude(units.displacement(start))), start

        def power_at(x: Vector) -> tuple[float, Vector, Field]:
            return _friction_power(start + x @ across, limit, units)

        x = self._gross_slip
        power, slope, curvature = power_at(x)
        for _ in range(MAX_STEPS):
            gradient = across @ slope
            inverse = np.linalg.pinv(across @ curvature @ across.T, rcond=1e-14, hermitian=True)
            step = -inverse @ gradient
            fall = -float(gradient @ step)
            if fall <= FLAT * power:
                break
            x, (power, slope, curvature) = _descend(power_at, x, step, power, fall)
        self._gross_slip[:] = x
        return power, start + x @ across


def _field_with_values(values: Field, cells: Indices, shape: tuple[int, ...]) -> VectorField:
    """Return a vector field (2, nx, ny) with given values in some cells and zeros elsewhere.

    values  vectors of the cells (2, n)
    cells   flat indices of the cells (n,)
    shape   number of cells along x and y
    """
    field = np.zeros((2, *shape))
    for component, of_cells in zip(field.reshape(2, -1), values, strict=True):
        component[cells] = of_cells
    return field


@dataclass(frozen=True)
class _FreeMotions:
    """Rigid motions of the indenter that a load leaves free, in n cells: k unit motions.

    shifts  components of the free shifts: 0 for x, 1 for y
    turn    displacement (2, n) by the unit rotation; None where the twist is not free
    """

    shifts: Indices
    turn: Field | None

    def displacement(self, motion: Vector) -> Field:
        """Compute the displacement (2, n) by a motion (k,); (2, 1) by a shift of all cells."""
        shift = np.zeros((2, 1))
        shift[self.shifts, 0] = motion[: len(self.shifts)]
        return shift if self.turn is None else shift + motion[-1] * self.turn

    def forces(self, q: Field) -> Vector:
        """Compute the forces (k,) of a shear (2, n), conjugate to the unit motions."""
        forces = np.sum(q, axis=1)[self.shifts]
        return forces if self.turn is None else np.array([*forces, np.sum(self.turn * q)])

    def projections(self, vector: Field) -> Field:
        """Compute the scalar products (k, n) of the unit motions with a vector of each cell."""
        along = vector[self.shifts]
        return along if self.turn is None else np.stack([*along, np.sum(self.turn * vector, 0)])

    def products(self, weight: Vector) -> Matrix:
        """Compute the scalar products (k, k) of the unit motions, with a weight of each cell."""
        if self.turn is None:
            return np.sum(weight) * np.eye(len(self.shifts))
        products = np.sum(weight) * np.eye(len(self.shifts) + 1)
        weighted = weight * self.turn
        products[-1, :-1] = products[:-1, -1] = np.sum(weighted, axis=1)[self.shifts]
        products[-1, -1] = np.sum(weighted * self.turn)
        return products


def _friction_power(
    velocity: Vector, limit: Vector, units: _FreeMotions
) -> tuple[float, Vector, Matrix]:
    """Compute the power of friction in gross slip, with its gradient and Hessian.

    The power is the sum over the cells of friction limit times sliding speed. The limit load
    minimises this power over the rigid motions of the indenter.

    velocity  rigid motion, as components along the unit motions (k,)
    limit     friction limit of the loaded cells (n,)
    units     free rigid motions in the loaded cells
    """
    speed = units.displacement(velocity)
    size = _blunt_size(speed)
    weight = limit / size
    along = units.projections(speed) / size
    curvature = units.products(weight) - (along * weight) @ along.T
    return float(limit @ size), units.forces(weight * speed), curvature


def _blunt_size(speed: VectorField) -> Field:
    """Compute the sliding speed of each cell (n,), smoothed near the centre of rotation.

    At this centre, the pole of the rigid motion, the speed is zero and its derivative does not
    exist.

    speed  sliding velocity of each cell (2, n)
    """
    size = magnitude(speed)
    return np.hypot(size, BLUNT * np.max(size))


Power = tuple[float, Vector, Field]


def _descend(
    power_at: Callable[[Vector], Power], x: Vector, step: Vector, power: float, fall: float
) -> tuple[Vector, Power]:
    """Apply a Newton step, bisected until the power of friction decreases sufficiently (Armijo).

    The steps minimise the power of friction to find the limit load of gross slip. Return the
    accepted position and its power with gradient and Hessian.

    power_at     function from a position to the power of friction, its gradient and its Hessian
    x, step      position (free components of the rigid motion) and Newton step
    power, fall  power at x, and its decrease predicted by the gradient
    """
    part = 1.0
    while True:
        there = power_at(x + part * step)
        if there[0] <= power - 0.1 * part * fall or part < 1e-9:
            return x + part * step, there
        part *= 0.5


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
    if load.shift is not None and load.compliance:
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


class _ProjectedShear:
    """Projection of a shear z = y + Σ λ unit on the friction limit of loaded cells, for given λ.

    The multipliers λ are those of the prescribed forces. `TangentialLoad` solves for the λ whose
    projected shear q has these forces (see multipliers.py).

    multiplier  multipliers λ (k,) of the prescribed forces
    y           shear of the loaded cells before the shift (2, n)
    bound       friction limit of these cells (n,)
    units       free rigid motions in these cells
    given       prescribed forces conjugate to the unit motions (k,)
    stiffness   stiffness of a test rig's spring, over γ: the forces then include stiffness λ
    """

    def __init__(
        self,
        multiplier: Vector,
        y: Field,
        bound: Vector,
        units: _FreeMotions,
        given: Vector,
        stiffness: float,
    ) -> None:
        self._units, self._stiffness = units, stiffness
        self._z = y + units.displacement(multiplier)
        self._bound, self._length = bound, magnitude(self._z)
        self._scale = bound / np.maximum(self._length, bound)
        self.q = self._z * self._scale
        self.defect = units.forces(self.q) + stiffness * multiplier - given

    def has_prescribed_forces(self, multiplier: Vector) -> bool:
        """Return True if the projected shear has the prescribed forces up to rounding errors.

        The Newton iteration for the multiplier stops then.

        multiplier  multiplier for which the projection was computed
        """
        response = np.sum(self._scale) + self._stiffness
        blur = MULTIPLIER_ROUND_OFF * response * np.sum(np.abs(multiplier))
        strength = np.sum(self._length * self._scale)
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * strength + blur)

    def newton_step(self) -> Vector:
        """Compute the damped Newton step of the multipliers λ (k,) of the prescribed forces.

        The derivative of the projection in a cell is the matrix scale - w z zᵀ, with w = 0 within
        the friction limit. The derivative of the forces is singular if all cells slip along their
        motion. The damping is relative to its part by `scale`, which does not vanish then.
        """
        along = self._units.projections(self._z)
        products = self._units.products(self._scale)
        outside = self._length > self._bound
        radial = outside * self._scale / np.maximum(self._length, self._bound) ** 2
        matrix = products - (along * radial) @ along.T
        damping = np.trace(products) * (np.sum(np.abs(self.defect)) / np.sum(self._bound)) ** 2
        damping = 1e-3 * damping + self._stiffness
        return -np.linalg.solve(matrix + damping * np.eye(len(matrix)), self.defect)
