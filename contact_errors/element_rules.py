"""What is known of the error of each quantity of finite elements, by measurement.

The laws are those of `rules`, with elements in the place of cells. Pressure, approach and shift
converge with the square of the elements; edges, which are found between the rings, scatter with
their place in an element.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from contact_errors.rules import FLAT, INFINITE, Lengthscale, Rule, with_their_likes
from contact_scene.geometry import ShapedBody

PEAK = Rule(2, 0.25, 8, 1.85, path_factor=2.0)
APPROACH = Rule(2, 0.13, 1, 1.5, path_factor=1.5)
RADIUS = Rule(2, 0.2, 4, 4.8, path_factor=1.5, lengthscale=Lengthscale.FILM)
STICK = Rule(1, 0.06, 2, 2.4, 2.0, 1.0, Lengthscale.STICK)
SHIFT = Rule(2, 0.1, 1, 5.0, 3.0, 0.3, Lengthscale.SLIP)
TWIST = Rule(2, 1.8, 4, 2.0, 3.0, 0.3, Lengthscale.SLIP)
ENERGY = Rule(1.5, 0.27, 8, 1.9, 2.0, 0.0, Lengthscale.ANNULUS, charge=0.1)

RULES = with_their_likes(
    {
        "normal_force": replace(APPROACH, envelope=0.26),
        "approach": APPROACH,
        "contact_radius": RADIUS,
        "peak_pressure": PEAK,
        "tangential_shift": SHIFT,
        "twist": TWIST,
        "stick_radius": STICK,
        "dissipated_energy": ENERGY,
        "elastic_energy": replace(APPROACH, envelope=0.26),
        "input_work": replace(SHIFT, envelope=0.26),
        # Rings are wide: the slip of the last one is that of its middle, far from the edge.
        "slip_amplitude": Rule(1.5, 5.0, 8, 1.45, lengthscale=Lengthscale.ANNULUS),
        "ruiz_f1": Rule(1, 1.1, 8, 1.05, lengthscale=Lengthscale.ANNULUS),
    }
)
# Gauss points with quadratic displacements: motions converge faster, edges are fitted.
AT_GAUSS_POINTS = with_their_likes(
    {
        "approach": Rule(1.5, 0.004, 4, 1.8, path_factor=1.5),
        "peak_pressure": Rule(1.5, 0.011, 4, 1.4, path_factor=2.0),
        "contact_radius": Rule(1, 0.05, 8, 1.9, path_factor=1.5, lengthscale=Lengthscale.FILM),
        "stick_radius": Rule(1, 0.06, 4, 2.6, 2.0, 1.0, Lengthscale.STICK),
        "tangential_shift": Rule(2, 0.05, 1, 1.4, 3.0, 0.3, Lengthscale.SLIP),
        "twist": Rule(2, 0.15, 4, 1.7, 3.0, 0.3, Lengthscale.SLIP),
        "dissipated_energy": Rule(1.5, 0.05, 4, 2.3, 2.0, 0.0, Lengthscale.ANNULUS, charge=0.1),
        "slip_amplitude": Rule(1, 0.15, 8, 1.45, lengthscale=Lengthscale.ANNULUS),
    }
)
# The largest stress at the surface and near it, at an edge of the tractions: too low by 0.75 to
# 1.15 of itself over the root of the elements (Hamilton's stress, places of the edge in one).
ON_SURFACE = Rule(0.5, 1.5, 1, 1.6)
# The same where the tractions end in a root at fitted edges: what the smooth factor does not know,
# and the last element before the edge.
AT_EDGE = Rule(1, 0.3, 1, 1.0, floor=6e-3)
# The largest stress inside, as far as elements that grow with the depth know it.
INSIDE = Rule(1.5, 0.15, 1, 2.0)
# A slip annulus below so many elements may be missed altogether: the stick radius is off by one.
LEAST_ANNULUS = 1.5
# Where friction acts back on a pressing contact its pressure has a cusp on the axis.
CUSP = {"peak_pressure": Rule(1, 0.02, 0.5, 5.2, path_factor=2.0, lengthscale=Lengthscale.CUSP)}

# By the section of the size that is chosen, relative; errors fall as the inverse of its square.
SECTION = 1e-5
SECTION_OF_MOTION = 3e-5
MOTIONS = frozenset({"tangential_shift", "tangential_force", "twist", "torque"})
# Of what overlap over approach does to a quantity.
PENALTY = 0.4
PENALTY_OF = {"peak_pressure": 0.6, "contact_radius": 8.0, "contact_area": 16.0}
PENALTY_OF_CUSP = 10.0
# Of what half as many harmonics again change.
HARMONICS = 1.5
# Sectors, of which each sticks or slips as a whole, leave so much of the contact radius over their
# number in the stick radius.
STICK_BY_HARMONIC = 0.2


def penalty_of(name: str, cusp: bool) -> float:
    """Error of a quantity, relative, over overlap over approach.

    cusp  whether friction acts back on the pressure
    """
    return PENALTY_OF_CUSP if cusp and name in CUSP else PENALTY_OF.get(name, PENALTY)


def rules_of_elements(
    indenter: ShapedBody, cusp: bool, at_gauss_points: bool
) -> Mapping[str, Rule]:
    """The rule of every quantity below an indenter; none of what is infinite in the exact answer.

    cusp             whether friction acts back on the pressure
    at_gauss_points  whether tractions live there, not at rings
    """
    rules = RULES | (AT_GAUSS_POINTS if at_gauss_points else {}) | (CUSP if cusp else {})
    if indenter.rim is not None:
        rules = rules | FLAT
        if at_gauss_points:
            del rules["elastic_energy"]  # falls as the root of the elements alone, and slower
    elif indenter.gap_exponent != 1:
        return rules
    return {name: rule for name, rule in rules.items() if name not in INFINITE}
