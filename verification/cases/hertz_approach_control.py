"""Hertz point contact with the approach prescribed instead of the force."""

from __future__ import annotations

from contact_scene import LoadStep
from verification.cases.hertz_point import SOURCE, label
from verification.judging.case import Case, Derived, Level, Quantity
from verification.judging.refinement import refinement
from verification.judging.run import Run
from verification.observed.end_state import approach, normal_force
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import closed_form

SCENE = paper.frictionless(
    "Ball on a half-space, approach prescribed",
    paper.paraboloid(paper.STEEL),
    paper.STEEL,
    LoadStep(approach=HERTZ.approach),
)


def hertz_approach_control(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return hertz_approach_control_on(refinement(32, 128))


def hertz_approach_control_on(cells: tuple[int, ...]) -> Case:
    """The case on square grids of these many cells per side."""
    runs = tuple(Run(label(n), SCENE, paper.hertz_grid(n)) for n in cells)
    levels = tuple(run.label for run in runs)
    return Case(
        name="hertz_approach_control",
        title="Hertz point contact, approach prescribed",
        problem=(
            "The contact of hertz_point, pressed by Hertz's approach for 1 kN. The force that "
            "comes out is the measured quantity."
        ),
        runs=runs,
        quantities=(
            Quantity(
                "normal_force", "force that the approach takes", "N", levels[-1], normal_force,
                closed_form(HERTZ.load, SOURCE),
                Derived(levels, 2.0, 7.5e-5, "order 2, as the approach under force; the cap is "
                        "its 5e-5 times 3/2, the exponent of Hertz's law"),
            ),
            Quantity(
                "approach", "approach of the bodies since first touch", "m", levels[-1], approach,
                closed_form(HERTZ.approach, SOURCE),
                Derived(levels, 2.0, 1e-12, "prescribed: nothing but rounding may change it"),
            ),
        ),
    )  # fmt: skip
