"""Hertz's elliptical contact: a barrel under the paper's force."""

from __future__ import annotations

from contact_scene import Ellipsoid
from verification.closed_forms.elliptical_contact import EllipticalContact
from verification.problems import paper_scene as paper
from verification.problems.problem import Problem

RADII = (90e-3, 18e-3)
EXACT = EllipticalContact.under_load(paper.NORMAL_FORCE, RADII, paper.CONTACT_MODULUS)
BARREL = Problem(
    paper.frictionless(
        "Barrel on a half-space (radii 90 mm and 18 mm)",
        Ellipsoid(radii=RADII, material=paper.STEEL),
        paper.STEEL,
        paper.pressing(),
    ),
    (EXACT,),
    EXACT.semi_axes[0],
    "Hertz 1882, by Carlson's elliptic integrals",
    across=EXACT.semi_axes[1],
    equations=(
        r"\frac{R_x}{R_y} = \frac{(a/b)^2 \mathbf{E}(e) - \mathbf{K}(e)}"
        r"{\mathbf{K}(e) - \mathbf{E}(e)},\quad "
        r"p = \frac{3 W}{2 \pi a b} \sqrt{1 - x^2/a^2 - y^2/b^2}",
    ),
)
