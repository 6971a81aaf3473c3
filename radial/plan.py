"""What is computed for a scene, and what is refused by name before any work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from contact_scene import ControlKind, Scene, effect
from contact_scene.effect import Effect
from contact_scene.pair import coupling, refuse_contrast
from contact_scene.scene_text import shape_text
from contact_scene.solver_errors import UnsupportedScene

# Of the shear moduli within a body: beyond, round-off is felt in the numbers.
MOST_CONTRAST = 1e8
# Of a step whose path matters: the shear is then right to some 1e-4 of its limit.
PATH_INCREMENTS = 64
ELSEWHERE = "solve it with the semi-analytical solver"


@dataclass(frozen=True)
class Plan:
    """What is computed for a scene: pressure, and the shear that it brings with it or torsion.

    coupled     whether pressure moves the surfaces past each other against friction
    twists      whether there is torsion
    increments  how many each loading step takes
    effects     every effect with its reason, as shown to people
    """

    coupled: bool
    twists: bool
    increments: tuple[int, ...]
    effects: tuple[Effect, ...]
    direction: ClassVar[tuple[float, float]] = (1.0, 0.0)

    @property
    def sheared(self) -> bool:
        """Whether there is shear beside the pressure."""
        return self.coupled or self.twists


def plan(scene: Scene) -> Plan:
    """Whether a scene is one of pressure on a disc; raises UnsupportedScene where it is not."""
    _refuse_shape(scene)
    refuse_contrast(
        scene, MOST_CONTRAST, f", and this solver carries a ratio up to {MOST_CONTRAST:.0e}"
    )
    couples, why = coupling(scene)
    _refuse_loads(scene)
    rubs = couples and scene.friction is not None and scene.friction.uniform != 0
    twists = scene.friction is not None and any(ramp.twisting.end for ramp in scene.load_path())
    if rubs:
        _refuse_rubbing(scene)
    if twists:
        _refuse_twists(scene, rubs)
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene, "a layer"),
        effect.friction(scene),
        Effect("torsion", twists, "a step twists" if twists else "no step twists"),
        effect.coupled(scene, rubs, why),
        effect.load_history(rubs or twists),
    )
    return Plan(rubs, twists, _increments(scene, rubs), effects)


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
    if scene.friction is None:
        return
    if any(any(ramp.tangential.end) for ramp in ramps):
        raise UnsupportedScene(
            f"a step names a tangential force or shift, and this solver has none; {ELSEWHERE}"
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
