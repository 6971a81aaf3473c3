"""A rigid ball on an elastic half-space, without friction: only E* matters."""

from __future__ import annotations

from contact_scene import RIGID, Body, IsotropicMaterial, LoadStep, Paraboloid, Scene
from verification.cases.hertz_point import ASKED, SOURCE, label
from verification.judging.case import Case, Level, Quantity, Required
from verification.judging.run import Run
from verification.observed.end_state import approach, peak_pressure
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ
from verification.problems.reference import closed_form

CELLS = 128
PAIRS = {
    "rigid ball on 210 GPa": (RIGID, IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3)),
    # 1/E* = (1 - 0.25²)/300 GPa + the rest, so that E* is the paper's
    "ball of 300 GPa on a softer body": (
        IsotropicMaterial(young_modulus=300e9, poisson_ratio=0.25),
        IsotropicMaterial(
            young_modulus=0.75 / (1 / paper.CONTACT_MODULUS - (1 - 0.25**2) / 300e9),
            poisson_ratio=0.5,
        ),
    ),
}


def dissimilar_bodies(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    return dissimilar_bodies_on(CELLS)


def dissimilar_bodies_on(cells: int) -> Case:
    """The case on a square grid of this many cells per side."""
    runs = tuple(
        Run(name, _scene(name, *pair), paper.hertz_grid(cells)) for name, pair in PAIRS.items()
    )
    return Case(
        name="dissimilar_bodies",
        title="Dissimilar bodies without friction",
        problem=(
            "Pairs of different materials with the E* of hertz_point: a rigid ball on steel, and a "
            "ball on an incompressible body. Without friction Hertz's solution knows only E*."
        ),
        runs=runs,
        quantities=tuple(
            quantity
            for run in runs
            for quantity in (
                Quantity(
                    "approach", "approach of the bodies since first touch", "m", run.label,
                    approach, closed_form(HERTZ.approach, SOURCE), Required(5e-5, ASKED),
                ),
                Quantity(
                    "peak_pressure", "largest pressure of any cell", "Pa", run.label,
                    peak_pressure, closed_form(HERTZ.peak_pressure, SOURCE),
                    Required(1.5e-4, ASKED),
                ),
            )
        ),
        limits=(
            f"On {label(cells)} cells only: the operator differs from hertz_point's by a factor.",
        ),
    )  # fmt: skip


def _scene(title: str, indenter: object, body: object) -> Scene:
    return Scene.model_validate(
        {
            "title": title,
            "indenter": Paraboloid.model_validate({"radius": paper.RADIUS, "material": indenter}),
            "body": Body.model_validate({"material": body}),
            "loading": (LoadStep(normal_force=paper.NORMAL_FORCE),),
        }
    )
