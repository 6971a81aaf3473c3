"""Physical effects of a scene, active or not, with reasons for the user."""

from dataclasses import dataclass

from contact_scene.scene import Scene

# Name of the effect that couples the two problems.
COUPLING = "normal-tangential coupling"


@dataclass(frozen=True)
class Effect:
    """Effect, active (on) or not, with the reason in one sentence."""

    name: str
    on: bool
    why: str


PRESSURE = Effect("pressure", True, "the indenter is pressed on")


def second_body(scene: Scene) -> Effect:
    """Determine if both bodies deform."""
    both = scene.body.deforms and scene.indenter.deforms
    if both:
        return Effect("second elastic body", True, "both bodies deform; their compliances add")
    rigid = "indenter" if scene.body.deforms else "body"
    return Effect("second elastic body", False, f"the {rigid} is rigid")


def layers(scene: Scene) -> Effect:
    """Determine the number of layers of each body."""
    where = [
        f"the {name} has {len(body.layers)} layer{'s' if len(body.layers) > 1 else ''}"
        for name, body in (("body", scene.body), ("indenter", scene.indenter))
        if body.layers
    ]
    return Effect("layers", bool(where), " and ".join(where) or "no body has layers")


def friction(scene: Scene) -> Effect:
    """Determine if the scene has friction."""
    on = scene.friction is not None
    return Effect("friction", on, "[friction] is given" if on else "the scene has no friction")


def strained(scene: Scene) -> Effect:
    """Determine if the lower body has a bulk strain."""
    on = any(ramp.stretch for ramp in scene.load_path())
    why = "a step prescribes" if on else "no step prescribes"
    return Effect("bulk strain", on, f"{why} a bulk strain or a bulk stress of the lower body")


def coupled(scene: Scene, on: bool, why: str) -> Effect:
    """Create the effect of the coupling; without friction there is another reason."""
    if scene.friction is None:
        why = "without friction there is no shear"
    return Effect(COUPLING, on, why)


def load_history(on: bool) -> Effect:
    """Create the effect of path-dependence."""
    if on:
        return Effect("load history", True, "slip depends on the path of several steps")
    return Effect("load history", False, "the final state does not depend on the path")
