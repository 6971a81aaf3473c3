"""Estimates of the radius and of the number of wavenumbers of the largest contact of a scene.

They are made before the solve, for the estimate of its memory.
"""

from __future__ import annotations

from functools import lru_cache

from contact_scene import Scene
from radial.normal.disc import polynomial_count
from radial.normal.pressing import normal_contact
from radial.normal.profile import profile
from radial.output_points import largest_targets
from radial.response.bodies import Bodies
from radial.response.wavenumbers import POINTS

# FEW_ORDERS: number of polynomials that gives the contact radius to about 1 %. NEAR: relative error
# of force or approach at which the iteration ends.
FEW_ORDERS = 16
NEAR = 0.05


@lru_cache(maxsize=8)
def wavenumbers(scene: Scene) -> int:
    """Estimate the number of wavenumbers needed for the layers at the largest contact of a scene.

    The memory of the solve increases with this number. The estimate is made before the solve. At
    least one body must have layers. Raises UnsupportedScene if the contact radius is too large for
    the thickness of the layers.

    scene  contact problem
    """
    bodies, radius = Bodies.of(scene), expected_radius(scene)
    polynomial_count(bodies.thickness / radius, profile(scene.indenter, radius).apex)
    chosen = bodies.waves(radius)
    return POINTS * (chosen.equal - chosen.first)


def expected_radius(scene: Scene) -> float:
    """Estimate the radius of the largest contact of the load history, without friction [length].

    The frictionless contact is solved with few polynomials, which give the radius to a few percent.
    Used before the solve, for cost estimates.

    scene  contact problem
    """
    return max(
        normal_contact(Bodies.of(scene), scene.indenter, target, 1, FEW_ORDERS, NEAR).contact.radius
        for target in largest_targets(scene)
    )
