"""The shear at a given friction limit: Tresca's problem.

    |q| <= b;  Δs = 0 where |q| < b;  Δs against q where |q| = b       over the hats
    Δs = A q + u - ω v - s

with b = µp, u the displacement by the pressure, ω v the indenter's motion and s what A q + u - ω v
was before the increment. It is the minimum of ½ q·A q + q·(u - s - ω v) within ±b; ω is given, or
the multiplier of the force.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.box_program import BoxProgram, Sides, Total, solve_box
from fem_reference.contact.complementarity.contact_problem import Sideways
from fem_reference.contact.one_component import SidewaysTarget

Field = NDArray[np.float64]


@dataclass(frozen=True)
class Sheared:
    """Shear (n,), the indenter's motion ω, and how many linear systems that took.

    sides  0 where the surfaces stick, ±1 where they slip against a shear of that sign
    """

    shear: Field
    motion: float
    sides: Sides
    steps: int


def shear(
    sideways: Sideways, bound: Field, target: SidewaysTarget, free: Field, guess: Sides
) -> Sheared:
    """The shear within ±bound at a motion or under a resultant that the bound can carry.

    free  s - u (n,)
    """
    limit = sideways.limited(bound)
    right, total = free, None
    if target.resultant is not None:
        assert sideways.motion is not None
        total = Total(sideways.motion, target.resultant)
    elif sideways.motion is not None:
        assert target.motion is not None
        right = free + target.motion * sideways.motion
    solved = solve_box(BoxProgram(sideways.compliance, right, -limit, limit, total), guess)
    motion = solved.multiplier if target.resultant is not None else (target.motion or 0.0)
    return Sheared(solved.values, motion, solved.sides, solved.steps)
