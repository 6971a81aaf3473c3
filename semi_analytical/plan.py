"""Decision on the effects that a scene requires. No other module examines the kind of a scene.

An effect is, for example, friction, tilt or the coupling of normal and tangential problem.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Literal

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

# Largest ratio of shear moduli within a body: beyond it the contribution of the softest material to
# the influence coefficients is below round-off.
MAX_CONTRAST = 1e12

# Names of the effects of symmetry reduction and edge correction.
MIRROR_PLANES = "mirror planes"
EDGES = "edge correction"
# Cost of the edge correction, on 64² to 256² cells.
EDGE_COST = "10 to 100 convolutions each time"

# Names of the effects that can also be computed if they vanish.
COMPUTED = ("tangential load", "tilt", "torsion", COUPLING)


class Coupling(StrEnum):
    """Coupling of the normal and the tangential problem in the solution of a scene: none or full.

    Pressure displaces the surfaces tangentially, and shear normally, if the bodies are dissimilar.
    """

    NONE = "none"
    FULL = "full"


@dataclass(frozen=True)
class Plan:
    """Physical effects that the solution of a scene includes, and its increments per load step.

    Effects that are off cause no cost.

    shear     True if shear tractions are solved for
    tilt      True if the indenter tilts, by prescribed moments or tilts
    torsion   True if the indenter rotates about z
    coupling  coupling of the normal and the tangential problem
    path      number of increments of each load step, with reasons
    effects   every effect with its reason, as displayed
    edge      increments at whose end the edge correction (contact edges inside cells) is applied
    symmetry  symmetry reduction: domain of the solution
    couples   True if the edge correction is that of coupled bodies; False for uncoupled bodies with
              forced coupling
    stiffness  True if the contact stiffnesses are computed at the end of each load step
    areas     increments at whose end the areas of contact and stick zone are resolved below the
              cell size; "last" increments of the load steps suffice for error estimates
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
    areas: Literal["all", "last"] = "all"
    stiffness: bool = False

    @property
    def increments(self) -> tuple[int, ...]:
        """Number of increments of each load step in the solution."""
        return tuple(step.count for step in self.path)

    def cut_into(self, increments: Sequence[int]) -> "Plan":
        """Return a copy of the plan with given numbers of increments.

        Used for solves with coarser or finer increments.

        increments  number of increments of each load step
        """
        path = zip(self.path, increments, strict=True)
        return replace(self, path=tuple(replace(step, count=count) for step, count in path))


def plan(scene: Scene, path_accuracy: float = PATH_ACCURACY, edge: EdgeCorrection = "off") -> Plan:
    """Decide which physical effects to compute for a scene, and the increments of each load step.

    Effects are, for example, shear, tilt, torsion, coupling and the symmetry reduction.

    scene          scene to solve
    path_accuracy  allowed increment error of the shear, relative to Σµp
    edge           increments at whose end the edge correction is requested
    raises         UnsupportedScene for a body with a ratio of shear moduli above MAX_CONTRAST, and
                   for a sphere that is pressed to its equator
    """
    scene = normal_form(scene)
    refuse_equator(scene)
    refuse_contrast(
        scene,
        MAX_CONTRAST,
        f"; above a modulus ratio of {MAX_CONTRAST:.0e} a layer is as good as free or rigid",
    )
    friction = scene.friction is not None
    loaded = _tangentially_loaded(scene)
    couples, why = coupling(scene)
    coupled = scene.friction is not None and scene.friction.largest > 0 and couples
    strained = any(ramp.stretch for ramp in scene.load_path())
    shear = friction and (loaded or coupled or strained)
    tilt = any(step.moment is not None or any(step.tilt or (0, 0)) for step in scene.loading)
    torsion = shear and any(step.torque is not None or step.twist for step in scene.loading)
    symmetry, why_symmetry = _choose_symmetry(scene, shear, coupled, tilt, torsion)
    effects = (
        effect.PRESSURE,
        effect.second_body(scene),
        effect.layers(scene),
        effect.friction(scene),
        _prescribed_effect("tangential load", loaded, "a tangential load or torsion", friction),
        _prescribed_effect("tilt", tilt, "a moment or a tilt"),
        _prescribed_effect("torsion", torsion, "a torque or a twist", friction),
        effect.strained(scene),
        effect.coupled(scene, coupled, why),
        effect.load_history(len(scene.loading) > 1 and shear),
        Effect(MIRROR_PLANES, symmetry != WINDOW, why_symmetry),
        Effect(EDGES, *_decide_edge_correction(scene, edge, coupled, torsion)),
    )
    acting = Coupling.FULL if coupled else Coupling.NONE
    bodies = Bodies(coupled, dundurs_beta(scene), scene.friction or FRICTIONLESS)
    path = path_increments(scene, shear, bodies, path_accuracy)
    corrected = edge if effects[-1].on else "off"
    return Plan(
        shear,
        tilt,
        torsion,
        acting,
        path,
        effects + effect.contact_stiffness(scene),
        corrected,
        symmetry,
        couples=coupled,
        stiffness=bool(scene.contact_stiffness) and not scene.indenter.is_line,
    )


def _tangentially_loaded(scene: Scene) -> bool:
    """Return True if a load step prescribes a tangential force or shift, a torque or a twist."""
    return any(
        any(step.tangential_force or (0, 0))
        or any(step.tangential_shift or (0, 0))
        or bool(step.torque or step.twist)
        for step in scene.loading
    )


def _prescribed_effect(name: str, on: bool, loads: str, friction: bool = True) -> Effect:
    """Describe an effect that is on if load steps prescribe certain loads, with the reason."""
    if not friction:
        return Effect(name, False, "without friction the surfaces carry no shear")
    return Effect(name, on, f"{'a' if on else 'no'} load step prescribes {loads}")


def _choose_symmetry(
    scene: Scene, shear: bool, coupled: bool, tilt: bool, torsion: bool
) -> tuple[ReducedDomain, str]:
    """Choose the symmetry reduction of a scene: quarter, half or full window; state the reason.

    A plane x = 0 or y = 0 is a mirror plane if it preserves the shear of all loads, or reverses
    that of all loads.

    shear, coupled  True if shear is solved for; True if normal and tangential problem are coupled
    tilt, torsion   True if the indenter tilts; True if it rotates about z
    """
    if tilt:
        return WINDOW, "the indenter tilts"
    if scene.indenter.is_line:
        return WINDOW, "strips of a line contact are solved on the full window"
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
        return WINDOW, "tangential load and torsion act together"
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


def _decide_edge_correction(
    scene: Scene, asked: EdgeCorrection, coupled: bool, torsion: bool
) -> tuple[bool, str]:
    """Decide if the edge correction is applied to a scene, and state the reason.

    The edge correction accounts for contact edges inside cells.

    asked    requested edge correction: "off", or the increments at whose end it is applied
    coupled  True if the friction of the scene changes its pressure
    torsion  True if the scene has torsion
    """
    if asked == "off":
        return False, "not requested: tractions are constant on every cell"
    if scene.indenter.is_line:
        return False, "not needed: widths are fitted, and other errors are of second order"
    if scene.indenter.rim is not None:
        return False, "the pressure of a flat punch is singular at its rim"
    if torsion:
        return False, "not available with torsion"
    if coupled and scene.friction is not None and scene.friction.uniform is None:
        return False, "the friction limit of coupled bodies is not a constant times the pressure"
    when = "increment" if asked == "all" else "load step"
    return True, f"tractions vanish within edge cells at the end of each {when}: {EDGE_COST}"


def all_effects(plan: Plan) -> Plan:
    """Return a plan in which all physical effects are computed, although some of them vanish.

    The results are equal at a higher cost. Used to verify that switched-off effects do not change
    the results.

    plan  plan that a scene requires
    """
    return replace(
        plan,
        shear=True,
        tilt=True,
        torsion=True,
        coupling=Coupling.FULL,
        symmetry=WINDOW,
        effects=tuple(_forced_effect(effect) for effect in plan.effects),
    )


def _forced_effect(effect: Effect) -> Effect:
    """Describe an effect of a plan that computes all effects and uses no symmetry reduction."""
    if effect.name == MIRROR_PLANES and effect.on:
        return replace(effect, on=False, why=f"not used, although {effect.why}")
    if effect.name not in COMPUTED or effect.on:
        return effect
    return replace(effect, on=True, why=f"forced on, although {effect.why}")
