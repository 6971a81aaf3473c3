"""Torsion by finite elements: a ball twisted into partial slip, and a stuck flat punch."""

from __future__ import annotations

from verification.cases.levels import levels, order_levels
from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Within, case, judged
from verification.judging.drawings import Drawn, profile
from verification.judging.ladder import asked, on_elements, part_of_side, with_edge_at
from verification.judging.observables import SHEAR_AROUND, STICK_RADIUS, TWIST
from verification.problems.sheared import OVER_LIMIT
from verification.problems.torsion import PARTS, STUCK, TWISTED

SLIDING = "of the sliding torque"
CUSP = (
    "set by hand: at 64 elements per radius 2e-3 of the twist and 5e-3 of µp_H, on other meshes "
    "what the order 3/2 of the cusps at both edges makes of it"
)
RIM = "what hats cannot follow of the infinite shear at the rim has an energy of O(h)"
OF_BALL = tuple(
    row
    for step, part in PARTS.items()
    for row in (
        Within(TWIST.at(step, part, SLIDING), asked(2e-3, 1.5), CUSP),
        Within(
            STICK_RADIUS.at(step, part, SLIDING), part_of_side(0.1),
            "a tenth of an element, read off the last values",
        ),
        Within(SHEAR_AROUND.at(step, part, SLIDING), asked(5e-3, 1.5), CUSP),
    )
)  # fmt: skip
OF_PUNCH = (
    Within(
        TWIST, asked(1e-3, 1), f"set by hand: 1e-3 at 64 elements per radius; {RIM}",
        name="stuck_twist",
    ),
    Falls(TWIST, 1.0, RIM),
)  # fmt: skip


def fem_torsion(level: Level = Level.QUICK) -> Case:
    """The case, on finer meshes at higher levels, with the edge of the ball's contact at several
    places of its element."""
    balls = with_edge_at(TWISTED, levels(level)[-1:], order_levels(level), "ball")
    punches = on_elements(STUCK, levels(level), of="stuck punch")
    return case(
        "fem_torsion",
        "Finite elements: torsion",
        "The paper's ball under 1 kN, twisted by 0.5, 0.9 and 0.99 of the torque at which all "
        "slips, and a flat punch that sticks all over, as in torsion. One unknown displacement, "
        "around the axis; pressure does not enter but by the friction limit.",
        judged(balls, OF_BALL),
        judged(punches, OF_PUNCH),
        charts=tuple(
            profile(
                balls,
                f"fem_torsion_{step}",
                f"Shear over the radius at {part:g} {SLIDING}",
                "Circumferential shear by finite elements over the closed form, and their "
                "difference: a cusp at the edge of stick.",
                "q / µp₀",
                TWISTED.scale(OVER_LIMIT),
                shear_around(step),
            )
            for step, part in PARTS.items()
        ),
    )


def shear_around(step: int) -> Drawn:
    """The circumferential shear at the end of a step."""
    return Drawn(lambda end: end.shear_circumferential, lambda exact: exact.shear, step=step)
