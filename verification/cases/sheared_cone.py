"""Partial slip under a cone, by the superposition of Ciavarella and Jäger, ν = 0."""

from __future__ import annotations

from dataclasses import replace

from contact_scene import Cone
from verification.cases.cattaneo_mindlin import shears_along_x
from verification.closed_forms.ciavarella_jaeger import superpose
from verification.closed_forms.cone import ConeContact
from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Refined, Within, case, judged
from verification.judging.drawings import profile
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observables import SHEAR, SHIFT, STICK_RADIUS
from verification.judging.refinement import refinement
from verification.problems import paper_scene as paper
from verification.problems.classical import CONE, SLOPE, UNDER_CONE, mean_pressure
from verification.problems.paper_scene import FRICTION, NU_ZERO
from verification.problems.problem import Problem
from verification.problems.sheared import OVER_SLIDING_SHIFT
from verification.problems.shifted_grid import UNLIKE

STOPS = {1: 0.4, 2: 0.8}  # parts of µW, by step
MODULUS_RATIO = 1.0  # E*/G* of two identical bodies with ν = 0


def _sheared(*parts: float) -> Problem:
    """To these parts of µW."""
    return Problem(
        paper.frictional(
            "Cone on a half-space, sheared, ν = 0",
            Cone(slope_angle=SLOPE, material=NU_ZERO),
            NU_ZERO,
            *(paper.tangential_step(part, increments=1) for part in parts),
        ),
        (
            UNDER_CONE,
            *(
                superpose(
                    lambda load: ConeContact.under_load(load, SLOPE, paper.CONTACT_MODULUS),
                    paper.NORMAL_FORCE, part * paper.FRICTION_LIMIT, FRICTION, MODULUS_RATIO,
                )
                for part in parts
            ),
        ),
        CONE.radius,
        "Ciavarella 1998; Jäger 1998, with Love's cone",
        scales={OVER_SLIDING_SHIFT: FRICTION * MODULUS_RATIO * UNDER_CONE.approach},
    )  # fmt: skip


SHEARED, SHEARED_LESS = _sheared(*STOPS.values()), _sheared(STOPS[1])
STICK = replace(STICK_RADIUS, value=lambda exact: exact.stick.contact_radius)
ROWS = (
    *(
        row
        for step, part in STOPS.items()
        for row in (
            Within(
                SHEAR.at(step, part, "µW"), 4e-3,
                "twice what is required of the ball at 128 x 128: the apex is an infinite peak "
                "that cells average",
            ),
            Refined(
                STICK.at(step, part, "µW"), 1.0, part_of_side(0.2),
                "order 1: the border is known to a part of a cell; the cap is a fifth of a cell",
            ),
            Refined(
                SHIFT.at(step, part, "µW"), 2.0, 1e-4,
                "order 2 and cap as the approach of the frictionless cone, of which the shift is a "
                "copy",
            ),
        )
    ),
)  # fmt: skip
ORDER = (Falls(SHEAR.at(1, STOPS[1], "µW"), 1.5, "square-root edges of stick zone and contact"),)


def sheared_cone(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level, where coarse ones tell the order only
    together with shifted ones."""
    cells = refinement(32, 128 if level is Level.QUICK else 256)
    followed = grids = on_cells(SHEARED, cells)
    if level is Level.QUICK:
        followed = on_cells(SHEARED_LESS, cells, offsets=UNLIKE, of="sheared less")
    return case(
        "sheared_cone",
        "Partial slip under a cone",
        "The cone of cone_contact with ν = 0 and friction, sheared by 0.4 and 0.8 of µW. For any "
        "profile the shear is the difference of two pressures times µ; the stick radius is "
        "a √(1 - T/µW), not the cube root of a ball.",
        judged(grids, ROWS),
        judged(followed, ORDER),
        charts=(
            profile(
                grids,
                "sheared_cone_profiles",
                "Shear next to y = 0",
                "Computed shear under the cone over the superposition of two pressures, in units "
                "of µ times the mean pressure, and their difference. The infinite peaks at the "
                "apex cancel.",
                "qₓ / (µ mean p)",
                FRICTION * mean_pressure(CONE),
                *shears_along_x(STOPS),
            ),
        ),
    )
