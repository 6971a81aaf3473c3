"""Estimates of the radius and of the number of wavenumbers of the largest contact of a scene.

They are made before the solve, for the estimate of its memory.
"""

from __future__ import annotations

from functools import lru_cache
from math import exp, log

from contact_scene import Scene
from radial.normal.disc import (
    disc,
    orders,
)
from radial.normal.pressing import (
    Target,
    first_radius,
)
from radial.normal.profile import profile
from radial.output_points import largest_targets
from radial.response.bodies import Bodies
from radial.response.wavenumbers import POINTS

# FEW_ORDERS: number of polynomials that gives the contact radius to about 1 %. TRIED: largest
# number of secant steps. NEAR: relative step at which the iteration ends.
FEW_ORDERS, TRIED, NEAR = 16, 12, 0.02


@lru_cache(maxsize=8)
def wavenumbers(scene: Scene) -> int:
    """Return the number of wavenumbers of the Hankel integrals for the largest contact of a scene.

    The number is 0 for bodies without layers. Raises UnsupportedScene if the contact radius is too
    large for the thickness of the layers.
    """
    bodies, indenter = Bodies.of(scene), scene.indenter
    if not bodies.layered:
        return 0
    radius = expected_radius(scene)
    orders(bodies.thickness / radius, profile(indenter, radius).apex)
    chosen = bodies.waves(radius)
    return POINTS * (chosen.equal - chosen.first)


def expected_radius(scene: Scene) -> float:
    """Estimate the radius of the largest contact of the load history, without friction [length]."""
    bodies = Bodies.of(scene)
    return max(_radius(bodies, scene, target) for target in largest_targets(scene))


def _radius(bodies: Bodies, scene: Scene, target: Target) -> float:
    """Estimate the contact radius under a prescribed normal force or approach [length].

    The contact has no friction. Below an indenter with a rim, the radius of the rim is returned.
    Otherwise a secant iteration with few polynomials gives the radius to a few percent.

    bodies  normal response of both bodies
    scene   contact problem, with the indenter
    target  prescribed normal force or approach
    """
    if scene.indenter.rim is not None:
        return scene.indenter.rim

    def residual(x: float) -> float:
        """Return log(computed / prescribed) of the normal force or approach, for the iteration.

        x  logarithm of the contact radius
        """
        return target.residual(disc(bodies, scene.indenter, exp(x), most=FEW_ORDERS))

    x, power = log(first_radius(bodies, scene.indenter, target)), 2.0
    last = residual(x)
    for _ in range(TRIED):
        step = min(max(-last / power, -1.0), 1.0)
        if abs(step) <= NEAR:
            break
        now = residual(x + step)
        power, last, x = max((now - last) / step, 0.5), now, x + step
    return exp(x)
