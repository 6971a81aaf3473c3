"""Slip and its memory by finite elements with a penalty: a fretting loop, and a twisted ball."""

from __future__ import annotations

from verification.cases.fem_partial_slip import (
    ACROSS,
    LOOP,
    OF_LOOP,
    OF_SHEAR,
    OF_SHIFT,
    WHY,
    loop_profile,
)
from verification.cases.fem_torsion import SLIDING, shear_around
from verification.cases.levels import finest
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.drawings import profile
from verification.judging.ladder import Rung, on_elements, on_springs
from verification.judging.observables import SHEAR_AROUND, TWIST
from verification.problems.loop_history import LOADED
from verification.problems.sheared import OVER_LIMIT
from verification.problems.torsion import PARTS, TWISTED

GAUSS = "Shear at the Gauss points over the closed form, and their difference."


def of_twist(rung: Rung) -> float:
    """Twice what is allowed of the shift of the loop."""
    return 2 * OF_SHIFT(rung)


OF_BALL = tuple(
    row
    for step, part in PARTS.items()
    for row in (
        Within(
            TWIST.at(step, part, SLIDING), of_twist,
            "twice the figure of the shift of the loop, and its reason",
        ),
        Within(SHEAR_AROUND.at(step, part, SLIDING), OF_SHEAR, WHY),
    )
)  # fmt: skip


def fem_penalty_slip(level: Level = Level.QUICK) -> Case:
    """The case, on a finer mesh at higher levels."""
    n = (finest(level),)
    loop, ball = (
        on_springs(on_elements(problem, n, 0.97, of), f"{of}, {n[0]} elements per radius, penalty")
        for of, problem in {"loop": LOOP, "torsion": TWISTED}.items()
    )
    return case(
        "fem_penalty_slip",
        "Finite elements with a penalty: fretting loop and torsion",
        "The loop of fem_partial_slip and the twisted ball of fem_torsion with springs along "
        "the surface and Coulomb's law by return mapping. What a point has slipped is "
        "remembered as where its spring stands without load.",
        judged(loop, OF_LOOP),
        judged(ball, OF_BALL),
        charts=(
            loop_profile(loop, LOADED, "fem_penalty_slip_loop", "at 0.9 µW", GAUSS),
            profile(
                ball,
                "fem_penalty_slip_torsion",
                f"Shear over the radius, at {PARTS[2]:g} {SLIDING}",
                GAUSS,
                "q / µp₀",
                TWISTED.scale(OVER_LIMIT),
                shear_around(2),
            ),
        ),
        limits=(ACROSS,),
    )
