"""The paper's coatings under a rigid paraboloid, without friction, by finite elements."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from verification.cases.coated_paraboloid import STUDIED
from verification.cases.levels import because, levels
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.drawings import PRESSURE, profile
from verification.judging.ladder import asked, named, on_elements
from verification.judging.observables import (
    APPROACH,
    CENTRAL_PRESSURE,
    CONTACT_RADIUS,
    PRESSURE_WITHIN,
)
from verification.problems.coated_ball import ROWS as COATINGS
from verification.problems.coated_ball import coated_ball
from verification.problems.paper_scene import HERTZ

# At the full level every second mesh: all of them for every coating would say no more.
FOLLOWED = {level: levels(level)[:: 2 if level is Level.FULL else 1] for level in Level}
ROWS = (
    Within(APPROACH, asked(1e-4, 2), because(2)),
    Within(CENTRAL_PRESSURE, asked(1e-4, 2), because(2)),
    Within(CONTACT_RADIUS, 2e-3, "asked of the finite elements at 64 per radius"),
    Within(PRESSURE_WITHIN, asked(2e-3, 2), because(2)),
)


def fem_coated(level: Level = Level.QUICK) -> Case:
    """The case: the paper's soft and stiff coatings, all of the reference above the quick level."""
    rows = COATINGS
    if level is Level.QUICK:
        rows = [row for row in rows if row["h_over_aH"] == 1 and row["E1_over_E2"] in (0.5, 2)]
    return fem_coated_on(rows, FOLLOWED[level])


def fem_coated_on(rows: Sequence[Mapping[str, Any]], elements: tuple[int, ...]) -> Case:
    """The case on these rows of the reference; on coarser meshes errors are followed, not judged.
    Meshes are fitted to the contact by the solver itself."""
    names = [f"E1/E2 = {row['E1_over_E2']:g}, h = {row['h_over_aH']:g} a_H" for row in rows]
    ladders = [
        named(name, on_elements(coated_ball(row), elements, of=name))
        for name, row in zip(names, rows, strict=True)
    ]
    return case(
        "fem_coated",
        "Finite elements: coated bodies without friction",
        "The paper's ball, rigid, on coated half-spaces under 1 kN, as in coated_paraboloid, "
        "by finite elements. The interface is a line of the mesh; beyond the section the "
        "substrate alone answers, which costs the approach up to 1e-4 below stiff coatings.",
        *(judged(one, ROWS) for one in ladders),
        charts=tuple(
            profile(
                one,
                f"fem_coated_{number}",
                f"Pressure over the radius, {name}",
                "Pressure by finite elements over the semi-closed solution, and their difference.",
                "p / p_H",
                HERTZ.peak_pressure,
                replace(PRESSURE, profile="coated" if row["E1_over_E2"] == STUDIED else ""),
            )
            for number, (row, name, one) in enumerate(zip(rows, names, ladders, strict=True), 1)
        ),
    )
