"""Plans other than the one that a scene calls for: to see what an effect is worth, and its cost."""

from dataclasses import replace

from contact_scene.effect import COUPLING, Effect
from semi_analytical.operator.domain import WINDOW
from semi_analytical.plan import EDGES, MIRROR_PLANES, Coupling, Plan

# Names of the effects that can be computed where they vanish.
COMPUTED = ("tangential load", "tilt", "torsion", COUPLING)


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
