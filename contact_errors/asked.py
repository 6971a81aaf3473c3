"""What a request for accuracy binds in a scene, and what no grid can meet."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from contact_errors.ladder import SPACE, SPARE, Rung
from contact_errors.values import OF_CYCLES, scale
from contact_scene import Scene
from contact_scene.accuracy import LARGEST_TENSION, AccuracyRequest
from contact_scene.cycles import load_cycles
from contact_scene.solver_errors import AccuracyOutOfReach
from contact_scene.stated_error import ErrorStatus

# Of the largest value that its contact could have: a number below is a zero with round-off.
ROUND_OFF = 1e-7
# The first rung's error may be so many times what the finer ones will make of it by their order.
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
class Asked:
    """What is bound.

    shares    largest error of each quantity, relative to its largest value in the history
    left_out  quantities that are not bound, and why
    """

    shares: Mapping[str, float]
    left_out: Mapping[str, str]


def refuse_absent(request: AccuracyRequest, scene: Scene) -> None:
    """Raise AccuracyOutOfReach for a quantity that is named and that, to judge by the scene alone,
    no result will have."""
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


def asked_of(request: AccuracyRequest, rung: Rung[Any]) -> Asked:
    """What a request binds, by a first result; raises AccuracyOutOfReach for a quantity that is
    named and that the scene has not, or not finite."""
    left_out = {name: why for name in request.shares() if (why := _why_left_out(name, rung))}
    for name in request.named:
        if left_out.get(name, PRESCRIBED) is not PRESCRIBED:
            raise AccuracyOutOfReach(f"no accuracy of {name} can be had: {left_out[name]}")
    shares = {name: share for name, share in request.shares().items() if name not in left_out}
    return Asked(shares, left_out)


def refuse_unreachable(asked: Asked, rung: Rung[Any], most_growth: float) -> None:
    """Raise AccuracyOutOfReach for what not even the finest grid that fits will meet.

    most_growth  of that grid, cells along a side over those of the rung
    """
    told = []
    for name, share in asked.shares.items():
        sizes = [error.parts for error in rung.errors(name) if error.parts]
        if not sizes:
            continue
        space = (_largest(parts.get(part, 0.0)) for parts in sizes for part in SPACE)
        order, floor = rung.rules[name].order, rung.rules[name].floor
        if share < floor:
            told.append(f"{name} to {_percent(share)}: about {_percent(floor)} stay on any grid")
            continue
        reach = SPARE * max(space) / rung.largest(name) / most_growth**order
        if reach > DOUBT * share:
            told.append(
                f"{name} to {_percent(share)}: its error falls as the cells or elements along a "
                f"side to the power {order:g}, "
                f"and about {_percent(reach)} is all that fits into this machine"
            )
    if told:
        raise AccuracyOutOfReach("no grid can meet " + "; nor ".join(told))


def _why_left_out(name: str, rung: Rung[Any]) -> str:
    """Empty for what is bound."""
    ends = rung.ends(name)
    if not ends:
        return NONE_STATED.get(name, "the scene has none")
    if name not in rung.rules:
        return INFINITE
    largest_contact = max(scale(name, step) for step in rung.values)
    found = [end.error.status for end in ends if end.size > ROUND_OFF * largest_contact]
    if any(status is not ErrorStatus.EXACT for status in found):
        return ""
    return PRESCRIBED if found else "it is zero throughout"


def _largest(amount: Any) -> float:
    return float(max(amount)) if isinstance(amount, tuple) else float(amount)


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"
