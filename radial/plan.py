"""What is computed for a scene, and what is refused by name before any work."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot
from typing import ClassVar

from contact_scene import ControlKind, LoadRamp, Scene, effect
from contact_scene.cycles import loop_increments
from contact_scene.effect import Effect
from contact_scene.pair import coupling, refuse_contrast
from contact_scene.scene_text import shape_text
from contact_scene.solver_errors import UnsupportedScene

# Of the shear moduli within a body: beyond, round-off is felt in the numbers.
MOST_CONTRAST = 1e8
# Of a step whose path matters: the shear is then right to some 1e-4 of its limit.
PATH_INCREMENTS = 64
# Of a step of a pushed contact: pressing, and by its share of the friction limit pushing.
PUSHED_INCREMENTS = 20
LARGEST_SHARE = 0.05
ROUND_OFF = 1e-9
# Of a pushed contact: rings inside, and angles on the half circle.
RINGS, ANGLES = 24, 9
# The sine of an angle below this is round-off of a load that goes straight.
STRAIGHT = 1e-9
ELSEWHERE = "solve it with the semi-analytical solver"


@dataclass(frozen=True)
class Plan:
    """What is computed for a scene: pressure, and the shear of friction, torsion or a push.

    coupled     whether pressure moves the surfaces past each other against friction
    twists      whether there is torsion
    pushed      whether there is a tangential load
    increments  how many each loading step takes
    effects     every effect with its reason, as shown to people
    direction   unit vector of the tangential load, (1, 0) without
    still       steps before the contact is pushed
    rings, angles  over a pushed contact, and on its half circle
    """

    coupled: bool
    twists: bool
    pushed: bool
    increments: tuple[int, ...]
    effects: tuple[Effect, ...]
    direction: tuple[float, float] = (1.0, 0.0)
    still: int = 0
    rings: ClassVar[int] = RINGS
    angles: ClassVar[int] = ANGLES

    @property
    def turned(self) -> int:
        """Increments in which the contact is pushed."""
        return sum(self.increments[self.still :])

    @property
    def sheared(self) -> bool:
        """Whether there is shear beside the pressure."""
        return self.coupled or self.twists or self.pushed


def plan(scene: Scene) -> Plan:
    """Whether a scene is one of pressure on a disc; raises UnsupportedScene where it is not."""
    _refuse_shape(scene)
    refuse_contrast(
        scene, MOST_CONTRAST, f", and this solver carries a ratio up to {MOST_CONTRAST:.0e}"
    )
    couples, why = coupling(scene)
    _refuse_loads(scene)
    friction, ramps = scene.friction is not None, scene.load_path()
    rubs = couples and scene.friction is not None and scene.friction.uniform != 0
    twists = friction and any(ramp.twisting.end for ramp in ramps)
    pushed = friction and any(any(ramp.tangential.end) for ramp in ramps)
    if pushed:
        _refuse_pushes(scene, twists)
    if rubs or pushed:
        _refuse_rubbing(scene)
    if twists:
        _refuse_twists(scene, rubs)
    tells = "a step pushes sideways" if pushed else "no step pushes sideways"
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene, "a layer"),
        effect.friction(scene),
        Effect("tangential load", pushed, tells),
        Effect("torsion", twists, "a step twists" if twists else "no step twists"),
        effect.coupled(scene, rubs, why),
        effect.load_history(rubs or twists or pushed),
    )
    increments = _pushed_increments(scene) if pushed else _increments(scene, rubs)
    still = next((n for n, ramp in enumerate(ramps) if any(ramp.tangential.end)), len(ramps))
    return Plan(rubs, twists, pushed, increments, effects, _direction(ramps), still)


def _direction(ramps: tuple[LoadRamp, ...]) -> tuple[float, float]:
    """Of the first tangential load that is not zero: so positive loads come first."""
    for ramp in ramps:
        x, y = ramp.tangential.end
        if x or y:
            return x / hypot(x, y), y / hypot(x, y)
    return 1.0, 0.0


def _pushed_increments(scene: Scene) -> tuple[int, ...]:
    """As asked for; else as many as the path of pressure and push takes."""
    ramps = scene.load_path()
    return tuple(
        ramp.increments or max(of_loop, _on_path(scene, ramp))
        for ramp, of_loop in zip(ramps, loop_increments(ramps), strict=True)
    )


def _on_path(scene: Scene, ramp: LoadRamp) -> int:
    start, end = ramp.tangential.start, ramp.tangential.end
    if ramp.normal.start != ramp.normal.end:
        return PUSHED_INCREMENTS
    if start == end:
        return 1
    by_force = ramp.normal.kind is ramp.tangential.kind is ControlKind.FORCE
    assert scene.friction is not None
    limit = scene.friction.carried(ramp.normal.end)
    if not by_force or start is None or not limit:
        return PUSHED_INCREMENTS
    change = hypot(end[0] - start[0], end[1] - start[1])
    return max(1, ceil(change / (LARGEST_SHARE * limit) - ROUND_OFF))


def _increments(scene: Scene, rubs: bool) -> tuple[int, ...]:
    """As asked for; else one wherever the end of the step does not depend on its path."""
    return tuple(
        ramp.increments or (PATH_INCREMENTS if rubs and ramp.normal.start != ramp.normal.end else 1)
        for ramp in scene.load_path()
    )


def _refuse_shape(scene: Scene) -> None:
    indenter = scene.indenter
    if not indenter.is_of_revolution:
        raise UnsupportedScene(
            f"the indenter is not the same all around ({shape_text(indenter)}), and this solver "
            f"takes bodies of revolution; {ELSEWHERE}"
        )


def _refuse_rubbing(scene: Scene) -> None:
    """What pressing without friction can do and with friction cannot."""
    assert scene.friction is not None
    if scene.friction.varying is not None:
        raise UnsupportedScene(
            "friction is given as a map, and this solver takes one coefficient; name one number, "
            f"or {ELSEWHERE}"
        )
    if scene.indenter.rim is not None:
        raise UnsupportedScene(
            "there is friction below an indenter with a rim, where tractions are infinite, and "
            f"this solver takes smooth edges; leave [friction] out, or {ELSEWHERE}"
        )


def _refuse_loads(scene: Scene) -> None:
    ramps = scene.load_path()
    if any(any(ramp.tilting.end) or ramp.tilting.kind is ControlKind.FORCE for ramp in ramps):
        raise UnsupportedScene(
            "a step names a moment or a tilt, and this solver keeps the indenter upright; leave it "
            f"out, or {ELSEWHERE}"
        )


def _refuse_pushes(scene: Scene, twists: bool) -> None:
    """What a push along one line cannot do."""
    assert scene.friction is not None
    if twists:
        raise UnsupportedScene(
            "steps name a tangential load and a torsion, and this solver takes one of them; leave "
            f"the other out, or {ELSEWHERE}"
        )
    if scene.friction.uniform == 0:
        raise UnsupportedScene(
            "a step names a tangential load and the coefficient of friction is zero, so that "
            "nothing carries it; give a coefficient, or leave the load out"
        )
    ends = [ramp.tangential.end for ramp in scene.load_path()]
    longest = max(ends, key=lambda end: hypot(*end))
    for end in ends:
        cross = longest[0] * end[1] - longest[1] * end[0]
        if abs(cross) > STRAIGHT * hypot(*longest) * hypot(*end):
            raise UnsupportedScene(
                f"the tangential load goes along {longest} and along {end}, and this solver takes "
                f"one line; keep to it, or {ELSEWHERE}"
            )


def _refuse_twists(scene: Scene, rubs: bool) -> None:
    """What torsion under constant pressure and one coefficient of friction does not reach."""
    assert scene.friction is not None
    if rubs:
        raise UnsupportedScene(
            "a step names a torque or twist where pressing alone already brings shear, and this "
            f"solver has one or the other; {ELSEWHERE}"
        )
    if scene.friction.varying is not None:
        raise UnsupportedScene(
            "friction is given as a map, and this solver takes one coefficient; name one number, "
            f"or {ELSEWHERE}"
        )
    begun = False
    for ramp in scene.load_path():
        begun = begun or bool(ramp.twisting.end)
        if begun and ramp.normal.start != ramp.normal.end:
            raise UnsupportedScene(
                f"step {ramp.step} presses while or after the contact is twisted, and this solver "
                f"twists under constant pressure; press in a step before, or {ELSEWHERE}"
            )
