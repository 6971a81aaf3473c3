"""Which effects a scene calls for: the only place that asks what kind of scene this is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from contact_scene import Body, FrictionMap, IsotropicMaterial, Scene
from contact_scene.discretisation import PATH_ACCURACY
from contact_scene.material import Material
from contact_scene.solver_errors import UnsupportedScene
from semi_analytical.path_increments import Bodies, StepIncrements, path_increments, refined

# |beta| below this is round-off of equal materials given in different units.
UNCOUPLED = 1e-12

# Of the shear moduli within a body: beyond, its influence coefficients lose the softest part.
MOST_CONTRAST = 1e12


# Name of the effect that couples the two problems.
COUPLING = "normal-tangential coupling"


@dataclass(frozen=True)
class Effect:
    """One effect, whether it acts in this scene, and the reason in one sentence."""

    name: str
    on: bool
    why: str


class Coupling(StrEnum):
    """Which of the two problems feels the tractions of the other."""

    NONE = "none"
    # Pressure moves the surfaces sideways, shear does not open or close the gap (Goodman 1962).
    ONE_WAY = "one way"
    FULL = "full"


@dataclass(frozen=True)
class Plan:
    """What is computed for a scene. Effects that are off cost nothing downstream.

    shear       whether shear tractions are solved for
    tilt        whether the indenter tilts, by its moments or as it is led
    torsion     whether it turns about z
    coupling    whether and how pressure and shear act on each other's problem
    path        how many increments each loading step takes, and why
    effects     every effect with its reason, as shown to people
    """

    shear: bool
    tilt: bool
    torsion: bool
    coupling: Coupling
    path: tuple[StepIncrements, ...]
    effects: tuple[Effect, ...]

    @property
    def increments(self) -> tuple[int, ...]:
        """How many increments each loading step takes."""
        return tuple(step.count for step in self.path)

    def refined(self, factor: int = 2) -> "Plan":
        """`factor` times as many increments in every step whose path matters."""
        return replace(self, path=refined(self.path, factor))

    def cut_into(self, increments: Sequence[int]) -> "Plan":
        """The same effects with these many increments in each step."""
        path = zip(self.path, increments, strict=True)
        return replace(self, path=tuple(replace(step, count=count) for step, count in path))


def plan(scene: Scene, path_accuracy: float = PATH_ACCURACY) -> Plan:
    """Decide the effects of a scene; raises UnsupportedScene for a layer on next to nothing.

    path_accuracy  error of the shear that finite increments may leave, relative to Σµp
    """
    friction = scene.friction is not None
    loaded = _tangentially_loaded(scene)
    couples, why = _coupling(scene)
    coupled = friction and couples
    shear = friction and (loaded or coupled)
    tilt = any(step.moment is not None or any(step.tilt or (0, 0)) for step in scene.loading)
    torsion = shear and any(step.torque is not None or step.twist for step in scene.loading)
    effects = (
        Effect("pressure", True, "the indenter is pressed on"),
        _second_body(scene),
        _layers(scene),
        Effect(
            "friction",
            friction,
            "[friction] is given" if friction else "the scene has no [friction]",
        ),
        Effect("tangential load", friction and loaded, _why_shear(friction, loaded)),
        Effect("tilt", tilt, _why_tilt(tilt)),
        Effect("torsion", torsion, _why_torsion(friction, torsion)),
        Effect(
            COUPLING,
            coupled,
            why if friction else "without shear there is nothing for the pressure to couple with",
        ),
        Effect(
            "load history",
            len(scene.loading) > 1 and shear,
            "slip depends on the path of several steps"
            if len(scene.loading) > 1 and shear
            else "the final state does not depend on the path",
        ),
    )
    coupling = Coupling.FULL if coupled else Coupling.NONE
    bodies = Bodies(coupled, _beta(scene), _friction(scene))
    path = path_increments(scene, shear, bodies, path_accuracy)
    return Plan(shear, tilt, torsion, coupling, path, effects)


def _coupling(scene: Scene) -> tuple[bool, str]:
    """Whether pressure moves the surfaces past each other, and why.

    For half-spaces Dundurs' beta decides (Dundurs 1969); a layer couples by itself unless the
    other body is its mirror image.
    """
    lower, upper = scene.body, scene.indenter
    if (lower.material, lower.layers) == (upper.material, upper.layers):
        return False, "the two bodies are alike: pressure moves both surfaces by the same amount"
    beta = _beta(scene)
    if beta is None:
        return True, "a coating moves sideways under pressure, and the other body does not follow"
    text = f"Dundurs' beta is {beta:.2g}"
    if abs(beta) <= UNCOUPLED:
        return False, f"{text}: pressure does not move the surfaces past each other"
    return True, f"{text}: pressure moves the surfaces past each other"


def _beta(scene: Scene) -> float | None:
    """Dundurs' constant of two half-spaces, None if one of them has layers."""
    half_spaces = [_as_half_space(body) for body in (scene.body, scene.indenter)]
    return None if None in half_spaces else _dundurs_beta(*half_spaces)


def _friction(scene: Scene) -> float | None:
    """µ where it is one number for the whole surface."""
    if scene.friction is None or isinstance(scene.friction.coefficient, FrictionMap):
        return None
    return scene.friction.coefficient


def _as_half_space(body: Body) -> Material | None:
    """The material of a body that is the same all through, else None."""
    alike = all(layer.material == body.material for layer in body.layers)
    return body.material if alike else None


def _dundurs_beta(lower: Material | None, upper: Material | None) -> float:
    """½ [(1-2ν1)/G1 - (1-2ν2)/G2] / [(1-ν1)/G1 + (1-ν2)/G2]; a rigid body has 1/G = 0."""
    difference = total = 0.0
    for sign, material in ((1, lower), (-1, upper)):
        if isinstance(material, IsotropicMaterial):
            nu, G = material.poisson_ratio, material.shear_modulus
            difference += sign * (1 - 2 * nu) / G
            total += (1 - nu) / G
    return 0.5 * difference / total


def _tangentially_loaded(scene: Scene) -> bool:
    return any(
        any(step.tangential_force or (0, 0))
        or any(step.tangential_shift or (0, 0))
        or bool(step.torque or step.twist)
        for step in scene.loading
    )


def _why_shear(friction: bool, loaded: bool) -> str:
    if not friction:
        return "without friction the surfaces carry no shear"
    if not loaded:
        return "no step pushes sideways or twists"
    return "a step names a tangential force or shift, a torque or a twist"


def _why_tilt(tilt: bool) -> str:
    if tilt:
        return "a step names a moment or a tilt"
    return "no step names a moment or a tilt: the indenter is held upright"


def _why_torsion(friction: bool, torsion: bool) -> str:
    if not friction:
        return "without friction the surfaces carry no torque"
    if torsion:
        return "a step names a torque or a twist"
    return "no step names a torque or a twist: the indenter is held from turning"


def _second_body(scene: Scene) -> Effect:
    both = scene.body.deforms and scene.indenter.deforms
    if both:
        return Effect("second elastic body", True, "both bodies deform; their compliances add")
    rigid = "indenter" if scene.body.deforms else "body"
    return Effect("second elastic body", False, f"the {rigid} is rigid")


def _layers(scene: Scene) -> Effect:
    _refuse_free_layers(scene)
    where = [
        f"the {name} has {_count(len(body.layers))}"
        for name, body in (("body", scene.body), ("indenter", scene.indenter))
        if body.layers
    ]
    return Effect("layers", bool(where), " and ".join(where) or "no body has layers")


def _refuse_free_layers(scene: Scene) -> None:
    """A layer on next to nothing is a free plate, which moves without bound."""
    for name, body in (("body", scene.body), ("indenter", scene.indenter)):
        materials = [layer.material for layer in body.layers]
        if isinstance(body.material, IsotropicMaterial):
            materials.append(body.material)
        moduli = [material.shear_modulus for material in materials]
        if moduli and max(moduli) > MOST_CONTRAST * min(moduli):
            raise UnsupportedScene(
                f"the materials of the {name} have shear moduli from {min(moduli):.3g} to "
                f"{max(moduli):.3g} Pa; stiffer than {MOST_CONTRAST:.0e} times the softest, a "
                f"layer is as good as free or rigid; name a rigid base, or leave the soft part out"
            )


def _count(layers: int) -> str:
    return "a layer" if layers == 1 else f"{layers} layers"
