"""Gross slip: the limit load of friction, and the shear of points that all slip about one pole.

The forces and torques that friction can carry form a convex set. A load reaches its boundary when
all points slip with one rigid motion, which minimises the power of friction (upper-bound theorem of
limit analysis).
"""

from collections.abc import Callable

import numpy as np

from contact_scene.array_types import Matrix, Vector, VectorField
from contact_scene.friction_limit import reaches_limit
from contact_solver.admissible_shear import magnitude
from contact_solver.rigid_motion import MotionShapes, RigidMotions

MAX_STEPS = 100
# Smoothing of |speed| at the pole, relative to the largest speed.
BLUNT = 1e-8
# Relative decrease of the power of friction at which the iteration stops.
FLAT = 1e-15

# Decrease of the power of friction by all further steps, over that predicted for the next one.
# Predictions exceed decreases where the power is a cone.
FURTHEST = 10.0

Power = tuple[float, Vector, Matrix]


def exhausts_friction(motions: RigidMotions, bound: Vector) -> bool:
    """Return True if the prescribed forces together are at or above the friction limit.

    All points slip then (gross slip), and the rigid motion is undefined. Without friction the
    result is True.

    motions  rigid motions of the indenter
    bound    friction limit µp (n,)
    """
    if not np.any(bound):
        return True
    held = motions.held
    loaded = bool(np.any(held.prescribed_forces))
    return loaded and reaches_limit(1.0, limit_load(held, bound, enough=1.0)[0])


def full_slip(motions: RigidMotions, bound: Vector, motion: Vector) -> tuple[VectorField, Vector]:
    """Return the shear (2, n) and the rigid motions (k,) of the indenter in gross slip.

    Each point carries the friction limit in the direction of the motion of gross slip. A load below
    the limit reduces the shear by this part. Without friction or without prescribed forces the
    shear is zero.

    motions  rigid motions of the indenter
    bound    friction limit µp (n,)
    motion   rigid motions, of which the free ones are returned: gross slip does not determine them
    """
    motion = np.where(motions.is_free, motion, motions.values)
    held = motions.held
    if not (np.any(bound) and np.any(held.prescribed_forces)):
        return np.zeros((2, len(bound))), motion
    times, velocity = limit_load(held, bound)
    speed = held.displacement(velocity)
    return bound / max(1.0, times) * speed / _blunt_size(speed, bound), motion


def limit_load(held: RigidMotions, bound: Vector, enough: float = np.inf) -> tuple[float, Vector]:
    """Compute the ratio of the limit load to the prescribed load, and the motion of gross slip.

    At the limit load all points slip. All forces are increased by one common factor. Newton's
    method minimises the power of friction over all rigid motions on which the load does unit work.
    The minimum is the ratio (upper-bound theorem of limit analysis).

    held    motions with prescribed forces, not all zero
    bound   friction limit µp (n,)
    enough  ratio that the result only has to exceed: the iteration stops where it is certain to
    """
    forces = held.prescribed_forces
    start = forces / np.sum(forces**2)
    if len(held) == 1 or not len(held.shapes.varying):  # all points slip along the force
        return float(np.sum(bound * magnitude(held.displacement(start)))), start
    loaded = np.flatnonzero(bound > 0)
    units, limit = held.shapes.at(loaded), bound.take(loaded)
    across = np.linalg.svd(forces[None, :])[2][1:]

    def power_at(x: Vector) -> Power:
        return _friction_power(start + x @ across, limit, units)

    x = np.zeros(len(across))
    power, slope, curvature = power_at(x)
    for _ in range(MAX_STEPS):
        gradient = across @ slope
        inverse = np.linalg.pinv(across @ curvature @ across.T, rcond=1e-14, hermitian=True)
        step = -inverse @ gradient
        fall = -float(gradient @ step)
        if fall <= FLAT * power or power - FURTHEST * fall > enough:
            break
        x, (power, slope, curvature) = _descend(power_at, x, step, power, fall)
    return power, start + x @ across


def _friction_power(velocity: Vector, limit: Vector, units: MotionShapes) -> Power:
    """Compute the power of friction Σ (limit times speed) with its gradient and Hessian.

    The limit load minimises this power over the rigid motions of the indenter.

    velocity  rigid motion, as components along the unit motions (k,)
    """
    speed = units.displacement(velocity)
    size = _blunt_size(speed, limit)
    weight = limit / size
    along = units.along(speed) / size
    curvature = units.products(weight) - (along * weight) @ along.T
    return float(np.sum(limit * size)), units.forces(weight * speed), curvature


def _blunt_size(speed: VectorField, limit: Vector) -> Vector:
    """Compute the speed of the points (n,), smoothed near the centre of rotation,
    where its derivative does not exist. Points with friction define the largest speed."""
    size = magnitude(speed)
    return np.hypot(size, BLUNT * np.max(size * (limit > 0)))


def _descend(
    power_at: Callable[[Vector], Power], x: Vector, step: Vector, power: float, fall: float
) -> tuple[Vector, Power]:
    """Apply a Newton step, bisected until the power of friction decreases sufficiently (Armijo).

    Return the accepted position with its power, gradient and Hessian. `fall` is the decrease that
    the gradient predicts.
    """
    part = 1.0
    while True:
        there = power_at(x + part * step)
        if there[0] <= power - 0.1 * part * fall or part < 1e-9:
            return x + part * step, there
        part *= 0.5
