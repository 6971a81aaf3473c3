"""Ball that is pressed and then loaded tangentially in steps, with the answer of Cattaneo and
Mindlin.

The answer is exact for Poisson's ratio ν = 0.
"""

from __future__ import annotations

from contact_scene import IsotropicMaterial
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, HERTZ, NU_ZERO
from verification.problems.problem import Problem

SOURCE = "Cattaneo 1938; Mindlin 1949"
OVER_SLIDING_SHIFT = "the shift at gross sliding"
OVER_SLIDING_WORK = "the work of µW over the shift at gross sliding"
OVER_LIMIT = "µp_H"
SLIDING_SHIFT = paper.partial_slip(NU_ZERO, 0.0).sliding_shift


def sheared(
    title: str,
    parts: tuple[float, ...],
    material: IsotropicMaterial = NU_ZERO,
    increments: int = 1,
) -> Problem:
    """Create the problem of a pressed ball under a tangential force that changes in several load
    steps.

    parts       tangential force at the end of each step, as a fraction of the friction limit µW
    material    material of both bodies
    increments  number of increments of each tangential step
    """
    steps = (paper.tangential_step(part, increments) for part in parts)
    stops = tuple(paper.partial_slip(material, part * FRICTION_LIMIT) for part in parts)
    sliding = stops[0].sliding_shift
    return Problem(
        paper.frictional(title, paper.paraboloid(material), material, *steps),
        (HERTZ, *stops),
        HERTZ.contact_radius,
        SOURCE,
        scales={
            OVER_SLIDING_SHIFT: sliding,
            OVER_SLIDING_WORK: FRICTION_LIMIT * sliding,
            OVER_LIMIT: FRICTION * HERTZ.peak_pressure,
        },
        equations=(
            r"c = a (1 - T/\mu W)^{1/3},\quad q = \mu p_0 \left[\sqrt{1 - r^2/a^2} - "
            r"\tfrac{c}{a} \sqrt{1 - r^2/c^2}\right],\quad "
            r"\Delta = \frac{3 \mu W}{4 a G^*} \left[1 - (1 - T/\mu W)^{2/3}\right]",
        ),
    )
