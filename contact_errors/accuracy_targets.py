"""Requested accuracy: the numbers that a request binds in a scene, and requests beyond reach."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from contact_errors.refinement import SPACE, SPARE, RefinementLevel, largest_of
from contact_errors.values import OF_CYCLES, scale
from contact_scene import Scene
from contact_scene.accuracy import LARGEST_TENSION, AccuracyRequest
from contact_scene.cycles import load_cycles
from contact_scene.solver_errors import AccuracyOutOfReach
from contact_scene.stated_error import ErrorStatus

# Of the natural size of a number: a smaller number is a zero with round-off.
ROUND_OFF = 1e-7
# The coarsest level may overestimate an error at the finest affordable one by this factor.
DOUBT = 4.0

NONE_STATED = {
    "ruiz_f2": "only the semi-analytical solver computes the stress at the surface",
    LARGEST_TENSION: "the body is rigid, or the solver states no errors of stress",
}
NO_CYCLE = "no load cycle closes in the scene"
NO_FRICTION = "the scene has no friction"
OF_FRICTION = frozenset(
    {
        *("tangential_force", "tangential_shift", "torque", "twist"),
        *("stick_area", "stick_radius", "dissipated_energy", *OF_CYCLES),
    }
)
PRESCRIBED = "the load prescribes it"
INFINITE = "it is infinite in the exact answer"


@dataclass(frozen=True)
class Targets:
    """Numbers that a request binds.

    shares    largest error of each number, relative to its largest value in the history
    left_out  numbers that are not bound, with the reason
    """

    shares: Mapping[str, float]
    left_out: Mapping[str, str]


def refuse_absent(request: AccuracyRequest, scene: Scene) -> None:
    """Raise AccuracyOutOfReach for a named number that no result of the scene can have."""
    absent = dict.fromkeys(OF_FRICTION, NO_FRICTION) if scene.friction is None else {}
    if not load_cycles(scene.load_path()):
        absent |= dict.fromkeys(OF_CYCLES, NO_CYCLE)
    if not any(step.torque is not None or step.twist for step in scene.loading):
        absent |= dict.fromkeys(("torque", "twist"), "no step of the scene twists")
    if not any(step.moment is not None or any(step.tilt or ()) for step in scene.loading):
        absent |= dict.fromkeys(("moment", "tilt"), "no step of the scene tilts")
    for name in request.named:
        if name in absent:
            raise AccuracyOutOfReach(f"no accuracy of {name} can be had: {absent[name]}")


def targets_of(request: AccuracyRequest, level: RefinementLevel[Any]) -> Targets:
    """Determine the numbers that a request binds, by a first result.

    Raises AccuracyOutOfReach for a named number that is absent, or infinite.
    """
    left_out = {name: why for name in request.shares() if (why := _why_left_out(name, level))}
    for name in request.named:
        if left_out.get(name, PRESCRIBED) is not PRESCRIBED:
            raise AccuracyOutOfReach(f"no accuracy of {name} can be had: {left_out[name]}")
    shares = {name: share for name, share in request.shares().items() if name not in left_out}
    return Targets(shares, left_out)


def refuse_unreachable(targets: Targets, level: RefinementLevel[Any], most_growth: float) -> None:
    """Raise AccuracyOutOfReach for numbers that the finest affordable grid will not meet.

    most_growth  its cells along a side over those of the level
    """
    told = []
    for name, share in targets.shares.items():
        known = [end.error.parts for end in level.ends(name) if end.error.parts]
        if not known:
            continue
        space = max(largest_of(parts.get(part, 0.0)) for parts in known for part in SPACE)
        order = level.order(name)
        reach = SPARE * space / level.largest(name) / most_growth**order
        if reach > DOUBT * share:
            told.append(
                f"{name} to {_percent(share)}: its error falls as the cells or elements along a "
                f"side to the power {order:g}, "
                f"and about {_percent(reach)} is all that fits into this machine"
            )
    if told:
        raise AccuracyOutOfReach("no grid can meet " + "; nor ".join(told))


def _why_left_out(name: str, level: RefinementLevel[Any]) -> str:
    """Empty for a number that is bound."""
    ends = level.ends(name)
    if not ends:
        return NONE_STATED.get(name, "the scene has none")
    if name == "peak_pressure" and level.infinite:
        return INFINITE
    natural = max(scale(name, step) for step in level.values)
    found = [end.error.status for end in ends if end.size > ROUND_OFF * natural]
    if any(status is not ErrorStatus.EXACT for status in found):
        return ""
    return PRESCRIBED if found else "it is zero throughout"


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"
