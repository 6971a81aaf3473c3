"""Projection on the pressures without tension that have prescribed forces and moments.

The rigid motions of prescribed force are the multipliers (see multipliers.py).
"""

from functools import partial

import numpy as np

from contact_scene.array_types import Mask, Vector
from contact_scene.solver_errors import NotConverged
from contact_solver.multipliers import MAX_SWEEPS, find_multiplier
from contact_solver.rigid_motion import RigidMotions

# Rounding error of a sum of pressures and of its moments, relative to the sum.
ROUND_OFF = 1e-14


def admissible_pressure(held: RigidMotions, p: Vector, allowed: Mask) -> Vector:
    """Return a non-negative pressure near a given one with the prescribed forces.

    Negative values are set to zero, and the pressure is scaled to the normal force, the force of a
    motion that closes the gap at every point. Other forces are met by a combination of the motions,
    weighted by the pressure. If the loaded points cannot carry the forces, it is added with equal
    weight to all allowed points.

    held     rigid motions with a prescribed force, the approach first if it is among them
    p        given pressure (n,)
    allowed  points that may carry pressure (n,)
    raises   NotConverged without pressure, and where none has the prescribed forces
    """
    p = np.maximum(p, 0.0)
    if not len(held):
        return p
    if np.all(held.each[0].shape > 0):
        carried = held.forces(p[None])[0]
        if not carried > 0:
            raise NotConverged("the normal force", 0, np.inf, 0.0)
        p = p * (held.prescribed_forces[0] / carried)
        if len(held) == 1:
            return p
    for weight in (p, allowed * np.mean(p)):
        shifted, multiplier = find_multiplier(
            partial(_ShiftedPressure, p, weight, held), np.zeros(len(held))
        )
        if shifted.has_prescribed_forces(multiplier):
            return shifted.p
    raise NotConverged("the pressure under its moments", MAX_SWEEPS, np.inf, ROUND_OFF)


class _ShiftedPressure:
    """Projected pressure max(0, p + weight Σ λ R) for given multipliers λ of the forces.

    p           given pressure (n,)
    weight      weight of the correction of each point (n,)
    held        motions R with prescribed forces
    multiplier  multipliers λ (k,)
    """

    def __init__(self, p: Vector, weight: Vector, held: RigidMotions, multiplier: Vector) -> None:
        shifted = p + weight * held.displacement(multiplier)[0]
        pressed = (shifted > 0) & (weight > 0)
        self.p, self._slack = np.where(pressed, shifted, 0.0), np.where(pressed, weight, 0.0)
        self._held = held
        self.defect = held.forces(self.p[None]) - held.prescribed_forces

    def has_prescribed_forces(self, multiplier: Vector) -> bool:
        """Return True if the pressure has the prescribed forces up to round-off.

        multiplier  not used
        """
        size = float(np.sum(self.p)) + float(np.max(np.abs(self._held.prescribed_forces)))
        return bool(np.sum(np.abs(self.defect)) <= ROUND_OFF * size)

    def newton_step(self) -> Vector:
        """Compute the Newton step of the multipliers (k,) of the forces.

        The shortest step is taken where they are not unique.
        """
        metric = self._held.shapes.products(self._slack)
        return np.asarray(-np.linalg.pinv(metric, rcond=1e-14, hermitian=True) @ self.defect)
