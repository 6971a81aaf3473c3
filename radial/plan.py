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
ELSEWHERE = "solve it with the semi-analytical solver"


@dataclass(frozen=True)
class Plan:
    """What is computed for a scene: pressure.

    increments  how many each loading step takes
    effects     every effect with its reason, as shown to people
    """

    increments: tuple[int, ...]
    effects: tuple[Effect, ...]
    direction: ClassVar[tuple[float, float]] = (1.0, 0.0)


def plan(scene: Scene) -> Plan:
    """Whether a scene is one of pressure on a disc; raises UnsupportedScene where it is not."""
    _refuse_shape(scene)
    refuse_contrast(
        scene, MOST_CONTRAST, f", and this solver carries a ratio up to {MOST_CONTRAST:.0e}"
    )
    couples, why = coupling(scene)
    _refuse_loads(scene, couples)
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene, "a layer"),
        effect.friction(scene),
        effect.coupled(scene, False, why),
        effect.load_history(False),
    )
    return Plan(tuple(step.increments or 1 for step in scene.loading), effects)


def _refuse_shape(scene: Scene) -> None:
    indenter = scene.indenter
    if not indenter.is_of_revolution:
        raise UnsupportedScene(
            f"the indenter is not the same all around ({shape_text(indenter)}), and this solver "
            f"takes bodies of revolution; {ELSEWHERE}"
        )


def _refuse_loads(scene: Scene, couples: bool) -> None:
    """couples  whether pressure moves the surfaces past each other"""
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
            "a step names a tangential force or shift, and this solver has pressure alone; "
            f"{ELSEWHERE}"
        )
    if any(ramp.twisting.end for ramp in ramps):
        raise UnsupportedScene(
            f"a step names a torque or twist, and this solver has pressure alone; {ELSEWHERE}"
        )
    if couples:
        raise UnsupportedScene(
            "there is friction where pressure moves the surfaces past each other, and this solver "
            f"has pressure alone; leave [friction] out, or {ELSEWHERE}"
        )
