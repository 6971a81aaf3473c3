"""The paper's ball with its exact arc, and how far that is from the paraboloid."""

from __future__ import annotations

from dataclasses import replace

from contact_scene import Sphere
from verification.closed_forms.sphere import SphereContact
from verification.judging.case import Case, Level
from verification.judging.declared_case import Refined, Reported, case, judged
from verification.judging.ladder import on_cells, part_of_side
from verification.judging.observable import Observable
from verification.judging.observables import APPROACH, CONTACT_RADIUS, PEAK_PRESSURE
from verification.judging.refinement import refinement
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ
from verification.problems.problem import Problem
from verification.problems.reference import ROUNDING, ReferenceKind

EXACT = SphereContact.under_load(paper.NORMAL_FORCE, paper.RADIUS, paper.CONTACT_MODULUS)
ARC = Problem(
    paper.frictionless(
        "Ball with its exact arc on a half-space",
        Sphere(radius=paper.RADIUS, material=paper.STEEL),
        paper.STEEL,
        paper.pressing(),
    ),
    (EXACT,),
    HERTZ.contact_radius,
    "Sneddon 1965, arc of a circle, by Gauss quadrature",
    ReferenceKind.SEMI_CLOSED,
    100 * ROUNDING,
)


def _beyond(what: Observable, words: str, hertz: float) -> Observable:
    return replace(
        what,
        name=f"{what.name}_beyond_hertz",
        meaning=f"computed {words} over Hertz's, less one",
        unit="",
        measure=lambda result, step, problem: what.measure(result, step, problem) / hertz - 1,
    )


ROWS = (
    Refined(
        APPROACH, 2.0, 1e-5,
        "order 2 as for the paraboloid; the cap is a third of the distance from Hertz's approach, "
        "so that the two can be told apart",
    ),
    Refined(
        PEAK_PRESSURE, 2.0, 4e-5,
        "order 2: distance of the centre from the next cell centre; the cap is the figure required "
        "of the paraboloid at 256 x 256",
    ),
    Refined(CONTACT_RADIUS, 1.0, part_of_side(0.1), "as for the paraboloid"),
    Reported(
        _beyond(APPROACH, "approach", HERTZ.approach),
        f"the closed forms differ by {EXACT.approach / HERTZ.approach - 1:.2e}",
    ),
    Reported(
        _beyond(PEAK_PRESSURE, "peak pressure", HERTZ.peak_pressure),
        f"the closed forms differ by {EXACT.peak_pressure / HERTZ.peak_pressure - 1:.2e}; the "
        "largest cell value is low by h²/4a²",
    ),
)  # fmt: skip


def hertz_exact_sphere(level: Level = Level.QUICK) -> Case:
    """The case, on finer grids above the quick level."""
    return case(
        "hertz_exact_sphere",
        "Ball with its exact arc",
        "The ball of hertz_point as a circular arc in the same half-space. Its exact solution is "
        "an integral; it differs from Hertz's by a²/R² times numbers near 1/15, far less than any "
        "measurement but more than the error of the solver.",
        judged(on_cells(ARC, refinement(64, 256 if level is Level.QUICK else 512)), ROWS),
        limits=("Linear elasticity of a half-space: large strains are another matter.",),
    )
