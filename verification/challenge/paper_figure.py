"""The paper's figure 4: a coated body pressed with friction and then sheared, which no closed form
tells."""

from __future__ import annotations

from collections.abc import Iterator

from contact_scene import LoadStep
from verification.challenge.often_asked import SMALL, approach
from verification.challenge.requested_quantities import (
    AskedValue,
    Challenge,
    Grade,
)
from verification.problems.indentation import COATED, REFERENCE_ERROR
from verification.problems.layered_scene import pressed, rigid_ball
from verification.problems.paper_scene import FRICTION, FRICTION_LIMIT, pressing

# Tangential force over µW: shift [length]. Extrapolated from 40 + 3 x 12 and 80 + 3 x 24 increments
# on 128 x 128 cells, and by 64 elements over the radius: the means, which differ by 1e-4.
SHIFTS = {0.3: 1.7327e-7, 0.6: 3.8068e-7, 0.9: 6.6704e-7}
UNCERTAINTY = 1e-4


def paper_figure() -> Challenge:
    """Ball on a coating twice as stiff as its base and as thick as the Hertz radius."""
    pushes = (LoadStep(tangential_force=(part * FRICTION_LIMIT, 0.0)) for part in SHIFTS)
    title = "Coated body under a rigid ball, pressed with friction, then sheared"
    scene = pressed(title, rigid_ball(), COATED.body, pressing(), *pushes, friction=FRICTION)
    return Challenge(
        "paper_figure_4", title,
        f"{title}. Pressing leaves radial shear, and the way there matters: every force grows "
        "in proportion to time.", scene,
        f"{COATED.source}; the shifts by slipstick's finite elements and cells, which agree",
        (approach(COATED.approach, REFERENCE_ERROR), *_shifts()), (), SMALL,
        "for the approach nothing; the shifts are what two of them agree on",
    )  # fmt: skip


def _shifts() -> Iterator[AskedValue]:
    for step, shift in enumerate(SHIFTS.values(), start=2):
        yield AskedValue(
            "shift_x", step, "m",
            "tangential shift of the indenter along +x, relative to far points of the body",
            shift, shift, "itself", Grade.C, uncertainty=UNCERTAINTY,
        )  # fmt: skip
