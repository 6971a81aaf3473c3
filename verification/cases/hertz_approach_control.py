"""Hertz point contact with the approach prescribed instead of the force."""

from __future__ import annotations

from verification.judging.case import Case, Level
from verification.judging.declared_case import Refined, case, judged
from verification.judging.ladder import on_cells
from verification.judging.observables import APPROACH, NORMAL_FORCE
from verification.judging.refinement import refinement
from verification.problems.hertz import LED_BALL

ROWS = (
    Refined(
        NORMAL_FORCE, 2.0, 7.5e-5,
        "order 2, as the approach under force; the cap is its 5e-5 times 3/2, the exponent of "
        "Hertz's law",
    ),
    Refined(APPROACH, 2.0, 1e-12, "prescribed: nothing but rounding may change it"),
)  # fmt: skip


def hertz_approach_control(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return case(
        "hertz_approach_control",
        "Hertz point contact, approach prescribed",
        "The contact of hertz_point, pressed by Hertz's approach for 1 kN. The force that comes "
        "out is the measured quantity.",
        judged(on_cells(LED_BALL, refinement(32, 128)), ROWS),
    )
