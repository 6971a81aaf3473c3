"""Memory of a run, estimated before anything is allocated: it goes with the wavenumbers that the
thinnest outermost layer calls for in the largest contact."""

from __future__ import annotations

from contact_scene import Scene
from contact_scene.machine.free_memory import available_bytes
from contact_scene.solver_errors import ResourceRefused
from radial.angular_grid import Circle
from radial.plan import Plan

# Measured of whole runs, the solve beside them and figures included, of layers from a third to a
# four-hundredth of the contact radius.
LIBRARIES = 168 << 20
LIGHT = 4500  # bytes of an increment without its fields
PER_WAVE = 11_300  # bytes; most of it where figures show the stress
# With friction: rings, and what is kept of contacts of many radii until there is no more room.
PER_WAVE_RUBBING, RINGS = 8_600, 36_000_000
PER_WAVE_KEPT, MAX_KEPT = 8_300, 39_000_000
# Of contacts at points, whose rings and angles are always as many: figures are drawn when what the
# solve has taken is free again.
PUSHED, WHOLE, PER_WAVE_PUSHED, DRAWN = 133 << 20, 246 << 20, 8_600, 181 << 20


def estimated_bytes(scene: Scene, plan: Plan) -> int:
    """Largest memory of a process that runs, the solve beside it and figures included [byte].

    Raises UnsupportedScene for contacts too large on too thin layers.
    """
    told = LIGHT * sum(plan.increments)
    libraries = LIBRARIES + told
    waves = _wavenumbers(scene)
    if plan.circle:
        solved = WHOLE if plan.circle is Circle.WHOLE else PUSHED
        return told + max(solved + PER_WAVE_PUSHED * waves, DRAWN)
    if not plan.coupled:
        return libraries + PER_WAVE * waves
    kept = min(PER_WAVE_KEPT * waves, MAX_KEPT)
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


def _wavenumbers(scene: Scene) -> int:
    """Of the largest contact; none without layers, whose response is then nobody's concern."""
    if not scene.body.layers and not scene.indenter.layers:
        return 0
    from radial.largest_contact import wavenumbers

    return wavenumbers(scene)
