"""Whether the tangent that Newton's method solves with is the derivative of the penalty's law."""

from __future__ import annotations

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.residuals import worst
from fem_reference.contact.penalty.spring_contact import PenaltyLaw
from verification.judging.case import Check, Required
from verification.problems.reference import identity

POINTS = 400
STEP = 1e-5  # of overlaps of order one
SEED = 7


def consistent_tangent() -> Check:
    """Tangent against central differences, in stick and in slip, with one shear and with two.

    A wrong one leaves all results as they are and only costs iterations.
    """
    return Check(
        "consistent_tangent", "largest difference between the tangent of the law and its central "
        "differences, over ε", "", f"{POINTS} random points", _worst,
        identity(0.0, "the derivative of the law; Newton's method converges linearly with another"),
        Required(1e-8, f"central differences of step {STEP:g} of overlaps of order one: what they "
                 "neglect is a sixth of its square times a third derivative of 160, and rounding"),
        1.0, "the penalty ε",
    )  # fmt: skip


def _worst() -> float:
    return worst(*map(_error, (1, 2, 3)))


def _error(components: int) -> float:
    random = np.random.default_rng((SEED, components))
    multiplier = random.uniform(-0.2, 0.2, (components, POINTS))
    law = PenaltyLaw(
        1.0,
        CoulombFriction(coefficient=0.4),
        multiplier,
        random.uniform(-0.1, 0.1, (components - 1, POINTS)),
    )
    overlap = random.uniform(-1.0, 1.0, (components, POINTS))
    overlap[0] += 0.8
    here = law.response(overlap)
    largest = 0.0
    for component in range(components):
        step = np.zeros_like(overlap)
        step[component] = STEP
        above, below = law.response(overlap + step), law.response(overlap - step)
        # Where a point starts to touch or to slip the law has a kink, and no derivative.
        smooth = (above.in_contact == below.in_contact) & (above.in_slip == below.in_slip)
        difference = (above.traction - below.traction) / (2 * STEP) - here.tangent[:, component]
        # Shears in slip bend with the radius of the friction limit: near none it is too sharp.
        smooth &= (here.traction[0] > 0.2) | ~here.in_contact
        largest = worst(largest, float(np.max(np.abs(difference[:, smooth]))))
    return largest
