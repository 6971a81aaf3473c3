"""Estimate of the memory of a run, made before any allocation.

The memory is a constant, plus a part for each increment, plus a part proportional to the number of
wavenumbers. The wavenumbers are those that the largest contact requires for the thinnest outermost
layer.
"""

from __future__ import annotations

from contact_scene import Scene
from contact_scene.machine import require_memory
from radial.angular_grid import RingAngles
from radial.plan import Plan

# The values were measured with whole runs, including the coarse solve and the figures. The layers
# had thicknesses from 1/3 to 1/400 of the contact radius. LIBRARIES: imported libraries [byte].
LIBRARIES = 144 << 20
LIGHT = 4500  # memory of an increment without its fields [byte]
PER_WAVE = 11_300  # memory of a wavenumber without friction, mostly for stress in figures [byte]
# With friction: memory of a wavenumber, of fields on rings with further libraries, and of the
# cached responses, which are limited to MAX_CACHED [byte].
PER_WAVE_RUBBING = 8_600
RINGS = 61_000_000
PER_WAVE_CACHED = 8_300
MAX_CACHED = 39_000_000
# Contacts at points (rings × angles) on half and on whole circles, memory of a wavenumber, and
# memory of figures, which are drawn after the memory of the solve is free again [byte].
PUSHED = 200 << 20
WHOLE = 316 << 20
PER_WAVE_PUSHED = 8_600
DRAWN = 230 << 20


def estimated_bytes(scene: Scene, plan: Plan) -> int:
    """Estimate the peak memory of a run, including the coarse solve and the figures [byte].

    The coarse solve serves the error estimate. Raises UnsupportedScene if the largest contact is
    too large for the thickness of its layers.

    scene  contact problem
    plan   effects of the scene, and number of increments of each load step
    """
    reported = LIGHT * sum(plan.increments)
    libraries = LIBRARIES + reported
    waves = 0
    if scene.body.layers or scene.indenter.layers:
        # Imported here, because a plan without layers does not need scipy.
        from radial.largest_contact import wavenumbers

        waves = wavenumbers(scene)
    if plan.circle:
        solved = WHOLE if plan.circle is RingAngles.WHOLE else PUSHED
        return reported + max(solved + PER_WAVE_PUSHED * waves, DRAWN)
    if not plan.coupled:
        return libraries + PER_WAVE * waves
    cached = min(PER_WAVE_CACHED * waves, MAX_CACHED)
    return libraries + RINGS + cached + PER_WAVE_RUBBING * waves


def refuse_if_too_large(scene: Scene, plan: Plan) -> None:
    """Raise ResourceRefused if the estimated memory of a solve exceeds the available memory.

    scene  contact problem
    plan   physical effects of the scene, and number of increments of each load step
    """
    require_memory(
        estimated_bytes(scene, plan),
        f"the layers and {sum(plan.increments)} increments",
        "Use a smaller load or fewer increments",
    )
