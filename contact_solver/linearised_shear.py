"""Tangential problem in given stick and slip zones, by projected conjugate gradients.

Rigid motions of prescribed force are additional unknowns, and all iterates preserve these forces.
Where all points slip in one direction, the force along this direction cannot be preserved: the
pseudo-inverse leaves it to the exact projection.
"""

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_solver.admissible_shear import admissible_shear
from contact_solver.conjugate_gradients import Map, Point, solve_in_zones
from contact_solver.rigid_motion import RigidMotions
from contact_solver.shear_zones import ShearZones

MAX_ITERATIONS = 100
# Relative singular value below which the zones do not determine a force.
UNDETERMINED = 1e-12


class LinearisedShear:
    """Tangential problem under a load, linearised in given stick and slip zones.

    Newton's method solves this linear problem in each step.

    displace  map from shear to displacement
    inverse   approximate inverse of the derivative in the zones, from and to free components
    zones     stick and slip zones of an iterate
    motions   rigid motions of the indenter
    carriers  shears (2, n) that change the prescribed forces in these zones, one per force
    """

    def __init__(
        self,
        displace: Map,
        inverse: Map,
        zones: ShearZones,
        motions: RigidMotions,
        carriers: list[VectorField] | None = None,
    ) -> None:
        """Compute the carriers: shears in the given zones that change the prescribed forces.

        Combinations of the carriers correct the forces of an iterate.

        carriers  carriers of another iterate with the same zones, which are reused; None to compute
                  them
        """
        self._displace, self._inverse, self._zones = displace, inverse, zones
        self._motions, self._held = motions, motions.held
        if carriers is None:
            shape = zones.sliding_shear.shape
            units = (np.broadcast_to(one.shape, shape) for one in self._held.each)
            self.carriers = [inverse(zones.free(unit)) for unit in units]
        else:
            self.carriers = [zones.free(carrier) for carrier in carriers]
        count = len(self.carriers)
        responses = np.array([self._held.forces(carrier) for carrier in self.carriers])
        self._shares = np.linalg.pinv(responses.reshape(count, count).T, rcond=UNDETERMINED)

    def admissible(self, q: VectorField, bound: Vector) -> VectorField:
        """Return a shear near q that is within the friction limit and has the prescribed forces.

        Slipping points receive the friction limit along their slip, sticking points keep the shear.
        The result is then corrected to the prescribed forces and projected. If all points slip, it
        is the projection of the natural map and has the prescribed forces: a correction by equal
        shears would move all points inside the friction limit, and near gross slip Newton's method
        would stagnate.

        q      shear (2, n)
        bound  friction limit µp (n,)
        """
        near = np.where(self._zones.slip, self._zones.sliding_shear, q)
        self._correct_forces(self._held.prescribed_forces - self._held.forces(near), near)
        return admissible_shear(self._motions, near, bound)

    def solve(self, base: Point, slipped: VectorField, depth: float) -> tuple[Point, int]:
        """Solve the tangential problem in fixed stick and slip zones by conjugate gradients.

        Return the shear with its displacement, and the number of iterations.

        base     starting point: shear and its displacement
        slipped  slip at the starting point (2, n) [length]: rigid motion plus the displacement that
                 stick requires minus the actual displacement
        depth    reduction of the residual norm at which the iteration stops
        """
        zones = self._zones
        return solve_in_zones(
            self._displace,
            lambda d, d_u: zones.free(d_u) + zones.slip_compliance * d,
            self._precondition,
            base,
            zones.free(slipped - zones.slip_compliance * base.tractions),
            depth,
            MAX_ITERATIONS,
        )

    def _precondition(self, v: VectorField) -> VectorField:
        """Apply the preconditioner to a residual, and correct the result to zero prescribed forces.

        The conjugate gradients then keep the forces of the shear constant.

        v  residual displacement (2, n) [length]
        """
        free = self._inverse(v)
        self._correct_forces(-self._held.forces(free), free)
        return free

    def _correct_forces(self, forces: Field, free: VectorField) -> None:
        """Change the prescribed forces of a shear by given amounts, in place.

        A combination of the carriers is added. Carriers are the shears that change the prescribed
        forces in the present stick and slip zones.

        forces  required change of the forces (k,)
        free    shear that is changed (2, n)
        """
        for share, carrier in zip(self._shares @ forces, self.carriers, strict=True):
            free += share * carrier
