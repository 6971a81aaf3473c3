"""Memory of a run, estimated before anything is allocated: it goes with the wavenumbers that the
thinnest outermost layer calls for in the largest contact."""

from __future__ import annotations

from functools import lru_cache
from math import exp, log

from contact_scene import Scene
from contact_scene.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from radial.bodies import Bodies
from radial.disc import disc, orders
from radial.plan import Plan
from radial.pressing import Target, first_radius
from radial.profile import profile
from radial.shown import largest_targets
from radial.wavenumbers import POINTS

# Measured of whole runs, the solve beside them and figures included, of layers from a third to a
# four-hundredth of the contact radius.
LIBRARIES = 168 << 20
LIGHT = 4500  # bytes of an increment without its fields
PER_WAVE = 11_300  # bytes; most of it where figures show the stress
# With friction: rings, and what is kept of contacts of many radii until there is no more room.
PER_WAVE_RUBBING, RINGS = 8_600, 36_000_000
PER_WAVE_KEPT, MOST_KEPT = 8_300, 39_000_000
# Of pushed contacts: rings about the edge and outside, and how many matrices of all unknowns there
# are at a time.
BESIDE, HELD = 16, 6
# The radius is good to a percent by so few polynomials.
FEW_ORDERS, TRIED, NEAR = 16, 12, 0.02


def estimated_bytes(scene: Scene, plan: Plan) -> int:
    """Largest memory of a process that runs, the solve beside it and figures included [byte].

    Raises UnsupportedScene for contacts too large on too thin layers.
    """
    libraries = LIBRARIES + LIGHT * sum(plan.increments)
    waves = _wavenumbers(scene)
    if plan.pushed:
        unknowns = 3 * (plan.rings + BESIDE) * plan.angles
        return libraries + PER_WAVE * waves + HELD * 8 * unknowns**2
    if not plan.coupled:
        return libraries + PER_WAVE * waves
    kept = min(PER_WAVE_KEPT * waves, MOST_KEPT)
    return libraries + RINGS + kept + PER_WAVE_RUBBING * waves


def refuse_if_too_large(scene: Scene, plan: Plan) -> None:
    """Raise ResourceRefused if the solve would not fit."""
    needed, available = estimated_bytes(scene, plan), available_bytes()
    if needed > available:
        raise ResourceRefused(
            f"a layer as thin as this in so large a contact, and {sum(plan.increments)} "
            f"increments, need about {needed / 2**30:.1f} GiB, {available / 2**30:.1f} GiB are "
            "available; choose a smaller load or fewer increments"
        )


@lru_cache(maxsize=8)
def _wavenumbers(scene: Scene) -> int:
    """Of the largest contact; none without layers."""
    bodies, indenter = Bodies.of(scene), scene.indenter
    if not bodies.layered:
        return 0
    radius = max(_radius(bodies, scene, target) for target in largest_targets(scene))
    orders(bodies.thickness / radius, profile(indenter, radius).apex)
    chosen = bodies.waves(radius)
    return POINTS * (chosen.equal - chosen.first)


def _radius(bodies: Bodies, scene: Scene, target: Target) -> float:
    """Of the contact without friction, nearly [length]."""
    if scene.indenter.rim is not None:
        return scene.indenter.rim

    def missed(x: float) -> float:
        return target.missed(disc(bodies, scene.indenter, exp(x), most=FEW_ORDERS))

    x, power = log(first_radius(bodies, scene.indenter, target)), 2.0
    last = missed(x)
    for _ in range(TRIED):
        step = min(max(-last / power, -1.0), 1.0)
        if abs(step) <= NEAR:
            break
        now = missed(x + step)
        power, last, x = max((now - last) / step, 0.5), now, x + step
    return exp(x)
