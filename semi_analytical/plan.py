"""Which effects a scene calls for: the only place that asks what kind of scene this is."""

from dataclasses import dataclass
from math import ceil, hypot

from contact_scene import (
    Body,
    ControlKind,
    FrictionMap,
    IsotropicMaterial,
    LoadRamp,
    Scene,
)
from contact_scene.material import Material
from semi_analytical.errors import UnsupportedScene

# |beta| below this is round-off of equal materials given in different units.
UNCOUPLED = 1e-12

# The sine of an angle below this is round-off of a load that goes straight.
STRAIGHT = 1e-9

# Increments of a step whose path matters; errors fall as their inverse.
FIRST_LOADING = 15
PATH_INCREMENTS = 20
LARGEST_SHARE = 0.05
ROUND_OFF = 1e-9

# Of the shear moduli within a body: beyond, its influence coefficients lose the softest part.
MOST_CONTRAST = 1e12


@dataclass(frozen=True)
class Effect:
    """One effect, whether it acts in this scene, and the reason in one sentence."""

    name: str
    on: bool
    why: str


@dataclass(frozen=True)
class Plan:
    """What is computed for a scene. Effects that are off cost nothing downstream.

    shear       whether shear tractions are solved for
    coupling    whether pressure and shear act on each other's problem
    increments  how many increments each loading step takes
    effects     every effect with its reason, as shown to people
    """

    shear: bool
    coupling: bool
    increments: tuple[int, ...]
    effects: tuple[Effect, ...]


def plan(scene: Scene) -> Plan:
    """Decide the effects of a scene; raises UnsupportedScene for a layer on next to nothing."""
    friction = scene.friction is not None
    loaded = _tangentially_loaded(scene)
    couples, why = _coupling(scene)
    coupling = friction and couples
    shear = friction and (loaded or coupling)
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
        Effect(
            "normal-tangential coupling",
            coupling,
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
    return Plan(shear, coupling, _increments(scene, shear, coupling), effects)


def _increments(scene: Scene, shear: bool, coupling: bool) -> tuple[int, ...]:
    """As asked for; else one wherever the end of the step does not depend on its path."""
    counts = []
    sheared = coupling
    last = (0.0, 0.0)
    for ramp in scene.load_path():
        end = ramp.tangential.end
        sheared = sheared or any(end)
        pressing = ramp.normal.start != ramp.normal.end
        # Force and shift are nearly parallel, so that either tells where the other starts.
        start = ramp.tangential.start or last
        turning = _turns(start, end)
        shearing = coupling and start != end
        path_matters = shear and sheared and (pressing or turning or shearing)
        chosen = _path_increments(scene, ramp, start) if path_matters else 1
        counts.append(ramp.increments or chosen)
        last = end
    return tuple(counts)


def _turns(start: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether a load changes its direction, reversal and round-off apart."""
    cross = start[0] * end[1] - start[1] * end[0]
    return abs(cross) > STRAIGHT * hypot(*start) * hypot(*end)


def _path_increments(scene: Scene, ramp: LoadRamp, start: tuple[float, float]) -> int:
    """Fine enough for about one per cent of the shear (first order in the increment): first
    loading uniform in contact radius, T in parts of the friction limit where that is known."""
    if ramp.normal.start == 0:
        return FIRST_LOADING
    friction = scene.friction
    by_force = ramp.normal.kind is ramp.tangential.kind is ControlKind.FORCE
    if not by_force or friction is None or isinstance(friction.coefficient, FrictionMap):
        return PATH_INCREMENTS
    limit = friction.coefficient * ramp.normal.end
    end = ramp.tangential.end
    change = hypot(end[0] - start[0], end[1] - start[1])
    least = PATH_INCREMENTS if ramp.normal.start != ramp.normal.end else 1
    return max(least, ceil(change / (LARGEST_SHARE * limit) - ROUND_OFF)) if limit > 0 else least


def _coupling(scene: Scene) -> tuple[bool, str]:
    """Whether pressure moves the surfaces past each other, and why.

    For half-spaces Dundurs' beta decides (Dundurs 1969); a layer couples by itself unless the
    other body is its mirror image.
    """
    lower, upper = scene.body, scene.indenter
    if (lower.material, lower.layers) == (upper.material, upper.layers):
        return False, "the two bodies are alike: pressure moves both surfaces by the same amount"
    half_spaces = [_as_half_space(body) for body in (lower, upper)]
    if None in half_spaces:
        return True, "a coating moves sideways under pressure, and the other body does not follow"
    beta = _dundurs_beta(*half_spaces)
    text = f"Dundurs' beta is {beta:.2g}"
    if abs(beta) <= UNCOUPLED:
        return False, f"{text}: pressure does not move the surfaces past each other"
    return True, f"{text}: pressure moves the surfaces past each other"


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
        any(step.tangential_force or (0, 0)) or any(step.tangential_shift or (0, 0))
        for step in scene.loading
    )


def _why_shear(friction: bool, loaded: bool) -> str:
    if not friction:
        return "without friction the surfaces carry no shear"
    if not loaded:
        return "no step pushes sideways"
    return "a step names a tangential force or shift"


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
