"""What is computed for a scene, and what is refused by name before any work."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot

from contact_scene import ControlKind, LoadRamp, Scene, effect
from contact_scene.body_pair import (
    coupling,
    refuse_contrast,
)
from contact_scene.bulk_strain import around_axis
from contact_scene.checks.expected_contact import refuse_equator
from contact_scene.effect import Effect
from contact_scene.normal_form import normal_form
from contact_scene.quantities.cycles import loop_increments
from contact_scene.reading.scene_text import shape_text
from contact_scene.solver_errors import UnsupportedScene
from contact_scene.stepping.load_path import along_one_line
from radial.angular_grid import Circle

# Of the shear moduli within a body: beyond, round-off is felt in the numbers.
MAX_CONTRAST = 1e8
# Of a step whose path matters: the shear is then right to some 1e-4 of its limit.
PATH_INCREMENTS = 64
# Of a step of a pushed contact: pressing, and by its share of the friction limit pushing.
PUSHED_INCREMENTS = 20
LARGEST_SHARE = 0.05
ROUND_OFF = 1e-9
# Of a contact at points: rings, and angles on a half circle; rings where one angle tells all.
RINGS, ANGLES, ROUND_RINGS = 24, 9, 64
ELSEWHERE = "solve it with the semi-analytical solver"


@dataclass(frozen=True)
class Plan:
    """What is computed for a scene: pressure, and the shear of friction, torsion or a push.

    coupled     whether pressure moves the surfaces past each other against friction
    twists      whether there is torsion
    pushed      whether there is a tangential load
    increments  how many each loading step takes
    effects     every effect with its reason, as shown to people
    direction   unit vector of the first tangential load, (1, 0) without
    still       steps before the contact is pushed
    circle      how much of a circle tells all, where contact and friction are solved together at
                points; None where the pressure or its shear is known without
    fineness    multiple of the orders and points that the solver chooses, with friction of the
                rings and angles
    """

    coupled: bool
    twists: bool
    pushed: bool
    increments: tuple[int, ...]
    effects: tuple[Effect, ...]
    direction: tuple[float, float] = (1.0, 0.0)
    still: int = 0
    circle: Circle | None = None
    fineness: float = 1.0

    @property
    def rings(self) -> int:
        """Over a contact at points."""
        return round(self.fineness * (ROUND_RINGS if self.circle is Circle.ONE else RINGS))

    @property
    def highest(self) -> int:
        """Highest angular harmonic of a contact at points."""
        return round(self.fineness * ANGLES)

    @property
    def angles(self) -> int:
        """Of the points on a ring."""
        return 0 if self.circle is None else len(self.circle.angles(self.highest))

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
    scene = normal_form(scene)
    refuse_equator(scene)
    _refuse_shape(scene)
    refuse_contrast(
        scene, MAX_CONTRAST, f", and this solver carries a ratio up to {MAX_CONTRAST:.0e}"
    )
    couples, why = coupling(scene)
    _refuse_loads(scene)
    friction, ramps = scene.friction is not None, scene.load_path()
    pushed = friction and any(any(ramp.tangential.end) for ramp in ramps)
    strains = [ramp.stretch[1] for ramp in ramps if ramp.stretch]
    strained = around_axis(strains, pushed or any(ramp.twisting.end for ramp in ramps))
    rough = scene.friction is not None and scene.friction.largest > 0
    rubs = rough and (couples or strained)
    turns = pushed and not along_one_line(ramps)
    twists = friction and any(_twists(ramp, turns) for ramp in ramps)
    circle = _circle(scene, rubs, twists, pushed, turns)
    if rubs or circle:
        _refuse_rubbing(scene, circle)
    elif twists:
        _refuse_map(scene)
    tells = "a step pushes sideways" if pushed else "no step pushes sideways"
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene),
        effect.friction(scene),
        Effect("tangential load", pushed, tells),
        Effect("torsion", twists, "a step twists" if twists else "no step twists"),
        effect.strained(scene),
        effect.coupled(scene, rough and couples, why),
        effect.load_history(rubs or twists or pushed),
    )
    increments = _pushed_increments(scene, circle) if circle else _increments(scene, rubs)
    still = next((n for n, ramp in enumerate(ramps) if any(ramp.tangential.end)), len(ramps))
    return Plan(
        rubs, twists, pushed, increments, effects, _direction(ramps), still, circle
    )  # fmt: skip


def _twists(ramp: LoadRamp, turns: bool) -> bool:
    """Whether a step twists, or leaves a contact free to turn that is not its own mirror image."""
    return bool(ramp.twisting.end) or (turns and ramp.twisting.kind is ControlKind.FORCE)


def _circle(scene: Scene, rubs: bool, twists: bool, pushed: bool, turns: bool) -> Circle | None:
    if pushed:
        return Circle.WHOLE if twists or turns else Circle.HALF
    if not twists:
        return None
    # In closed form the shear of torsion is known where the limit is µp and the pressure stays.
    proportional = scene.friction is not None and scene.friction.uniform is not None
    closed = proportional and not rubs and not _presses_while_twisted(scene.load_path())
    return None if closed else Circle.ONE


def _presses_while_twisted(ramps: tuple[LoadRamp, ...]) -> bool:
    begun = False
    for ramp in ramps:
        begun = begun or bool(ramp.twisting.end)
        if begun and ramp.normal.start != ramp.normal.end:
            return True
    return False


def _direction(ramps: tuple[LoadRamp, ...]) -> tuple[float, float]:
    """Of the first tangential load that is not zero: so positive loads come first."""
    for ramp in ramps:
        x, y = ramp.tangential.end
        if x or y:
            return x / hypot(x, y), y / hypot(x, y)
    return 1.0, 0.0


def _pushed_increments(scene: Scene, circle: Circle) -> tuple[int, ...]:
    """As asked for; else as many as the path of pressure, push and twist takes."""
    ramps = scene.load_path()
    return tuple(
        ramp.increments or max(of_loop, _on_path(scene, ramp, circle))
        for ramp, of_loop in zip(ramps, loop_increments(ramps), strict=True)
    )


def _on_path(scene: Scene, ramp: LoadRamp, circle: Circle) -> int:
    start, end = ramp.tangential.start, ramp.tangential.end
    most = PATH_INCREMENTS if circle is Circle.ONE else PUSHED_INCREMENTS
    if ramp.normal.start != ramp.normal.end or ramp.twisting.start != ramp.twisting.end:
        return most
    if start == end:
        return 1
    by_force = ramp.normal.kind is ramp.tangential.kind is ControlKind.FORCE
    assert scene.friction is not None
    limit = scene.friction.carried(ramp.normal.end)
    if not by_force or start is None or not limit:
        return most
    change = hypot(end[0] - start[0], end[1] - start[1])
    return max(1, ceil(change / (LARGEST_SHARE * limit) - ROUND_OFF))


def _increments(scene: Scene, rubs: bool) -> tuple[int, ...]:
    """As asked for; else one wherever the end of the step does not depend on its path."""
    return tuple(
        ramp.increments or (PATH_INCREMENTS if rubs and _moves(ramp) else 1)
        for ramp in scene.load_path()
    )


def _moves(ramp: LoadRamp) -> bool:
    """Whether the surfaces move past each other without a push."""
    return ramp.normal.start != ramp.normal.end or ramp.strains


def _refuse_shape(scene: Scene) -> None:
    indenter = scene.indenter
    if not indenter.is_of_revolution:
        raise UnsupportedScene(
            f"the indenter is not the same all around ({shape_text(indenter)}), and this solver "
            f"takes bodies of revolution; {ELSEWHERE}"
        )


def _refuse_map(scene: Scene) -> None:
    assert scene.friction is not None
    if scene.friction.varying is not None:
        raise UnsupportedScene(
            "friction is given as a map, and this solver takes one coefficient; name one number, "
            f"or {ELSEWHERE}"
        )


def _refuse_rubbing(scene: Scene, circle: Circle | None) -> None:
    """What pressing without friction can do and with friction cannot."""
    _refuse_map(scene)
    assert scene.friction is not None
    if scene.indenter.rim is not None:
        raise UnsupportedScene(
            "there is friction below an indenter with a rim, where tractions are infinite, and "
            f"this solver takes smooth edges; leave [friction] out, or {ELSEWHERE}"
        )
    if circle and scene.friction.largest == 0:
        raise UnsupportedScene(
            "a step names a tangential load or a torsion and the coefficient of friction is zero, "
            "so that nothing carries it; give a coefficient, or leave the load out"
        )


def _refuse_loads(scene: Scene) -> None:
    ramps = scene.load_path()
    if any(any(ramp.tilting.end) or ramp.tilting.kind is ControlKind.FORCE for ramp in ramps):
        raise UnsupportedScene(
            "a step names a moment or a tilt, and this solver keeps the indenter upright; leave it "
            f"out, or {ELSEWHERE}"
        )
