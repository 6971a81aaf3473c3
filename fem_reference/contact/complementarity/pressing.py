"""The pressure at given shear: a linear complementarity problem.

    p >= 0,  g >= 0,  p g = 0      with the gap over the hats  g = A p + h - δ w

(Johnson 1985, section 5.9). It is the minimum of the complementary energy with p >= 0; δ is given,
or the multiplier of the normal force.
"""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from fem_reference.contact.box_program import BoxProgram, Sides, Total, solve_box
from fem_reference.loads import NormalTarget

Field = NDArray[np.float64]
Matrix = NDArray[np.float64]


@dataclass(frozen=True)
class Pressed:
    """Pressure (n,), approach, and how many linear systems that took.

    sides  -1 where the surfaces are apart, 0 where they touch
    """

    pressure: Field
    approach: float
    sides: Sides
    steps: int


def press(
    normal: Matrix, gap: Field, weights: Field, target: NormalTarget, guess: Sides
) -> Pressed:
    """The pressure under a normal force or at an approach.

    normal   gap over the hats per pressure (n, n)
    gap      over the hats without pressure (n,)
    weights  integrals of the hats (n,)
    """
    nothing, endless = np.zeros_like(gap), np.full_like(gap, np.inf)
    right, total = -gap, None
    if target.force is not None:
        total = Total(weights, target.force / (2 * pi))
    else:
        assert target.approach is not None
        right = target.approach * weights - gap
    solved = solve_box(BoxProgram(normal, right, nothing, endless, total), guess)
    approach = solved.multiplier if target.approach is None else target.approach
    return Pressed(solved.values, approach, solved.sides, solved.steps)
