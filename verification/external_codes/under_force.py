"""CalculiX under a nominal force, which its decks do not prescribe, on elements that shrink towards
the edge of contact, which is not known before."""

from collections.abc import Mapping
from dataclasses import replace
from math import log
from typing import Any

from verification.external_codes.calculix_deck import Fineness
from verification.external_codes.coated_scene import CoatedScene
from verification.external_codes.nodal_pressure import on_nodes, up_to_edge
from verification.external_codes.run_calculix import run_calculix

COARSEST = 12  # elements over the radius of contact; doubles
# Of the springs, in E* over the radius of contact, E* that of a film if it is stiffer; doubles, so
# that on the smallest elements springs are ten times as stiff as those.
STIFFNESS = 1000.0
# The edge of contact and the approach at which the force is the one asked for are looked for on
# equal elements, these many over this reach, then on those that are asked for.
SCOUTING = Fineness(8, STIFFNESS, 1.6)
ROOM = 1.25  # beyond the edge, over its radius
SCOUTS, RUNS = 1, 2
RISE = 1.5  # of the logarithm of the force with that of the approach, to begin with
TOLD_APART = 0.01  # logarithms of approaches whose forces tell it


def under_force(scene: CoatedScene, times: int) -> tuple[float, Mapping[str, Any], Fineness]:
    """The approach under the nominal force, what was found very near it, and on which elements.

    times   as many elements over the contact radius as COARSEST
    raises  SubprocessError or ValueError where ccx finds nothing
    """
    rise, found = RISE, run_calculix(scene, SCOUTING)
    for _ in range(SCOUTS):
        first, force = log(scene.approach), log(found["normal_force"])
        scene = _loaded(scene, found, rise)
        found = run_calculix(scene, SCOUTING)
        moved = log(scene.approach) - first
        rise = (log(found["normal_force"]) - force) / moved if abs(moved) > TOLD_APART else rise
    for _ in range(RUNS):
        edge, _ = up_to_edge(*on_nodes(found))
        stiffness = STIFFNESS * times * max(scene.modulus_ratio, 1.0) / edge
        fineness = Fineness(COARSEST * times / edge, stiffness, ROOM * edge, edge)
        scene = _loaded(scene, found, rise)
        found = run_calculix(scene, fineness)
    return _loaded(scene, found, rise).approach, found, fineness


def _loaded(scene: CoatedScene, found: Mapping[str, Any], rise: float) -> CoatedScene:
    """At the approach at which the force is the nominal one, by a run near it."""
    return replace(scene, approach=scene.approach * found["normal_force"] ** (-1 / rise))
