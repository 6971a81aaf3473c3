"""Surface displacements of both bodies by axisymmetric pressure and radial shear, as matrices.

Used for the contact with friction under a normal load. The contact radius is arbitrary.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import NamedTuple

import numpy as np

from contact_scene import Scene
from contact_scene.array_types import Array
from radial.frictional.rings import Rings
from radial.normal.disc import Disc
from radial.normal.surface import half_mean_pressure
from radial.response.bodies import (
    Bodies,
    layer_responses,
)
from semi_analytical.frf.stack import Stack, stack_of


class RingResponse(NamedTuple):
    """Compliance matrices of both bodies between rings of an axisymmetric contact [length³/force].

    Rows are the positions of displacements: nodes of the radius, then points outside the contact.
    Columns are the nodes with tractions. Displacements are those of the lower body relative to the
    indenter.

    zz  normal displacement into the lower body, by pressure
    zr  normal displacement into the lower body, by radial shear
    rz  radial displacement by pressure
    rr  radial displacement by radial shear
    """

    zz: Array
    zr: Array
    rz: Array
    rr: Array


@dataclass(frozen=True)
class Coupling:
    """Elastic response of the surfaces of both bodies to pressure and shear, with their coupling.

    Displacements are those of the lower body relative to the indenter. Direct responses (normal by
    pressure, tangential by shear) of both bodies add. Coupling responses (normal by shear,
    tangential by pressure) subtract.

    bodies   normal response of both bodies
    stacks   each body with layers, with the sign of its coupling response: 1 for the lower body, -1
             for the indenter
    direct   Σ (1-ν)/G of the outermost materials [length²/force]
    across   Σ 1/G of the outermost materials [length²/force]
    crossed  Σ ± (1-2ν)/2G of the outermost materials, plus for the lower body, minus for the
             indenter [length²/force]
    """

    bodies: Bodies
    stacks: tuple[tuple[Stack, float], ...]
    direct: float
    across: float
    crossed: float

    @classmethod
    def of(cls, scene: Scene) -> Coupling:
        """Create the elastic response of the surfaces of both bodies to pressure and shear.

        scene  contact problem, which gives the materials and layers of both bodies
        """
        stacks = ((stack_of(scene.body), 1.0), (stack_of(scene.indenter), -1.0))
        outer = [(stack.outer, sign) for stack, sign in stacks if not stack.is_rigid]
        return cls(
            Bodies.of(scene),
            tuple((stack, sign) for stack, sign in stacks if stack.layers),
            sum((1 - nu) / G for (G, nu), _ in outer),
            sum(1 / G for (G, _), _ in outer),
            sum(sign * (1 - 2 * nu) / (2 * G) for (G, nu), sign in outer),
        )

    def response(self, rings: Rings, radius: float) -> RingResponse:
        """Compute the compliance matrices between the rings of a contact with given radius.

        The responses of half-spaces of the outermost materials have closed forms or quadratures.
        Layers add u = ∫ k F t~ J dk, with the frequency response F, the transform t~ of the
        traction and a Bessel function J.

        rings   nodes along the radius of the contact, and points outside
        radius  contact radius [length]
        """
        by_pressure, by_shear = rings.direct_responses
        shear_lifts, pressure_draws = rings.coupling_responses
        direct, crossed = self.direct * radius, -self.crossed * radius
        zz, rr = direct * by_pressure, direct * by_shear
        zr, rz = crossed * shear_lifts, crossed * pressure_draws
        if self.bodies.layered:
            waves = self.bodies.waves(radius)
            p, q, at_zeroth, at_first = rings.transforms(waves)
            c11, c12, c22, _ = radius * waves.rule[1] * layer_responses(self.stacks, waves, radius)
            zz, rr = zz + (at_zeroth * c22) @ p, rr + (at_first * c11) @ q
            zr, rz = zr - (at_zeroth * c12) @ q, rz - (at_first * c12) @ p
        return RingResponse(zz, zr, rz, rr)

    def frictionless_displacement(self, contact: Disc, rings: Rings) -> Array:
        """Compute the radial surface displacement by the pressure without friction [length].

        The displacement is that of the lower body relative to the indenter, at the nodes of the
        rings and at points outside the contact (rows,). It is the displacement against which
        friction acts.

        contact  frictionless contact, which gives the pressure
        rings    nodes along the radius of the contact, and points outside
        """
        a, x = contact.radius, rings.places
        found = -self.crossed * a * x * half_mean_pressure(contact, x)
        if self.bodies.layered:
            waves = self.bodies.waves(a)
            transform = contact.bodies.modulus / pi * contact.wave_transform(waves)
            c12 = waves.rule[1] * layer_responses(self.stacks, waves, a)[1]
            found -= rings.transforms(waves)[3] @ (c12 * transform)
        return np.asarray(found)
