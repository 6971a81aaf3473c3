"""What is known of the error of each quantity on cells, by measurement.

With f on cells of side h and f' on cells of side 2h the error by cells is about
d = |f - f'|/(2^p - 1) (Richardson) and, since it also depends on where the edge lies within a cell,
scatters about an envelope e that falls with the cells per radius:

    error by cells = C sqrt((w e² + d²)/(w + 1))

and with half the increments, Δ = |f(n) - f(n/2)|,

    error by increments = P sqrt(Δ² + (s e)²)

Energies that are lost add up over the steps: e is the sum of what every step has lost times its own
envelope, for a slip annulus that widens again takes nothing back. They are also charged by their
increments with a g (`semi_analytical.energy`), whose true error is .01 to .3 of it:

    error by increments = min(g, sqrt((P Δ)² + (c g)²))

Orders, envelopes and factors are those with which at least 95 of 100 drawn scenes are covered;
`slipstick maintain study error-coverage` judges them by scenes that they were not drawn from.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum, auto

from contact_scene.geometry import ShapedBody, SmoothTip


class Lengthscale(Enum):
    """What in a contact a quantity is resolved by, in cells."""

    CONTACT = auto()  # contact radius m
    FILM = auto()  # contact radius, or the thinnest layer if that is thinner; elements: √ of both
    STICK = auto()  # stick radius
    CUSP = auto()  # contact radius; the stick zone has to be resolved, which rounds off the cusp
    SLIP = auto()  # contact radius, and width w of the slip annulus: m/√(1 + 1/w)
    ANNULUS = auto()  # the same two alike: √(m w)
    TURN = auto()  # contact radius; what scatters is the place of the load in a cell
    TURN_WITHIN = auto()  # the same of states with their edges inside the cells
    LOST = auto()  # m places around an annulus of w: (m w⁴)^1/5


@dataclass(frozen=True)
class Rule:
    """The law of one quantity.

    order            p of the error in h
    envelope         coefficient of the scatter e = envelope m^-p, m cells per length scale,
                     relative to the largest value so far, of a turn to its natural size: of a tilt
                     the approach over the contact radius
    weight           w, how much the envelope counts beside the difference
    factor           C
    path_factor      P
    path_scatter     s
    charge           c; 1 where g alone counts
    least            of e, below which no error is stated: a small difference may be chance
    floor            of the number over itself, what no number of cells takes away
    lengthscale      what m counts
    """

    order: float
    envelope: float
    weight: float
    factor: float
    path_factor: float = 3.0
    path_scatter: float = 0.1
    lengthscale: Lengthscale = Lengthscale.CONTACT
    charge: float = 1.0
    least: float = 0.0
    floor: float = 0.0

    def scatter(self, cells: float) -> float:
        """The envelope with so many cells per length scale [1]."""
        return self.envelope * cells**-self.order


PEAK = Rule(2, 0.25, 0.5, 1.2, path_factor=2.0)
APPROACH = Rule(2, 0.05, 1, 1.8, path_factor=1.5)
RADIUS = Rule(1.25, 0.22, 4, 1.5, path_factor=1.5, lengthscale=Lengthscale.FILM)
STICK = Rule(1.25, 0.25, 4, 3.2, 2.0, 1.0, Lengthscale.STICK)
SHIFT = Rule(2, 0.06, 2, 1.35, 3.0, 0.3, Lengthscale.SLIP)
TWIST = Rule(2, 0.24, 9, 1.3, 3.0, 0.3, Lengthscale.SLIP)
# The scatter of a ring w wide, 1/w², averages over the m cells around it.
ENERGY = Rule(2.5, 0.3, 4, 1.65, 2.0, 0.0, Lengthscale.LOST, charge=0.1)
TILT = Rule(2.25, 0.12, 9, 0.9, path_factor=1.5, lengthscale=Lengthscale.TURN)
# Slip is largest at the edge of the contact, where a cell may lie within or beyond.
AMPLITUDE = Rule(1, 0.5, 8, 1.38, lengthscale=Lengthscale.ANNULUS)
RUIZ_F1 = Rule(1.5, 0.5, 4, 1.75, lengthscale=Lengthscale.ANNULUS)
# Tension at the edge of the contact times slip; on few cells always too low, and by chance alike.
RUIZ_F2 = Rule(1, 3.0, 4, 2.2)
# Stress at the surface and near it, largest at an edge of the tractions.
TENSION = Rule(0.5, 0.0, 0, 1.6)
# Stress at an edge that was fitted, by what two fits differ beyond what they always do.
AT_EDGE = Rule(1, 0.0, 0, 3.0, floor=6e-4)
# Stress inside, where it would be largest between the points.
INTERIOR = Rule(2, 0.0, 0, 0.6)


# Numbers that follow the law of another, and the squares of others.
ALIKE = {
    "normal_force": "approach",
    "tangential_force": "tangential_shift",
    "torque": "twist",
    "moment": "tilt",
    "energy_per_cycle": "dissipated_energy",
}
SQUARES = {"contact_area": "contact_radius", "stick_area": "stick_radius"}


def with_their_likes(rules: Mapping[str, Rule]) -> dict[str, Rule]:
    """Rules by the number, and of those that follow from them unless they have their own."""
    alike = {name: rules[of] for name, of in ALIKE.items() if of in rules}
    squares = {
        name: replace(rules[of], envelope=2 * rules[of].envelope)
        for name, of in SQUARES.items()
        if of in rules
    }
    return alike | squares | dict(rules)


RULES = with_their_likes(
    {
        "normal_force": replace(APPROACH, envelope=0.1),
        "approach": APPROACH,
        "contact_radius": RADIUS,
        "peak_pressure": PEAK,
        "tangential_shift": SHIFT,
        "twist": TWIST,
        "tilt": TILT,
        "stick_radius": STICK,
        "dissipated_energy": ENERGY,
        "elastic_energy": replace(APPROACH, envelope=0.1, factor=1.15),
        "input_work": replace(SHIFT, envelope=0.12),
        "slip_amplitude": AMPLITUDE,
        "ruiz_f1": RUIZ_F1,
        "ruiz_f2": RUIZ_F2,
    }
)

# Of states with their edges inside the cells, on these as on those of the companion.
EDGES = with_their_likes(
    {
        "stick_radius": Rule(1.5, 0.0045, 9, 1.0, 2.0, 1.0, Lengthscale.STICK),
        "approach": Rule(2, 0.0027, 9, 0.45, path_factor=1.5),
        "contact_radius": Rule(2.5, 0.019, 2, 1.95, path_factor=1.5),
        "peak_pressure": Rule(3, 0.08, 9, 0.6, path_factor=2.0),
        "tilt": Rule(3, 0.0145, 2, 1.4, path_factor=1.5, lengthscale=Lengthscale.TURN_WITHIN),
    }
)
# With the law of a film, whose fits are wider (balls on films of 1/4 to 10 times their base's
# modulus, on 0.2 to 13 cells).
ON_FILM = with_their_likes(
    {
        "approach": Rule(2.5, 0.006, 1, 1.45, path_factor=1.5),
        "contact_radius": Rule(2, 0.0275, 0.1, 1.7, path_factor=1.5),
        "peak_pressure": Rule(2.5, 0.009, 1, 1.1, path_factor=2.0),
        "tilt": Rule(3, 0.0165, 9, 1.8, path_factor=1.5, lengthscale=Lengthscale.TURN_WITHIN),
    }
)
# On these alone: what such a companion tells is its own error, and of few cells across a film.
UNTOLD = 1e6
ALONE = EDGES | with_their_likes(
    {
        "approach": Rule(2.5, 0.007, UNTOLD, 1.2, 1.5, lengthscale=Lengthscale.FILM),
        "contact_radius": Rule(2.5, 0.3, UNTOLD, 1.2, 1.5, lengthscale=Lengthscale.FILM),
        "peak_pressure": Rule(2.5, 0.02, UNTOLD, 1.2, 2.0, lengthscale=Lengthscale.FILM),
        "tilt": Rule(2.5, 0.1, UNTOLD, 1.2, 1.5, lengthscale=Lengthscale.FILM),
        "stick_radius": replace(EDGES["stick_radius"], weight=UNTOLD),
    }
)
# Without layers the pressure is a cap. The mean of its highest cell is 0.02 m^-2 too low with the
# axis in its middle, 0.24 m^-2 with it at a corner, whatever cells twice as wide say.
CAP = {"peak_pressure": replace(PEAK, least=1.0)}
# Where friction acts back on a pressing contact its pressure has a cusp on the axis.
CUSP = {"peak_pressure": replace(PEAK, order=1, factor=1.65, lengthscale=Lengthscale.CUSP)}
# Where bodies couple, of states with their edges inside the cells: the cusp and the front of a
# stick zone that grows remain those of cells. Pushed, they have stick near the edge on one side,
# farther in on the other (rigid balls and ellipsoids on bare and coated bodies, 11 to 29 cells per
# radius: at most 0.07 m^-3/2).
COUPLED = with_their_likes(
    {
        "approach": Rule(2, 0.005, 1, 1.5, path_factor=1.5),
        "contact_radius": Rule(1.5, 0.06, 2, 1.4, path_factor=1.5),
    }
)
# On these alone, no less.
COUPLED_ALONE = ALONE | with_their_likes(
    {
        "approach": Rule(2, 0.006, UNTOLD, 1.2, 1.5, lengthscale=Lengthscale.FILM),
        "contact_radius": Rule(1.5, 0.06, UNTOLD, 1.2, 1.5, lengthscale=Lengthscale.FILM),
    }
)
# A rim lies within cells: whatever holds the indenter is off as the radius a that the cells make of
# it is, motions and energies with 1/a, rotations with 1/a³.
RIM = Rule(1, 0.2, 8, 1.45, path_factor=1.5)
RIM_TURNED = replace(RIM, envelope=0.6)
FLAT = with_their_likes(
    {
        "approach": RIM,
        "tangential_shift": replace(RIM, path_factor=3.0, path_scatter=0.3),
        "twist": replace(RIM_TURNED, path_factor=3.0, path_scatter=0.3),
        "tilt": RIM_TURNED,
        "elastic_energy": RIM,
        "input_work": replace(RIM, path_factor=3.0, path_scatter=0.3),
    }
)
CONE = with_their_likes({"contact_radius": Rule(1.25, 1.0, 4, 1.2, path_factor=1.5)})
# Infinite in the exact answer: no number of cells has an error.
INFINITE = frozenset({"peak_pressure"})


def rules_for(
    indenter: ShapedBody,
    cusp: bool,
    edges: bool = False,
    alone: bool = False,
    layers: bool = True,
    film: bool = False,
    border: bool = True,
) -> Mapping[str, Rule]:
    """The rule of every quantity below an indenter; none of what is infinite in the exact answer.

    cusp    whether friction acts back on the pressure
    edges   whether they are inside the cells
    alone   whether they are not inside those of a companion
    layers  whether a body has any
    film    whether edges are fitted with the law of one
    border  whether the stick border of uncoupled bodies is inside the cells, too
    """
    with_edges = ALONE if alone else EDGES | ON_FILM if film else EDGES
    if cusp:
        with_edges = CUSP | {name: (COUPLED_ALONE if alone else COUPLED)[name] for name in COUPLED}
    elif not border:
        with_edges |= {name: RULES[name] for name in ("stick_radius", "stick_area")}
    without = CAP if isinstance(indenter, SmoothTip) and not layers else {}
    rules = RULES | (with_edges if edges else CUSP if cusp else without)
    if indenter.rim is not None:
        rules = RULES | FLAT
    elif indenter.gap_exponent == 1:
        rules = RULES | CONE
    else:
        return rules
    return {name: rule for name, rule in rules.items() if name not in INFINITE}
