"""The shear problem linearised in its zones of stick and slip, and its solution.

Free rigid motions, whose forces are given, are unknowns beside the shear, and all shears keep these
forces. Where everything slips one way the force along it cannot be kept (the pseudo-inverse says
so) and is left to the exact projection.
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
# Of the given forces: what a zone that slips one way does not determine.
UNDETERMINED = 1e-12


class Point(NamedTuple):
    """A shear and its displacement, each (2, nx, ny)."""

    shear: VectorField
    displacement: VectorField


class LinearisedShear:
    """The derivative in given zones under a load.

    displace, inverse  see `tangential_problem.solve_tangential`
    carriers           shears (2, nx, ny) by which the load is carried in these zones
    """

    def __init__(
        self,
        displace: Map,
        inverse: Map,
        zones: ShearZones,
        load: TangentialLoad,
        carriers: list[VectorField] | None = None,
    ) -> None:
        """carriers  of the load, from the same zones at another point"""
        self._displace, self._inverse, self._zones, self._load = displace, inverse, zones, load
        if carriers is None:
            units = load.free_motions(zones.pulled.shape)
            self.carriers = [zones.preconditioned(zones.free(unit), inverse) for unit in units]
        else:
            self.carriers = [zones.free(carrier) for carrier in carriers]
        responses = np.array([load.forces(carrier) for carrier in self.carriers])
        count = len(self.carriers)
        self._shares = np.linalg.pinv(responses.reshape(count, count).T, rcond=UNDETERMINED)

    def admissible(self, q: VectorField, bound: Field) -> VectorField:
        """A shear near q in the zones that friction allows and that carries the load."""
        near = self._zones.pulled + self._zones.free(q)
        self._carry(self._load.given - self._load.forces(near), near)
        return self._load.admissible(near, bound)

    def solved(self, base: Point, slipped: VectorField, depth: float) -> tuple[Point, int]:
        """Where the linearised problem is solved, but for the part `depth` of what it does not
        fulfil at the base; and the iterations. By conjugate gradients.

        slipped  ω + c - u at the base (2, nx, ny)
        """
        zones = self._zones
        q, u = base.shear.copy(), base.displacement.copy()
        r = zones.free(slipped - zones.turning * q)
        t = z = self._preconditioned(r)
        rz = first = float(np.sum(r * z))
        iterations = 0
        while rz > depth**2 * first and iterations < MAX_ITERATIONS:
            iterations += 1
            A_t = self._displace(t)
            H_t = zones.free(A_t) + zones.turning * t
            step = rz / float(np.sum(t * H_t))
            q += step * t
            u += step * A_t
            r -= step * H_t
            z = self._preconditioned(r)
            rz, last = float(np.sum(r * z)), rz
            t = z + (rz / last) * t
        return Point(q, u), iterations

    def _preconditioned(self, v: VectorField) -> VectorField:
        """Roughly the free shear, without any given force, that displaces by v and a rigid
        motion."""
        free = self._zones.preconditioned(v, self._inverse)
        self._carry(-self._load.forces(free), free)
        return free

    def _carry(self, forces: Field, free: VectorField) -> None:
        """Let a free shear carry so much more."""
        for share, carrier in zip(self._shares @ forces, self.carriers, strict=True):
            free += share * carrier
