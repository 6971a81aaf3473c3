"""Normal form of a scene: inputs without effect, such as a layer of the substrate's material, are
removed.

All solvers plan and solve the normal form. A scene with such inputs therefore has the plan and the
numbers of the scene without them.
"""

from typing import TypeVar

from contact_scene.body import Body, Layer
from contact_scene.body_pair import coupling
from contact_scene.geometry import Ellipsoid, Paraboloid
from contact_scene.loading import LoadStep
from contact_scene.material import IsotropicMaterial, Material
from contact_scene.scene import Scene
from contact_scene.stepping.load_path import (
    LoadRamp,
    along_one_line,
)

B = TypeVar("B", bound=Body)
# Controls without effect by name, each with the default control of its coordinate and the value 0.
Unnamed = dict[str, tuple[str, object]]


def normal_form(scene: Scene) -> Scene:
    """Return the scene without inputs that have no effect; the same object if there are none.

    - Adjacent layers of one material with a rigid bond become one layer. A lowest layer of the
      substrate's material becomes part of the substrate if its bond is rigid.
    - An ellipsoid with equal radii becomes a paraboloid.
    - A control that is zero in all load steps becomes the default control of its coordinate (free
      shift, fixed twist, fixed tilt) if both are equal by symmetry or without friction.
    - Friction that is zero everywhere is removed if no load shears the contact.
    - Strengths are removed: the solution does not depend on them.
    """
    indenter, ramps = scene.indenter, scene.load_path()
    if isinstance(indenter, Ellipsoid) and indenter.is_of_revolution:
        indenter = Paraboloid(
            material=indenter.material, layers=indenter.layers, radius=indenter.radii[0]
        )
    bodies = {"indenter": indenter, "body": scene.body}
    merged = {name: _merge_equal_layers(_without_strengths(body)) for name, body in bodies.items()}
    shears = any(any(ramp.tangential.end) or ramp.twisting.end for ramp in ramps)
    friction = scene.friction
    if friction is not None and friction.largest == 0.0 and not shears:
        friction = None
    found = scene.model_copy(update={**merged, "friction": friction})
    unnamed = _controls_without_effect(found, ramps)
    steps = tuple(_replace_controls(step, unnamed) for step in scene.loading)
    found = found.model_copy(update={"loading": steps})
    return scene if found == scene else found


def with_bodies_of(scene: Scene, given: Scene) -> Scene:
    """Return a scene with the layers and materials of another one, such as that of the user.

    Interfaces of merged layers, at which a stress may be wanted, and strengths are then kept.

    scene  scene of a result, in normal form
    given  scene before its normal form
    """
    upper = given.indenter
    indenter = scene.indenter.model_copy(
        update={"material": upper.material, "layers": upper.layers}
    )
    return scene.model_copy(update={"body": given.body, "indenter": indenter})


def _without_strengths(body: B) -> B:
    """Return a body without the strengths of its materials and interfaces."""
    layers = tuple(
        layer.model_copy(update={"material": _elastic(layer.material), "interface_strength": None})
        for layer in body.layers
    )
    material = body.material
    if isinstance(material, IsotropicMaterial):
        material = _elastic(material)
    return body.model_copy(update={"material": material, "layers": layers})


def _elastic(material: IsotropicMaterial) -> IsotropicMaterial:
    """Return a material without its strengths."""
    return material.model_copy(update={"yield_strength": None, "tensile_strength": None})


def _merge_equal_layers(body: B) -> B:
    """Merge adjacent layers of a body that have the same material and a rigid bond into one layer.

    A lowest layer that has the material of the substrate, and a rigid bond to it, becomes part of
    the substrate. Used for the normal form of a scene, which contains no inputs without effect.

    body  layered body, which is not changed
    """
    if not body.layers:
        return body
    upward: list[Layer] = []
    material: Material = body.material
    for layer in reversed(body.layers):
        if layer.material != material or layer.interface_stiffness is not None:
            upward.append(layer)
        elif upward:
            thickness = upward[-1].thickness + layer.thickness
            upward[-1] = upward[-1].model_copy(update={"thickness": thickness})
        material = layer.material
    return body.model_copy(update={"layers": tuple(reversed(upward))})


def _controls_without_effect(scene: Scene, ramps: tuple[LoadRamp, ...]) -> Unnamed:
    """Determine the prescribed loads and displacements of a scene that have no effect.

    A control prescribes a force or a displacement of one coordinate of the indenter. Such a control
    has no effect if it is zero in all load steps and, by symmetry or without friction, equals the
    default control of its coordinate (free shift, fixed twist, fixed tilt). The normal form of the
    scene contains the default instead.

    scene    scene after all other replacements
    ramps    load ramps of the scene, one for each load step
    returns  default control and its value 0, by the name of the control that it replaces
    """
    tilts = any(any(ramp.tilting.end) for ramp in ramps)
    twists = any(ramp.twisting.end or (ramp.stretch and ramp.stretch[1][2]) for ramp in ramps)
    pushed = any(any(ramp.tangential.end) for ramp in ramps)
    indenter, friction = scene.indenter, scene.friction
    found: Unnamed = {}
    if friction is None:
        found = {"tangential_shift": ("tangential_force", (0.0, 0.0)), "torque": ("twist", 0.0)}
    if not indenter.is_even or tilts or not (friction is None or friction.is_even):
        return found
    if not pushed:
        found["tangential_shift"] = ("tangential_force", (0.0, 0.0))
    along_axis = any(all(ramp.tangential.end[i] == 0 for ramp in ramps) for i in (0, 1))
    round_ = indenter.is_of_revolution and (friction is None or friction.uniform is not None)
    if not twists and (along_axis or (round_ and along_one_line(ramps))):
        found["torque"] = ("twist", 0.0)
    if not pushed or friction is None or not coupling(scene)[0]:
        found["moment"] = ("tilt", (0.0, 0.0))
    return found


def _replace_controls(step: LoadStep, unnamed: Unnamed) -> LoadStep:
    named = {k: v for k, v in unnamed.items() if getattr(step, k) is not None}
    if not named:
        return step
    return step.model_copy(update={**dict.fromkeys(named), **dict(named.values())})
