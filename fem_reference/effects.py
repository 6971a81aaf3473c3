"""What acts in a scene and what does not, with reasons, as shown to people."""

from dataclasses import dataclass

from contact_scene import Scene
from fem_reference.path import Path


@dataclass(frozen=True)
class Effect:
    """One effect, whether it acts in this scene, and the reason in one sentence."""

    name: str
    on: bool
    why: str


def effects(
    scene: Scene, path: Path, acting: tuple[bool, bool, bool], why_coupled: str
) -> tuple[Effect, ...]:
    """Every effect with its reason.

    acting       whether there are friction, a tangential load, and torsion
    why_coupled  why pressure does or does not move the surfaces past each other
    """
    friction, loaded, twisted = acting
    coupled = path in (Path.PRESSING_WITH_FRICTION, Path.HARMONICS)
    history = path is not Path.PRESSING and len(scene.loading) > 1
    return (
        Effect("pressure", True, "the indenter is pressed on"),
        _second_body(scene),
        _layers(scene),
        Effect(
            "friction",
            friction,
            "[friction] is given" if friction else "the scene has no [friction]",
        ),
        Effect(
            "tangential load",
            friction and loaded,
            "a step names a tangential force or shift" if loaded else "no step pushes sideways",
        ),
        Effect(
            "torsion",
            friction and twisted,
            "a step names a torque or twist" if twisted else "no step twists the indenter",
        ),
        Effect(
            "normal-tangential coupling",
            coupled,
            why_coupled
            if friction
            else "without shear there is nothing for the pressure to couple with",
        ),
        _cross_slip(path),
        Effect(
            "load history",
            history,
            "slip depends on the path of several steps"
            if history
            else "the final state does not depend on the path",
        ),
    )


def _cross_slip(path: Path) -> Effect:
    """Slip across the load, which Poisson's ratio calls for (Munisamy, Hills and Nowell 1994)."""
    name = "slip across the load"
    if path is Path.SHEARING:
        return Effect(
            name, False, "neglected, as by Cattaneo and Mindlin: shear and slip are along the load"
        )
    if path is Path.HARMONICS:
        return Effect(name, True, "Coulomb's law is obeyed as a vector law at every point")
    return Effect(name, False, "nothing pushes sideways")


def _second_body(scene: Scene) -> Effect:
    both = scene.body.deforms and scene.indenter.deforms
    if both:
        return Effect("second elastic body", True, "both bodies deform; their compliances add")
    rigid = "indenter" if scene.body.deforms else "body"
    return Effect("second elastic body", False, f"the {rigid} is rigid")


def _layers(scene: Scene) -> Effect:
    where = [
        f"the {name} has {len(body.layers)} layer{'s' if len(body.layers) > 1 else ''}"
        for name, body in (("body", scene.body), ("indenter", scene.indenter))
        if body.layers
    ]
    return Effect("layers", bool(where), " and ".join(where) or "no body has layers")
