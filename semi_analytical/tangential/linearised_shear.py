"""Tangential problem in given stick and slip zones, by projected conjugate gradients.

Rigid motions of prescribed force are additional unknowns, and all iterates preserve these forces.
Where all cells slip in one direction, the force along this direction cannot be preserved: the
pseudo-inverse leaves it to the exact projection.
"""

from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field, VectorField
from semi_analytical.tangential.admissible_shear import TangentialLoad
from semi_analytical.tangential.shear_zones import (
    Map,
    ShearZones,
)

MAX_ITERATIONS = 100
# Relative singular value below which the zones do not determine a force.
UNDETERMINED = 1e-12


class Point(NamedTuple):
    """Iterate of the tangential problem: a shear and the tangential displacement that it causes.

    shear         q (2, nx, ny) [force/length^2]
    displacement  tangential displacement by the shear (2, nx, ny) [length]
    """

    shear: VectorField
    displacement: VectorField


class LinearisedShear:
    """Tangential problem under a load, linearised in given stick and slip zones.

    Newton's method solves this linear problem in each step.

    displace, inverse  map from shear to displacement and its approximate inverse, see
                       `tangential_problem.solve_tangential`
    zones              stick and slip zones of an iterate
    load               prescribed tangential load
    carriers           shears (2, nx, ny) that change the prescribed forces in these zones, one per
                       force
    """

    def __init__(
        self,
        displace: Map,
        inverse: Map,
        zones: ShearZones,
        load: TangentialLoad,
        carriers: list[VectorField] | None = None,
    ) -> None:
        """Compute the carriers: shears in the given zones that change the prescribed forces.

        Combinations of the carriers correct the forces of an iterate.

        carriers  carriers of another iterate with the same zones, which are reused; None to compute
                  them
        """
        self._displace, self._inverse, self._zones, self._load = displace, inverse, zones, load
        if carriers is None:
            units = load.free_motions(zones.sliding_shear.shape)
            self.carriers = [zones.precondition(zones.free(unit), inverse) for unit in units]
        else:
            self.carriers = [zones.free(carrier) for carrier in carriers]
        responses = np.array([load.forces(carrier) for carrier in self.carriers])
        count = len(self.carriers)
        self._shares = np.linalg.pinv(responses.reshape(count, count).T, rcond=UNDETERMINED)

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """Return a shear near q that is within the friction limit and has the prescribed forces.

        Slipping cells receive the friction limit along their slip, sticking cells keep the shear.
        The result is then corrected to the prescribed forces and projected. If all cells slip, it
        is the projection of the natural map and has the prescribed forces: a correction by equal
        shears would move all cells inside the friction limit, and near gross slip Newton's method
        would stagnate.

        q      shear (2, nx, ny)
        bound  friction limit µp (nx, ny)
        """
        near = np.where(self._zones.slip, self._zones.sliding_shear, q)
        self._correct_forces(self._load.prescribed_forces - self._load.forces(near), near)
        return self._load.admissible(near, bound)

    def solve_in_zones(self, base: Point, slipped: VectorField, depth: float) -> tuple[Point, int]:
        """Solve the tangential problem in fixed stick and slip zones by conjugate gradients.

        Return the shear with its displacement, and the number of iterations.

        base     starting point: shear and its displacement
        slipped  slip at the starting point (2, nx, ny) [length]: rigid motion plus the displacement
                 that stick requires minus the actual displacement
        depth    reduction of the residual norm at which the iteration stops
        """
        zones = self._zones
        q, u = base.shear.copy(), base.displacement.copy()
        r = zones.free(slipped - zones.slip_compliance * q)
        t = z = self._precondition(r)
        rz = first = float(np.sum(r * z))
        iterations = 0
        while rz > depth**2 * first and iterations < MAX_ITERATIONS:
            iterations += 1
            A_t = self._displace(t)
            H_t = zones.free(A_t) + zones.slip_compliance * t
            step = rz / float(np.sum(t * H_t))
            q += step * t
            u += step * A_t
            r -= step * H_t
            z = self._precondition(r)
            rz, last = float(np.sum(r * z)), rz
            t = z + (rz / last) * t
        return Point(q, u), iterations

    def _precondition(self, v: VectorField) -> VectorField:
        """Apply the preconditioner to a residual, and correct the result to zero prescribed forces.

        The conjugate gradients then keep the forces of the shear constant.

        v  residual displacement (2, nx, ny) [length]
        """
        free = self._zones.precondition(v, self._inverse)
        self._correct_forces(-self._load.forces(free), free)
        return free

    def _correct_forces(self, forces: Field, free: VectorField) -> None:
        """Change the prescribed forces of a shear by given amounts, in place.

        A combination of the carriers is added. Carriers are the shears that change the prescribed
        forces in the present stick and slip zones.

        forces  required change of the forces (k,), divided by the cell area
        free    shear that is changed (2, nx, ny)
        """
        for share, carrier in zip(self._shares @ forces, self.carriers, strict=True):
            free += share * carrier
