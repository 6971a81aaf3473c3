"""Points that represent different areas, as points of equal area.

The solver receives tractions, displacements, gap and friction limit multiplied by the root s of the
area over the mean area. Then the compliance is symmetric, and sums over points are integrals over
the surface.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_solver.conjugate_gradients import Map
from contact_solver.coupled_problem import CoupledProblem, Preconditioner
from contact_solver.dense_inverse import DenseInverse
from contact_solver.rigid_motion import RigidMotion, RigidMotions


@dataclass(frozen=True)
class UnequalAreas:
    """Areas of n points, with the conversion of a contact problem to points of equal area.

    areas  areas of the points (n,) [length^2]
    """

    areas: Vector

    @cached_property
    def mean(self) -> float:
        """Mean area of the points [length^2]."""
        return float(np.mean(self.areas))

    @cached_property
    def roots(self) -> Vector:
        """Roots s of the areas of the points over their mean (n,)."""
        return np.sqrt(self.areas / self.mean)

    def rigid_motion(
        self, shape: Field, reach: float, force: float | None, value: float | None
    ) -> RigidMotion:
        """Return a rigid motion, scaled to a displacement `reach` by the unit motion.

        shape  displacement of the points by the unit motion (c, n)
        reach  size of `shape`
        force  prescribed conjugate force; None where the motion is prescribed
        value  prescribed motion; None where the force is prescribed
        """
        scaled = self.roots * shape / reach
        if force is not None:
            return RigidMotion(scaled, force / (self.mean * reach))
        assert value is not None
        return RigidMotion(scaled, value=value * reach)

    def problem(
        self,
        product: Map,
        inverse: Preconditioner,
        dense: Callable[[], DenseInverse],
        own: Vector,
        gap: Vector,
        friction_limit: Callable[[Vector], Vector],
        friction_slope: Callable[[Vector], Vector],
        target: VectorField,
        closing: RigidMotion,
        shifting: tuple[RigidMotion, ...],
    ) -> CoupledProblem:
        """Return the problem of pressure and shear for points of equal area.

        product          compliance for points of equal area, from s t to s u, both (3, n)
        inverse          its inverse in zones of contact, stick and slip
        dense            function that returns its inverse from the matrix
        own              tangential displacement of a point by its own unit shear, for equal areas
        gap, target      undeformed gap (n,) and displacement that stick requires (2, n) [length]
        friction_limit   map from pressure (n,) to the largest shear (n,)
        friction_slope   map from pressure (n,) to the derivative of the largest shear (n,)
        closing          motion that reduces the gap
        shifting         tangential rigid motions
        """
        s, nothing = self.roots, np.zeros(len(self.roots))

        def by_pressure(p: Vector) -> Field:
            return product(np.stack([nothing, nothing, p]))

        def by_shear(q: VectorField) -> Field:
            return product(np.concatenate([q, nothing[None]]))

        return CoupledProblem(
            normal=lambda p: by_pressure(p)[2],
            tangential=lambda q: by_shear(q)[:2],
            normal_by_shear=lambda q: by_shear(q)[2],
            shear_by_pressure=lambda p: by_pressure(p)[:2],
            inverse_on=lambda contact: dense().on_contact(contact),
            inverse_in=lambda zones: dense().in_stick_and_slip(zones),
            together=product,
            inverse=inverse,
            gap=s * gap,
            friction_limit=lambda p: s * friction_limit(p / s),
            friction_slope=lambda p: friction_slope(p / s),
            target=s * target,
            closing=RigidMotions(1, (closing,)),
            shifting=RigidMotions(2, shifting),
            self_compliance=float(np.median(own)),
        )
