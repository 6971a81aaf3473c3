"""Projection on the shears that Coulomb's friction law admits.

A shear is admissible if |q| <= bound (friction limit) at every point and if it has the prescribed
force and torque. Every iterate is projected exactly on this convex set. The rigid motions of the
indenter, shift and twist, are the multipliers (see multipliers.py).
"""

from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.friction_limit import reaches_limit
from contact_solver.multipliers import find_multiplier
from contact_solver.rigid_motion import MotionShapes, RigidMotions

# Rounding error of a sum of shears, relative to the sum of their magnitudes.
ROUND_OFF = 1e-14
# Relative rounding error of the multiplier, which shifts the shear of all sticking points.
MULTIPLIER_ROUND_OFF = 5e-16


class NaturalShear(NamedTuple):
    """Value of the friction law, written as a natural map q -> P(z), at a shear q.

    P is the projection on the admissible shears: within the friction limit and with the prescribed
    forces. The shear is a solution of the tangential problem if P(z) = q.

    z          q + γ (ω + c - u) (2, n): ω rigid motion, c displacement that stick requires, u
               displacement, γ a stiffness
    projected  P(z) (2, n)
    slipped    slip ω + c - u of the indenter relative to the body (2, n) [length]
    motion     rigid motions ω (k,)
    error      residual Σ|q - P(z)| / Σ bound
    """

    z: VectorField
    projected: VectorField
    slipped: VectorField
    motion: Vector
    error: float


def natural_shear(
    motions: RigidMotions,
    q: VectorField,
    apart: VectorField,
    bound: Vector,
    gamma: float,
    motion: Vector,
) -> NaturalShear:
    """Evaluate the friction law, written as a natural map q -> P(z), at a shear q.

    Semismooth Newton methods use the natural map. z is q + γ times the slip, and P is the
    projection on the admissible shears. The shear is a solution if P(z) = q. With a spring, z has
    the motion of the contact that is in equilibrium with the spring, and the slip has that of the
    present extension. The two motions are equal in a solution.

    motions  rigid motions of the indenter
    q        shear (2, n)
    apart    displacement that stick requires minus actual displacement (2, n) [length]
    bound    friction limit µp (n,)
    gamma    γ, inverse self-compliance of a point or a patch of points [force/length^3]
    motion   initial guess of the rigid motions (k,)
    """
    y, springs = q + gamma * apart, motions.springs
    if springs.any():
        extension = springs * motions.forces(q)
        y = y + gamma * motions.displacement(extension)
        motion = np.where(springs > 0, motions.values, motion) - extension
    projected, reached = project_trial(motions, y, bound, gamma, motion)
    z = y + gamma * motions.displacement(reached)
    motion = np.where(springs > 0, motions.values, reached)
    slipped = apart + motions.displacement(motion)
    error = float(magnitude(projected - q).sum() / bound.sum())
    return NaturalShear(z, projected, slipped, motion, error)


def project_trial(
    motions: RigidMotions, y: VectorField, bound: Vector, gamma: float, motion: Vector
) -> tuple[VectorField, Vector]:
    """Compute the admissible shear nearest to a trial shear, and the rigid motions.

    The shear is q = P(y + γ Σ m R), with P the projection on |q| <= bound. The free motions are
    chosen so that q has the prescribed forces. With a spring, the motion is that of the contact in
    equilibrium with the spring: the force of the previous iterate would convert every change of the
    shift into slip. Equilibrium requires F(q) + m/c = v/c, with the prescribed motion v and the
    spring compliance c.

    motions  rigid motions of the indenter
    y        trial shear without the rigid motion (2, n) [force/length^2]
    bound    friction limit µp (n,)
    gamma    γ, traction per displacement [force/length^3]
    motion   initial guess of the rigid motions (k,)
    """
    is_free, found = motions.is_free, motions.values.copy()
    if not is_free.all():
        found[is_free] = 0.0
        y = y + gamma * motions.displacement(found)
    forces, stiffness = _forces_in_equilibrium(motions.free, gamma)
    q, multiplier = _project(motions.free, y, bound, forces, stiffness, gamma * motion[is_free])
    found[is_free] = multiplier / gamma
    return q, found


def _forces_in_equilibrium(free: RigidMotions, gamma: float) -> tuple[Vector, Vector]:
    """Return the forces (k,) that free motions require, and the stiffness of springs over γ (k,);
    without a spring, the prescribed force and 0."""
    forces = [one.value / one.spring if one.force is None else one.force for one in free.each]
    stiffness = [1 / (gamma * one.spring) if one.force is None else 0.0 for one in free.each]
    return np.array(forces), np.array(stiffness)


def admissible_shear(motions: RigidMotions, q: VectorField, bound: Vector) -> VectorField:
    """Return the shear nearest to a given one that has the prescribed forces, within friction.

    With a spring the force of the shear is kept if friction can carry it: under a soft spring its
    change would mean a large change of the motion.

    motions  rigid motions of the indenter
    q        given shear (2, n)
    bound    friction limit µp (n,)
    """
    free = motions.free
    present = free.forces(q)
    forces = np.where(free.is_held, [one.force or 0.0 for one in free.each], present)
    if free.springs.any() and reaches_limit(float(np.linalg.norm(forces)), float(bound.sum())):
        return project_on_discs(q, bound)
    return _project(free, q, bound, forces, np.zeros(len(free)))[0]


def _project(
    free: RigidMotions,
    y: VectorField,
    bound: Vector,
    forces: Vector,
    stiffness: Vector,
    guess: Vector | None = None,
) -> tuple[VectorField, Vector]:
    """Compute the shear with given forces nearest to a given one, and the multipliers.

    The multipliers (k,) are tractions per unit motion that are added before the projection on the
    friction limit.

    free       free rigid motions
    y          given shear (2, n) [force/length^2]
    bound      friction limit µp (n,)
    forces     required forces (k,)
    stiffness  stiffness of springs, over γ (k,)
    guess      initial guess of the multipliers (k,); None for an estimate without friction
    """
    if not len(free):
        return project_on_discs(y, bound), np.zeros(0)
    loaded = np.flatnonzero(bound > 0)  # points that can carry shear
    units, of_loaded, limit = free.shapes.at(loaded), y.take(loaded, axis=1), bound.take(loaded)
    if guess is None:
        guess = (forces - units.forces(of_loaded)) / np.diag(units.products(np.ones(len(limit))))
    shifted, multiplier = find_multiplier(
        lambda m: _ProjectedShear(m, of_loaded, limit, units, forces, stiffness), guess
    )
    q = np.zeros_like(y)
    for component, values in zip(q, shifted.q, strict=True):
        component[loaded] = values
    return q, multiplier


def magnitude(v: VectorField) -> Field:
    """Compute the length of each two-component vector of a field (2, ...), such as the shear."""
    return np.sqrt(v[0] * v[0] + v[1] * v[1])


def project_on_discs(y: VectorField, bound: Field) -> VectorField:
    """Scale the shear of each point to the friction limit where the shear exceeds this limit.

    The direction of the shear is preserved. The operation is the projection on the friction discs
    |q| <= bound.

    y      shear (2, ...) [force/length^2]
    bound  friction limit µp (...)
    """
    length = magnitude(y)
    return np.asarray(y * np.where(length > bound, bound / np.where(length > 0, length, 1.0), 1.0))


class _ProjectedShear:
    """Projection of a shear z = y + Σ λ R on the friction limit of loaded points, for given λ.

    The multipliers λ are those of the prescribed forces. `_project` solves for the λ whose
    projected shear q has these forces (see multipliers.py).

    multiplier  multipliers λ (k,) of the prescribed forces
    y           shear of the loaded points before the shift (2, n)
    bound       friction limit of these points (n,)
    units       free rigid motions R of these points
    given       prescribed forces conjugate to the unit motions (k,)
    stiffness   stiffness of springs, over γ (k,): the forces then include stiffness λ
    """

    def __init__(
        self,
        multiplier: Vector,
        y: Field,
        bound: Vector,
        units: MotionShapes,
        given: Vector,
        stiffness: Vector,
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
        response = self._scale.sum() + self._stiffness.max(initial=0.0)
        blur = MULTIPLIER_ROUND_OFF * response * np.abs(multiplier).sum()
        strength = (self._length * self._scale).sum()
        return bool(np.abs(self.defect).sum() <= ROUND_OFF * strength + blur)

    def newton_step(self) -> Vector:
        """Compute the damped Newton step of the multipliers λ (k,) of the prescribed forces.

        The derivative of the projection at a point is the matrix scale - w z zᵀ, with w = 0 within
        the friction limit. The derivative of the forces is singular if all points slip along their
        motion. The damping is relative to its part by `scale`, which does not vanish then.
        """
        along = self._units.along(self._z)
        products = self._units.products(self._scale)
        outside = self._length > self._bound
        radial = outside * self._scale / np.maximum(self._length, self._bound) ** 2
        matrix = products - (along * radial) @ along.T
        damping = products.trace() * (np.abs(self.defect).sum() / self._bound.sum()) ** 2
        matrix += np.diag(1e-3 * damping + self._stiffness)
        return -np.linalg.solve(matrix, self.defect)
