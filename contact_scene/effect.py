"""Physical effects of a scene, such as layers and friction, with reasons for the user.

The plan of each solver lists these effects, whether they act in the scene or not.
"""

from dataclasses import dataclass

from contact_scene.scene import Scene

# Name of the effect that couples the normal and the tangential problem.
COUPLING = "normal-tangential coupling"


@dataclass(frozen=True)
class Effect:
    """Physical effect that a solver computes or omits, such as friction, for the plan of a solve.

    name  name of the effect
    on    True if the effect acts in the scene
    why   reason in one sentence, for the user
    """

    name: str
    on: bool
    why: str


PRESSURE = Effect("pressure", True, "the indenter is pressed on")


def second_body(scene: Scene) -> Effect:
    """Describe the effect of a second elastic body, for the plan of a solve.

    The effect acts if both bodies of the scene deform. Their compliances then add.

    scene  contact problem with its two bodies
    """
    both = scene.body.deforms and scene.indenter.deforms
    if both:
        return Effect("second elastic body", True, "both bodies deform; their compliances add")
    rigid = "indenter" if scene.body.deforms else "body"
    return Effect("second elastic body", False, f"the {rigid} is rigid")


def layers(scene: Scene) -> Effect:
    """Describe the effect of the layers of both bodies, for the plan of a solve.

    The effect acts if a body of the scene has layers. The reason states the number of layers of
    each body.

    scene  contact problem with its two bodies
    """
    where = [
        f"the {name} has {len(body.layers)} layer{'s' if len(body.layers) > 1 else ''}"
        for name, body in (("body", scene.body), ("indenter", scene.indenter))
        if body.layers
    ]
    springs = sum(
        layer.interface_stiffness is not None
        for body in (scene.body, scene.indenter)
        for layer in body.layers
    )
    bonds = f"; compliant bonds: {springs}" if springs else ""
    return Effect("layers", bool(where), f"{' and '.join(where) or 'no body has layers'}{bonds}")


def friction(scene: Scene) -> Effect:
    """Describe the effect of friction, for the plan of a solve.

    The effect acts if the scene has a friction law.

    scene  contact problem with its friction law
    """
    on = scene.friction is not None
    return Effect("friction", on, "[friction] is given" if on else "the scene has no friction")


def strained(scene: Scene) -> Effect:
    """Describe the effect of a bulk strain of the lower body, for the plan of a solve.

    The effect acts if a load step prescribes a bulk strain, which is uniform and parallel to the
    surface.

    scene  contact problem with its load steps
    """
    on = any(ramp.stretch for ramp in scene.load_path())
    why = "a step prescribes" if on else "no step prescribes"
    return Effect("bulk strain", on, f"{why} a bulk strain or a bulk stress of the lower body")


def coupled(scene: Scene, on: bool, why: str) -> Effect:
    """Describe the coupling of the normal and the tangential problem, for the plan of a solve.

    The problems are coupled if pressure displaces the surfaces tangentially relative to each other.

    scene  contact problem
    on     True if the problems are coupled
    why    reason; replaced by the absence of shear in a scene without friction
    """
    if scene.friction is None:
        why = "without friction there is no shear"
    return Effect(COUPLING, on, why)


def contact_stiffness(scene: Scene, refused: str = "") -> tuple[Effect, ...]:
    """Describe the computation of the contact stiffnesses, if the scene requests it.

    They are not computed on line contacts.

    scene    contact problem
    refused  reason why the solver does not compute them; empty if it does
    """
    if not scene.contact_stiffness:
        return ()
    if scene.indenter.is_line:
        refused = "the approach of a line contact depends on the reference length"
    why = refused or "contact_stiffness is true: one linear solve per motion at the end of a step"
    return (Effect("contact stiffness", not refused, why),)


def load_history(on: bool) -> Effect:
    """Describe the effect of the load history, for the plan of a solve.

    The effect acts if the final contact state depends on the load path, not on the final loads
    alone.

    on  True if the final state depends on the load path
    """
    if on:
        return Effect("load history", True, "slip depends on the path of several steps")
    return Effect("load history", False, "the final state does not depend on the path")
