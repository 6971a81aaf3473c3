"""Torsion of the indenter under a prescribed torque; this module is not imported without torsion.

A prescribed twist only adds to the displacement that stick requires. A prescribed torque Σ(q_y x -
q_x y) Δ is a constraint like the tangential force: the twist is its multiplier, as the shift is
that of Σq. The loads (T, M) that friction can carry form a convex set. A load reaches the boundary
of this set when all cells slip about one pole, which minimises the power of friction (upper-bound
theorem of limit analysis).
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
    """Tangential load with a prescribed torque, and with prescribed tangential force or shift.

    The torque is Σ(q_y x - q_x y) and the tangential force Σq, with the shear q of all cells, each
    times the cell area. The rigid motion of the indenter is (shift x, shift y, twist).

    rotation  (-y, x) of the cells (2, nx, ny) [length]
    torque    Σ(q_y x - q_x y) = M_z / cell area, with the torque M_z
    total     Σq = T / cell area, shape (2,), with the tangential force T; None where the shift is
              prescribed
    shift     shift of the indenter (2,) [length]; None where Σq is prescribed
    """

    rotation: VectorField
    torque: float
    total: Vector | None = None
    shift: Vector | None = None

    @cached_property
    def reach(self) -> float:
        """Length that makes a twist comparable with a shift [length].

        It is the largest distance of a cell from the origin.
        """
        return float(np.max(magnitude(self.rotation)))

    @cached_property
    def units(self) -> tuple[VectorField, ...]:
        """Unit rigid motions of the indenter that the load leaves free, as fields (2, nx, ny).

        A motion is free if its conjugate force or torque is prescribed. The motions are shifts
        along x and y if the tangential force is prescribed, then the rotation. The rotation is
        divided by the largest distance of a cell from the origin.
        """
        turn = self.rotation / self.reach
        if self.total is None:
            return (turn,)
        return (*(np.broadcast_to(everywhere(e), turn.shape) for e in np.eye(2)), turn)

    @cached_property
    def _gross_slip(self) -> Vector:
        """Last motion of gross slip, as components (k - 1,) that do no work with the load.

        The method `limit` updates the components and uses them as its initial guess.
        """
        return np.zeros(len(self.prescribed_forces) - 1)

    @cached_property
    def prescribed_forces(self) -> Vector:
        """Prescribed tangential force and torque (k,), divided by the cell area.

        Each entry is conjugate to one of the unit motions `units`. The torque is also divided by
        the largest distance of a cell from the origin, like the unit rotation.
        """
        torque = self.torque / self.reach
        return np.array([torque] if self.total is None else [*self.total, torque])

    def forces(self, q: VectorField) -> Vector:
        """Compute tangential force and torque (k,) of a shear, divided by the cell area.

        Each entry is conjugate to one of the unit motions `units`. The force is absent where the
        shift is prescribed.

        q  shear (2, nx, ny) [force/length^2]
        """
        return np.array([np.sum(q * unit) for unit in self.units])

    def free_motions(self, shape: tuple[int, ...]) -> tuple[VectorField, ...]:
        """Return the unit rigid motions that the load leaves free, as fields (2, nx, ny).

        The rotation is free, because the torque is prescribed. Shifts are free if the tangential
        force is prescribed.

        shape  not used
        """
        return self.units

    def rigid(self, motion: Vector) -> VectorField:
        """Compute the displacement of surface points by shift and twist of the indenter [length].

        The result has the shape (2, nx, ny).

        motion  vector (shift x, shift y, twist)
        """
        return everywhere(motion[:2]) + motion[2] * self.rotation

    def project_trial(
        self, y: VectorField, bound: Field, gamma: float, motion: Vector
    ) -> tuple[VectorField, Vector]:
        """Compute the shear with the prescribed torque nearest to a trial shear, within friction.

        The shear y + γ rigid(motion) is projected on |q| <= bound. The free components of the
        motion are chosen so that the projection has the prescribed torque, and the tangential force
        if it is prescribed. Return the projected shear and the motion (shift x, shift y, twist).

        y       trial shear without the rigid motion (2, nx, ny) [force/length^2]
        bound   friction limit µp (nx, ny)
        gamma   γ, traction per displacement [force/length^3]
        motion  initial guess of the motion (3,)
        """
        if self.shift is not None:
            y = y + everywhere(gamma * self.shift)
            guess = gamma * self.reach * motion[2:]
        else:
            guess = gamma * np.array([*motion[:2], self.reach * motion[2]])
        q, multiplier = self._project(y, bound, guess)
        shift = self.shift if self.shift is not None else multiplier[:2] / gamma
        return q, np.array([*shift, multiplier[-1] / (gamma * self.reach)])

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return the shear with the prescribed torque nearest to a given one, within friction.

        The result also has the prescribed tangential force, if a force is prescribed.

        q      given shear (2, nx, ny) [force/length^2]
        bound  friction limit µp (nx, ny)
        """
        return self._project(q, bound, np.zeros(len(self.prescribed_forces)))[0]

    def _project(self, y: VectorField, bound: Field, guess: Vector) -> tuple[VectorField, Vector]:
        """Compute the shear with the prescribed torque nearest to a given one, and the multipliers.

        The multipliers (k,) are tractions per unit motion that are added before the projection on
        the friction limit. They are found by Newton's method.

        y      given shear (2, nx, ny) [force/length^2]
        bound  friction limit µp (nx, ny)
        guess  initial guess of the multipliers (k,)
        """
        loaded, units = self._loaded_cells(bound)
        of_loaded, limit = y[:, loaded], bound[loaded]

        shifted, multiplier = find_multiplier(
            lambda m: _ShiftedMoments(m, of_loaded, limit, units, self.prescribed_forces), guess
        )
        q = np.zeros_like(y)
        q[:, loaded] = shifted.q
        return q, multiplier

    def _loaded_cells(self, bound: Field) -> tuple[Mask, Field]:
        """Select the cells that can carry shear, because their friction limit is positive.

        Return their mask (nx, ny) and the unit motions in these n cells (k, 2, n).

        bound  friction limit µp (nx, ny)
        """
        loaded = bound > 0
        return loaded, np.stack([unit[:, loaded] for unit in self.units])

    def exhausts(self, bound: Field) -> bool:
        """Return True if torque and tangential force together are at or above the friction limit.

        All cells slip then (gross slip). Without friction the result is True.

        bound  friction limit µp (nx, ny)
        """
        if not np.any(bound):
            return True
        return bool(np.any(self.prescribed_forces)) and self.limit(bound)[0] <= 1 + AT_LIMIT

    def full_slip(self, bound: Field, motion: Vector) -> tuple[VectorField, Vector]:
        """Return the shear (2, nx, ny) in gross slip under torque and tangential force.

        Each cell carries the friction limit in the direction of the rigid motion of gross slip. The
        second result is the given rigid motion, because gross slip under force control does not
        determine its size. Without friction or without load the shear is zero.

        bound   friction limit µp (nx, ny)
        motion  rigid motion of the indenter, returned unchanged
        """
        if not np.any(bound) or not np.any(self.prescribed_forces):
            return np.zeros((2, *bound.shape)), motion
        loaded, units = self._loaded_cells(bound)
        speed = np.tensordot(self.limit(bound)[1], units, 1)
        q = np.zeros((2, *bound.shape))
        q[:, loaded] = bound[loaded] * speed / _blunt_size(speed)
        return q, motion

    def limit(self, bound: Field) -> tuple[float, Vector]:
        """Compute the ratio of the limit load to the prescribed load, and the motion of gross slip.

        At the limit load all cells slip. Force and torque are increased by one common factor.
        Newton's method minimises the power of friction over all rigid motions on which the load
        does unit work. The minimum is the ratio (upper-bound theorem of limit analysis). The motion
        (k,) is given in components along `units`.

        bound  friction limit µp (nx, ny)
        """
        loaded, units = self._loaded_cells(bound)
        limit = bound[loaded]
        start = self.prescribed_forces / np.sum(self.prescribed_forces**2)
        across = np.linalg.svd(self.prescribed_forces[None, :])[2][1:]
        if len(across) == 0:
            return float(limit @ magnitude(np.tensordot(start, units, 1))), start

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


def _friction_power(velocity: Vector, limit: Vector, units: Field) -> tuple[float, Vector, Field]:
    """Compute the power of friction in gross slip, with its gradient and Hessian.

    The power is the sum over the cells of friction limit times sliding speed. The limit load
    minimises this power over the rigid motions of the indenter.

    velocity  rigid motion, as components along the unit motions (k,)
    limit     friction limit of the loaded cells (n,)
    units     unit motions in the loaded cells (k, 2, n)
    """
    speed = np.tensordot(velocity, units, 1)
    size = _blunt_size(speed)
    weight = limit / size
    along = _unit_projections(units, speed) / size
    curvature = _unit_products(units, weight) - (along * weight) @ along.T
    return float(limit @ size), _resultant_forces(units, weight * speed), curvature


def _resultant_forces(units: Field, q: Field) -> Vector:
    """Compute tangential force and torque (k,) of a shear, divided by the cell area.

    units  unit rigid motions of the indenter in n cells (k, 2, n), to which the forces are
           conjugate
    q      shear of these cells (2, n)
    """
    return np.asarray(units.reshape(len(units), -1) @ q.ravel())


def _unit_projections(units: Field, vector: Field) -> Field:
    """Compute the scalar product of each unit rigid motion with a vector in each cell (k, n).

    units   unit rigid motions of the indenter in n cells (k, 2, n)
    vector  vector of each cell (2, n), such as the shear
    """
    return np.asarray(units[:, 0] * vector[0] + units[:, 1] * vector[1])


def _unit_products(units: Field, weight: Vector) -> Field:
    """Compute the matrix (k, k) of weighted scalar products of the unit rigid motions.

    The products are summed over cells. Used for the derivatives of force and torque with respect to
    the rigid motion.

    units   unit rigid motions of the indenter in n cells (k, 2, n)
    weight  weight of each cell (n,)
    """
    flat = units.reshape(len(units), -1)
    return np.asarray((units * weight).reshape(flat.shape) @ flat.T)


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


class _ShiftedMoments(ProjectedShear):
    """Projection of a shear y + Σ λ unit on the friction limit of the loaded cells, for given λ.

    The multipliers λ are those of prescribed torque and force. The defect is the difference between
    the forces of the projection and the prescribed forces. `ShearMoments` solves for the λ with
    zero defect.

    multiplier  multipliers λ (k,) of the prescribed forces
    y           shear of the loaded cells before the shift (2, n)
    limit       friction limit of these cells (n,)
    units       unit rigid motions in these cells (k, 2, n)
    given       prescribed forces and torque conjugate to the unit motions (k,)
    """

    def __init__(
        self, multiplier: Vector, y: Field, limit: Vector, units: Field, given: Vector
    ) -> None:
        super().__init__(y + np.tensordot(multiplier, units, 1), limit)
        self._units = units
        self.defect = _resultant_forces(units, self.q) - given

    def newton_step(self) -> Vector:
        """Compute the damped Newton step of the multipliers λ (k,) of torque and tangential force.

        The damping acts where all cells slip. It is relative to the stiffness of the cells, because
        the trace of the derivative vanishes where all cells slip along their motion.
        """
        along, products = (
            _unit_projections(self._units, self.z),
            _unit_products(self._units, self.scale),
        )
        matrix = products - (along * self.radial) @ along.T
        stiffness = float(np.trace(products))
        damping = 1e-3 * stiffness * (np.sum(np.abs(self.defect)) / self.capacity) ** 2
        return -np.linalg.solve(matrix + damping * np.eye(len(matrix)), self.defect)
