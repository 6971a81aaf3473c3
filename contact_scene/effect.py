"""Effects that act in a scene or do not, with reasons, as shown to people."""

from dataclasses import dataclass

from contact_scene.scene import Scene

# Name of the effect that couples the two problems.
COUPLING = "normal-tangential coupling"


@dataclass(frozen=True)
class Effect:
    """One effect, whether it acts in this scene, and the reason in one sentence."""

    name: str
    on: bool
    why: str


PRESSURE = Effect("pressure", True, "the indenter is pressed on")


def second_body(scene: Scene) -> Effect:
    """Whether both bodies deform."""
    both = scene.body.deforms and scene.indenter.deforms
    if both:
        return Effect("second elastic body", True, "both bodies deform; their compliances add")
    rigid = "indenter" if scene.body.deforms else "body"
    return Effect("second elastic body", False, f"the {rigid} is rigid")


def layers(scene: Scene, one: str) -> Effect:
    """Which bodies have how many layers.

    one  what a single one is called
    """
    where = [
        f"the {name} has {one if len(body.layers) == 1 else f'{len(body.layers)} layers'}"
        for name, body in (("body", scene.body), ("indenter", scene.indenter))
        if body.layers
    ]
    return Effect("layers", bool(where), " and ".join(where) or "no body has layers")


def friction(scene: Scene) -> Effect:
    """Whether there is any."""
    on = scene.friction is not None
    return Effect("friction", on, "[friction] is given" if on else "the scene has no friction")


def strained(scene: Scene) -> Effect:
    """Whether the lower body is strained along its surface."""
    on = any(ramp.stretch for ramp in scene.load_path())
    why = "a step names" if on else "no step names"
    return Effect("bulk strain", on, f"{why} a bulk strain or a bulk stress of the lower body")


def coupled(scene: Scene, on: bool, why: str) -> Effect:
    """Whether pressure and shear act on each other.

    why  pressure does or does not move the surfaces past each other
    """
    if scene.friction is None:
        why = "without shear there is nothing for the pressure to couple with"
    return Effect(COUPLING, on, why)


def load_history(on: bool) -> Effect:
    """Whether the path of the loads matters."""
    if on:
        return Effect("load history", True, "slip depends on the path of several steps")
    return Effect("load history", False, "the final state does not depend on the path")
