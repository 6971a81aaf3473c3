"""Hertz point contact of the paper's ball, as a paraboloid."""

from __future__ import annotations

from dataclasses import replace

from verification.judging.case import Case, Level
from verification.judging.declared_case import Falls, Refined, Within, case, judged
from verification.judging.drawings import PRESSURE, convergence, profile
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observables import APPROACH, CONTACT_RADIUS, PEAK_PRESSURE, PRESSURE_L2
from verification.judging.order_of_convergence import NotYetAsymptotic
from verification.judging.refinement import refinement
from verification.problems.hertz import BALL
from verification.problems.paper_scene import HERTZ
from verification.problems.shifted_grid import UNLIKE

ASKED = "required of this scene by the project's accuracy targets"
EDGE = "order 1: the edge is known to a part of a cell; the cap is a tenth of a cell"
COARSE = NotYetAsymptotic(
    0.15, "a second term counts on coarse grids: 1.12 up to 256 cells, 1.08 up to 512"
)
ROWS = (
    Within(PEAK_PRESSURE, {128: 1.5e-4, 256: 4e-5}, ASKED),
    Within(APPROACH, {128: 5e-5, 256: 5e-5}, ASKED, name="required_approach"),
    Refined(
        APPROACH, 2.0, 5e-5,
        "order 2: the pressure's error has zero mean; the cap is the figure required of the "
        "coarser grids",
    ),
    Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), EDGE),
    Falls(
        PRESSURE_L2, 1.0,
        "at the edge the pressure rises as a square root: an error of O(√h) on a ring one cell "
        "wide leaves O(h) in L2",
    ),
    Falls(
        PEAK_PRESSURE, 2.0,
        "even counts of cells put the centre h/√2 from the next cell centre, where the exact "
        "pressure is lower by p0 h²/4a²",
    ),
    Falls(
        CONTACT_RADIUS, 1.0,
        "pressures that are constant on cells, matched at their centres, let the contact reach too "
        "far by the same part of a cell, 0.06, on every grid",
        COARSE,
    ),
)  # fmt: skip
# How circles cut the cells scatters it too much on one grid of each size.
MEAN = (
    Falls(
        APPROACH, 2.0,
        "a weighted mean of the displacement: the errors at the edge alternate and cancel",
    ),
)  # fmt: skip


def hertz_point(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids at higher levels."""
    finest = {Level.QUICK: 256, Level.STANDARD: 512, Level.FULL: 1024}[level]
    return hertz_on(refinement(32, finest), refinement(32, finest // 2))


def hertz_on(cells: tuple[int, ...], shifted: tuple[int, ...] = ()) -> Case:
    """The case on square grids of these many cells per side; required figures at 128 and 256.

    shifted  cells per side of grids that fall on the contact in two other ways
    """
    grids = on_cells(BALL, cells)
    others = [on_cells(BALL, shifted, offsets=UNLIKE)] if shifted else []
    return case(
        "hertz_point",
        "Hertz point contact",
        "The paper's ball (R = 18 mm, 420 GPa, ν = 0.3) on a half-space of the same material "
        "under 1 kN, without friction, on a window of three contact radii. As a paraboloid it "
        "is Hertz's problem exactly.",
        judged(grids, ROWS),
        *(judged(one, MEAN) for one in others),
        charts=(
            profile(
                grids,
                "hertz_profile",
                "Pressure next to y = 0",
                f"Computed pressure on {cells[-1]} x {cells[-1]} cells over Hertz's, and their "
                "difference: it is confined to the cells at the edge of the contact.",
                "p / p₀",
                HERTZ.peak_pressure,
                replace(PRESSURE, profile="hertz"),
            ),
            convergence(
                grids,
                ROWS,
                "hertz_convergence",
                "Convergence of the Hertz contact",
                "Relative errors against cell side. The pressure falls with the first power of h "
                "because of the square-root edge; approach and peak pressure fall with the second.",
                also=(APPROACH,),
            ),
        ),
        limits=("Pointwise errors at the edge fall as O(√h) only and are not judged.",),
    )
