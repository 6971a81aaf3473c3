"""Tangential problem in given stick and slip zones, by projected conjugate gradients.

Rigid motions of prescribed force are additional unknowns, and all iterates preserve these forces.
Where all points slip in one direction, the force along this direction cannot be preserved: the
pseudo-inverse leaves it to the exact projection.
"""

import numpy as np

from contact_scene.array_types import Matrix, Vector, VectorField
from contact_solver.admissible_shear import admissible_shear
from contact_solver.conjugate_gradients import Map, Point, solve_in_zones
from contact_solver.rigid_motion import RigidMotions
from contact_solver.zones import Zones

MAX_ITERATIONS = 100
# Relative singular value below which the zones do not determine a force.
UNDETERMINED = 1e-12


class LinearisedShear:
    """Tangential problem under a load, linearised in given stick and slip zones.

    Newton's method solves this linear problem in each step.

    displace  map from shear to displacement
    inverse   approximate inverse of the derivative in the zones, of rows (k, size)
    zones     stick and slip zones of an iterate
    motions   rigid motions of the indenter
    carriers  shears that change the prescribed forces in these zones (k, size), one row per force
    """

    def __init__(
        self,
        displace: Map,
        inverse: Map,
        zones: Zones,
        motions: RigidMotions,
        carriers: Matrix | None = None,
    ) -> None:
        """Compute the carriers: shears in the given zones that change the prescribed forces.

        Combinations of the carriers correct the forces of an iterate.

        carriers  carriers in similar zones; None to compute them
        """
        self._displace, self._inverse, self.zones = displace, inverse, zones
        self._motions, self._held, shape = motions, motions.held, (2, zones.contact.size)
        units = [zones.free(np.broadcast_to(one.shape, shape)) for one in self._held.each]
        self._units = np.array(units).reshape(len(units), zones.size)
        self.carriers = inverse(self._units) if carriers is None else carriers
        responses = np.einsum("ki,ji->kj", self._units, self.carriers)
        self._shares = np.linalg.pinv(responses, rcond=UNDETERMINED)

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
        zones, near = self.zones, q.copy()
        near[:, zones.slip] = bound[zones.slip] * zones.normal
        missing = self._held.prescribed_forces - self._held.forces(near)
        near += zones.field(self._change_of_forces(missing))
        return admissible_shear(self._motions, near, bound)

    def solve(self, base: Point, slipped: VectorField, depth: float) -> tuple[Point, int]:
        """Solve the tangential problem in fixed stick and slip zones by conjugate gradients.

        Return the shear with its displacement, and the number of iterations.

        base     starting point: shear and its displacement
        slipped  slip at the starting point (2, n) [length]: rigid motion plus the displacement that
                 stick requires minus the actual displacement
        depth    reduction of the residual norm at which the iteration stops
        """
        zones = self.zones
        change, u, iterations = solve_in_zones(
            lambda d: self._displace(zones.field(d)),
            lambda d, d_u: zones.free(d_u) + zones.slip_terms(d),
            self._precondition,
            zones.free(slipped) - zones.slip_terms(zones.free(base.tractions)),
            depth,
            MAX_ITERATIONS,
        )
        return Point(base.tractions + zones.field(change), base.displacements + u), iterations

    def _precondition(self, rows: Vector) -> Vector:
        """Apply the preconditioner, and correct the result to zero prescribed forces,
        which conjugate gradients then keep constant."""
        free = self._inverse(rows[None])[0]
        forces = np.einsum("ki,i->k", self._units, free)
        return np.asarray(free - self._change_of_forces(forces))

    def _change_of_forces(self, forces: Vector) -> Vector:
        """Return the combination of carriers (size,) that changes the forces by `forces`."""
        return np.einsum("k,ki->i", self._shares @ forces, self.carriers)
