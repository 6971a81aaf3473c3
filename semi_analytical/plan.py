"""Which effects a scene calls for: the only place that asks what kind of scene this is."""

from dataclasses import dataclass

from contact_scene import Body, IsotropicMaterial, Scene
from semi_analytical.errors import UnsupportedScene

# |beta| below this is round-off of equal materials given in different units.
UNCOUPLED = 1e-12

# Increments of a step whose path matters: T changes by about 0.05 µW in each.
PATH_INCREMENTS = 20


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
    increments  how many increments each loading step takes
    effects     every effect with its reason, as shown to people
    """

    shear: bool
    increments: tuple[int, ...]
    effects: tuple[Effect, ...]


def plan(scene: Scene) -> Plan:
    """Decide the effects of a scene; raises UnsupportedScene for a combination we do not have."""
    beta = normal_tangential_coupling(scene)
    friction = scene.friction is not None
    loaded = _tangentially_loaded(scene)
    shear = friction and loaded
    if friction and abs(beta) > UNCOUPLED:
        raise UnsupportedScene(
            f"friction between bodies whose normal and tangential problems couple (Dundurs' "
            f"beta = {beta:.4g}) arrives with the coupled solver; remove [friction], or use "
            f"bodies with equal (1 - 2 nu) / G, such as two identical ones"
        )
    effects = (
        Effect("pressure", True, "the indenter is pressed on"),
        _second_body(scene),
        _layers(scene),
        Effect(
            "friction",
            friction,
            "[friction] is given" if friction else "the scene has no [friction]",
        ),
        Effect("tangential load", shear, _why_shear(friction, loaded)),
        Effect("normal-tangential coupling", False, _why_no_coupling(friction, beta)),
        Effect(
            "load history",
            len(scene.loading) > 1 and shear,
            "slip depends on the path of several steps"
            if len(scene.loading) > 1 and shear
            else "the final state does not depend on the path",
        ),
    )
    return Plan(shear, _increments(scene, shear), effects)


def _increments(scene: Scene, shear: bool) -> tuple[int, ...]:
    """As asked for; else one wherever the end of the step does not depend on its path."""
    counts = []
    sheared = False
    last = (0.0, 0.0)
    for ramp in scene.load_path():
        end = ramp.tangential.end
        sheared = sheared or any(end)
        pressing = ramp.normal.start != ramp.normal.end
        # Force and shift are nearly parallel, so that either tells where the other starts.
        turning = _turns(ramp.tangential.start or last, end)
        path_matters = shear and sheared and (pressing or turning)
        counts.append(ramp.increments or (PATH_INCREMENTS if path_matters else 1))
        last = end
    return tuple(counts)


def normal_tangential_coupling(scene: Scene) -> float:
    """Dundurs' beta of the two substrates (Dundurs 1969), zero if they are uncoupled.

    beta = ½ [(1-2ν1)/G1 - (1-2ν2)/G2] / [(1-ν1)/G1 + (1-ν2)/G2]; a rigid body has 1/G = 0.
    """
    difference = _coupling(scene.body) - _coupling(scene.indenter)
    return 0.5 * difference / (_compliance(scene.body) + _compliance(scene.indenter))


def _compliance(body: Body) -> float:
    m = body.material
    return (1 - m.poisson_ratio) / m.shear_modulus if isinstance(m, IsotropicMaterial) else 0.0


def _coupling(body: Body) -> float:
    m = body.material
    return (1 - 2 * m.poisson_ratio) / m.shear_modulus if isinstance(m, IsotropicMaterial) else 0.0


def _tangentially_loaded(scene: Scene) -> bool:
    return any(
        any(step.tangential_force or (0, 0)) or any(step.tangential_shift or (0, 0))
        for step in scene.loading
    )


def _why_shear(friction: bool, loaded: bool) -> str:
    if not friction:
        return "without friction the surfaces carry no shear"
    if not loaded:
        return "no step pushes sideways, and pressing alone leaves no shear"
    return "a step names a tangential force or shift"


def _why_no_coupling(friction: bool, beta: float) -> str:
    if not friction:
        return "without shear there is nothing for the pressure to couple with"
    return f"Dundurs' beta is {abs(beta):.2g}: pressure does not move the surfaces sideways"


def _second_body(scene: Scene) -> Effect:
    both = scene.body.deforms and scene.indenter.deforms
    if both:
        return Effect("second elastic body", True, "both bodies deform; their compliances add")
    rigid = "indenter" if scene.body.deforms else "body"
    return Effect("second elastic body", False, f"the {rigid} is rigid")


def _layers(scene: Scene) -> Effect:
    if scene.body.layers or scene.indenter.layers:
        raise UnsupportedScene(
            "layered bodies arrive with the layered influence coefficients; remove the layers"
        )
    return Effect("layers", False, "no body has layers")


def _turns(start: tuple[float, float], end: tuple[float, float]) -> bool:
    """Whether the direction of a tangential load changes within a step."""
    return start[0] * end[1] != start[1] * end[0]
