"""Cone and flat punch under the paper's force: an infinite pressure at the apex or at the rim."""

from __future__ import annotations

from math import pi, radians

from contact_scene import Cone, FlatPunch
from verification.closed_forms.cone import ConeContact
from verification.closed_forms.flat_punch import FlatPunchContact
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import CONTACT_MODULUS, NORMAL_FORCE, STEEL, pressing
from verification.problems.problem import Problem

SLOPE = radians(1.0)  # of the cone's flank
PUNCH_RADIUS = 0.4e-3
PUNCH_WINDOW = 2.2  # radii
PRESS = pressing()

UNDER_CONE = ConeContact.under_load(NORMAL_FORCE, SLOPE, CONTACT_MODULUS)
CONE = Problem(
    paper.frictionless(
        "Cone on a half-space (flank at 1°)", Cone(slope_angle=SLOPE, material=STEEL), STEEL, PRESS
    ),
    (UNDER_CONE,),
    UNDER_CONE.contact_radius,
    "Love 1939; Sneddon 1965",
    equations=(
        r"W = \tfrac{\pi}{2} E^* a^2 \tan\beta,\quad \delta = \tfrac{\pi}{2} a \tan\beta,\quad "
        r"p = \tfrac{1}{2} E^* \tan\beta \, \mathrm{arcosh}(a/r)",
    ),
)
PUNCH = Problem(
    paper.frictionless(
        "Flat punch on a half-space", FlatPunch(radius=PUNCH_RADIUS, material=STEEL), STEEL, PRESS
    ),
    (FlatPunchContact(PUNCH_RADIUS, CONTACT_MODULUS, NORMAL_FORCE),),
    PUNCH_RADIUS,
    "Boussinesq 1885; Johnson 1985, ch. 3.4",
    equations=(r"W = 2 E^* a \delta,\quad p = \frac{W}{2 \pi a^2} \frac{1}{\sqrt{1 - r^2/a^2}}",),
)


def mean_pressure(of: Problem) -> float:
    """Of a round contact under the paper's force [force/length²]."""
    return NORMAL_FORCE / (pi * of.radius**2)
