"""Which effects a scene calls for: the only place that asks what kind of scene this is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from contact_scene import Scene, effect
from contact_scene.body_pair import (
    coupling,
    dundurs_beta,
    refuse_contrast,
)
from contact_scene.checks.expected_contact import refuse_equator
from contact_scene.discretisation import PATH_ACCURACY, EdgeCorrection
from contact_scene.effect import COUPLING, Effect
from contact_scene.friction import FRICTIONLESS
from contact_scene.normal_form import normal_form
from semi_analytical.increment_counts import (
    Bodies,
    StepIncrements,
    path_increments,
)
from semi_analytical.operator.domain import QUARTER, WINDOW, ReducedDomain

# Of the shear moduli within a body: beyond, its influence coefficients lose the softest part.
MAX_CONTRAST = 1e12

# Names of the effects of a reduced domain and of edges inside the cells.
MIRROR_PLANES = "mirror planes"
EDGES = "edge correction"
# Cost of the edge correction, on 64² to 256² cells.
EDGE_COST = "10 to 100 convolutions each time"

# Names of the effects that can be computed where they vanish.
COMPUTED = ("tangential load", "tilt", "torsion", COUPLING)


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
    symmetry    the domain that tractions are solved on
    effects     every effect with its reason, as shown to people
    """

    shear: bool
    tilt: bool
    torsion: bool
    coupling: Coupling
    path: tuple[StepIncrements, ...]
    effects: tuple[Effect, ...]
    edge: EdgeCorrection = "off"
    symmetry: ReducedDomain = WINDOW
    couples: bool = False

    @property
    def increments(self) -> tuple[int, ...]:
        """How many increments each loading step takes."""
        return tuple(step.count for step in self.path)

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
        MAX_CONTRAST,
        f"; stiffer than {MAX_CONTRAST:.0e} times the softest, a layer is as good as free or rigid",
    )
    friction = scene.friction is not None
    loaded = _tangentially_loaded(scene)
    couples, why = coupling(scene)
    coupled = scene.friction is not None and scene.friction.largest > 0 and couples
    strained = any(ramp.stretch for ramp in scene.load_path())
    shear = friction and (loaded or coupled or strained)
    tilt = any(step.moment is not None or any(step.tilt or (0, 0)) for step in scene.loading)
    torsion = shear and any(step.torque is not None or step.twist for step in scene.loading)
    symmetry, why_symmetry = _symmetry(scene, shear, coupled, tilt, torsion)
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene),
        effect.friction(scene),
        Effect("tangential load", friction and loaded, _why_shear(friction, loaded)),
        Effect("tilt", tilt, _why_tilt(tilt)),
        Effect("torsion", torsion, _why_torsion(friction, torsion)),
        effect.strained(scene),
        effect.coupled(scene, coupled, why),
        effect.load_history(len(scene.loading) > 1 and shear),
        Effect(MIRROR_PLANES, symmetry != WINDOW, why_symmetry),
        Effect(EDGES, *_edges(scene, edge, torsion)),
    )
    acting = Coupling.FULL if coupled else Coupling.NONE
    bodies = Bodies(coupled, dundurs_beta(scene), scene.friction or FRICTIONLESS)
    path = path_increments(scene, shear, bodies, path_accuracy)
    corrected = edge if effects[-1].on else "off"
    return Plan(shear, tilt, torsion, acting, path, effects, corrected, symmetry, couples=coupled)


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


def _symmetry(
    scene: Scene, shear: bool, coupled: bool, tilt: bool, torsion: bool
) -> tuple[ReducedDomain, str]:
    """Choose the domain, and state why.

    A plane is a mirror plane if it preserves the shear of all loads, or reverses that of all.
    """
    if tilt:
        return WINDOW, "the indenter tilts"
    if not scene.indenter.is_even:
        return WINDOW, "the indenter does not declare symmetry about x = 0 and y = 0"
    even = "symmetric about x = 0 and y = 0, with even numbers of cells: "
    if not shear:
        return QUARTER, even + "solved on a quarter of the window"
    if scene.friction is not None and not scene.friction.is_even:
        return WINDOW, "friction is not symmetric about x = 0 and y = 0"
    ramps = list(scene.load_path())
    pushed = {axis for ramp in ramps for axis in (0, 1) if ramp.tangential.end[axis]}
    if torsion and pushed:
        return WINDOW, "the indenter twists and is pushed"
    signs = {(-1, 1) if axis == 0 else (1, -1) for axis in pushed}
    strains = [ramp.stretch[1] for ramp in ramps if ramp.stretch]
    signs |= {(-1, -1)} if torsion or any(xy for *_, xy in strains) else set()
    signs |= {(1, 1)} if coupled or not signs or any(xx or yy for xx, yy, _ in strains) else set()
    x, y = (len({sign[axis] for sign in signs}) == 1 for axis in (0, 1))
    if not (x or y):
        return WINDOW, "the loads have no mirror plane in common"
    (s_x, s_y), *_ = signs
    found = ReducedDomain((x, y), (s_x if x else 1, s_y if y else 1))
    return found, even + f"solved on {'a quarter' if x and y else 'half'} of the window"


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


def all_effects(plan: Plan) -> Plan:
    """Everything computed, called for or not: the answer is the same, the cost is not."""
    return replace(
        plan,
        shear=True,
        tilt=True,
        torsion=True,
        coupling=Coupling.FULL,
        symmetry=WINDOW,
        effects=tuple(_forced(effect) for effect in plan.effects),
    )


def one_way(plan: Plan) -> Plan:
    """Pressure moves the surfaces sideways, shear does not act on the pressure (Goodman 1962).

    An approximation of bodies that couple; others it leaves as they are, at a higher cost.
    """
    why = "asked for: pressure acts on the shear problem, shear not on the pressure problem"
    effects = [replace(e, on=True, why=why) if e.name == COUPLING else e for e in plan.effects]
    edge = plan.edge
    if plan.couples:
        unknown = "not known of bodies of which one way of coupling is left out"
        effects = [replace(e, on=False, why=unknown) if e.name == EDGES else e for e in effects]
        edge = "off"
    return replace(
        plan,
        shear=True,
        coupling=Coupling.ONE_WAY,
        edge=edge,
        symmetry=plan.symmetry if plan.coupling is Coupling.FULL else WINDOW,
        couples=False,
        effects=tuple(effects),
    )


def _forced(effect: Effect) -> Effect:
    """An effect that is computed although it is off says so, and what is not made use of, too."""
    if effect.name == MIRROR_PLANES and effect.on:
        return replace(effect, on=False, why=f"not made use of, though {effect.why}")
    if effect.name not in COMPUTED or effect.on:
        return effect
    return replace(effect, on=True, why=f"forced on, though {effect.why}")
