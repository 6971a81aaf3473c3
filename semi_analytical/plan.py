"""Which effects a scene calls for: the only place that asks what kind of scene this is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from contact_scene import Scene, effect
from contact_scene.discretisation import PATH_ACCURACY, EdgeCorrection
from contact_scene.effect import Effect
from contact_scene.expected_contact import refuse_equator
from contact_scene.friction import FRICTIONLESS
from contact_scene.normal_form import normal_form
from contact_scene.pair import coupling, dundurs_beta, refuse_contrast
from semi_analytical.part import QUARTER, WHOLE, Part
from semi_analytical.path_increments import Bodies, StepIncrements, path_increments, refined

# Of the shear moduli within a body: beyond, its influence coefficients lose the softest part.
MOST_CONTRAST = 1e12

# Names of the effects that let a part of the window tell tractions, and that put edges inside.
MIRROR_PLANES = "mirror planes"
EDGES = "edge correction"
# Cost of the edge correction, on 64² to 256² cells.
EDGE_COST = "10 to 100 convolutions each time"


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
    edge        at the end of which increments edges are put inside the cells
    couples     whether edges of contact and stick are those of bodies that couple, not only
                computed as if they did
    quarter     whether pressures without shear are even about x = 0 and y = 0: a quarter of the
                window tells them
    told        the part of the window that then tells shear, too, and the pressure of bodies that
                couple
    effects     every effect with its reason, as shown to people
    """

    shear: bool
    tilt: bool
    torsion: bool
    coupling: Coupling
    path: tuple[StepIncrements, ...]
    effects: tuple[Effect, ...]
    edge: EdgeCorrection = "off"
    quarter: bool = False
    told: Part = WHOLE
    couples: bool = False

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


def plan(scene: Scene, path_accuracy: float = PATH_ACCURACY, edge: EdgeCorrection = "off") -> Plan:
    """Decide the effects of a scene; raises UnsupportedScene for a layer on next to nothing.

    path_accuracy  error of the shear that finite increments may leave, relative to Σµp
    edge           at the end of which increments edges shall be put inside the cells
    """
    scene = normal_form(scene)
    refuse_equator(scene)
    refuse_contrast(
        scene,
        MOST_CONTRAST,
        f"; stiffer than {MOST_CONTRAST:.0e} times the softest, a layer is as good as free or "
        "rigid",
    )
    friction = scene.friction is not None
    loaded = _tangentially_loaded(scene)
    couples, why = coupling(scene)
    coupled = scene.friction is not None and scene.friction.largest > 0 and couples
    shear = friction and (loaded or coupled)
    tilt = any(step.moment is not None or any(step.tilt or (0, 0)) for step in scene.loading)
    even = scene.indenter.is_even and not tilt
    torsion = shear and any(step.torque is not None or step.twist for step in scene.loading)
    told, what = _told(scene, shear, coupled, torsion)
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene, "a layer"),
        effect.friction(scene),
        Effect("tangential load", friction and loaded, _why_shear(friction, loaded)),
        Effect("tilt", tilt, _why_tilt(tilt)),
        Effect("torsion", torsion, _why_torsion(friction, torsion)),
        effect.coupled(scene, coupled, why),
        effect.load_history(len(scene.loading) > 1 and shear),
        Effect(MIRROR_PLANES, even, _why_even(even, tilt, what)),
        Effect(EDGES, *_edges(scene, edge, torsion)),
    )
    acting = Coupling.FULL if coupled else Coupling.NONE
    bodies = Bodies(coupled, dundurs_beta(scene), scene.friction or FRICTIONLESS)
    path = path_increments(scene, shear, bodies, path_accuracy)
    corrected = edge if effects[-1].on else "off"
    told = told if even else WHOLE
    return Plan(shear, tilt, torsion, acting, path, effects, corrected, even, told, couples=coupled)


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


def _told(scene: Scene, shear: bool, coupled: bool, torsion: bool) -> tuple[Part, str]:
    """The part of the window that tells the shear below an even indenter, too, and in words what
    parts of it tell."""
    alone = "first pressures" if coupled else "pressures"
    if not shear:
        return WHOLE, f"a quarter of the window tells {alone}"
    but = f"a quarter of the window tells {alone}, but not shear, for"
    if torsion:
        return WHOLE, f"{but} the indenter twists"
    if scene.friction is not None and not scene.friction.is_even:
        return WHOLE, f"{but} friction is not even"
    axes = {axis for ramp in scene.load_path() for axis in (0, 1) if ramp.tangential.end[axis]}
    if len(axes) > 1:
        return WHOLE, f"{but} not all loads push along the same axis"
    if not coupled:
        return (
            replace(QUARTER, along=axes.pop()),
            "a quarter of the window tells pressures and shear, at a third of the price",
        )
    if not axes:
        return QUARTER, "a quarter of the window tells pressures and shear, at a third of the price"
    pushed = axes.pop()
    return (
        Part((pushed == 1, pushed == 0)),
        f"a quarter of the window tells first pressures, and half of it, {'yx'[pushed]} > 0, "
        f"pressures and shear, at three fifths of the price",
    )


def _why_even(even: bool, tilt: bool, told: str) -> str:
    """Why parts of the window tell tractions, or not.

    told  which, below an even indenter
    """
    if tilt:
        return "the indenter tilts"
    if not even:
        return "the indenter does not say that it is even about x = 0 and y = 0"
    return f"even about x = 0 and y = 0: {told}, where its cell counts are even"


def _why_torsion(friction: bool, torsion: bool) -> str:
    if not friction:
        return "without friction the surfaces carry no torque"
    if torsion:
        return "a step names a torque or a twist"
    return "no step names a torque or a twist: the indenter is held from turning"


def _edges(scene: Scene, asked: EdgeCorrection, torsion: bool) -> tuple[bool, str]:
    """Whether edges are put inside the cells, and why (not)."""
    if asked == "off":
        return False, "not asked for: tractions are constant on cells up to their edges"
    if scene.indenter.rim is not None:
        return False, "below the rim of a flat punch the pressure rises to its edge"
    if torsion:
        return False, "not known of contacts that twist"
    if scene.friction is not None and scene.friction.uniform is None:
        return False, "the friction limit is not the same multiple of the pressure everywhere"
    when = "increment" if asked == "all" else "step"
    return True, f"at the end of each {when} tractions fall to zero inside the cells: {EDGE_COST}"
