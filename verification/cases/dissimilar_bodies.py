"""A rigid ball on an elastic half-space, without friction: only E* matters."""

from __future__ import annotations

from contact_scene import RIGID, Body, IsotropicMaterial, Paraboloid, Scene
from verification.cases.hertz_point import ASKED
from verification.judging.case import Case, Level
from verification.judging.declared_case import Within, case, judged
from verification.judging.ladder import named, on_cells
from verification.judging.observables import APPROACH, PEAK_PRESSURE
from verification.problems import paper_scene as paper
from verification.problems.hertz import hertzian

CELLS = 128
STEEL = Body(material=IsotropicMaterial(young_modulus=210e9, poisson_ratio=0.3))
# 1/E* = (1 - 0.25²)/300 GPa + the rest, so that E* is the paper's
SOFTER = Body(
    material=IsotropicMaterial(
        young_modulus=0.75 / (1 / paper.CONTACT_MODULUS - (1 - 0.25**2) / 300e9), poisson_ratio=0.5
    )
)
OF_300_GPA = IsotropicMaterial(young_modulus=300e9, poisson_ratio=0.25)
PAIRS = {
    "rigid ball on 210 GPa": (Paraboloid(radius=paper.RADIUS, material=RIGID), STEEL),
    "ball of 300 GPa on a softer body": (paper.paraboloid(OF_300_GPA), SOFTER),
}
ROWS = (Within(APPROACH, 5e-5, ASKED), Within(PEAK_PRESSURE, 1.5e-4, ASKED))


def dissimilar_bodies(level: Level = Level.QUICK) -> Case:
    """The case, the same at every level."""
    step = paper.pressing()
    scenes = {
        name: Scene(title=name, indenter=ball, body=body, loading=(step,))
        for name, (ball, body) in PAIRS.items()
    }
    return case(
        "dissimilar_bodies",
        "Dissimilar bodies without friction",
        "Pairs of different materials with the E* of hertz_point: a rigid ball on steel, and a "
        "ball on an incompressible body. Without friction Hertz's solution knows only E*.",
        *(
            judged(named(name, on_cells(hertzian(scene), (CELLS,), of=name)), ROWS)
            for name, scene in scenes.items()
        ),
        limits=(
            f"On {CELLS}x{CELLS} cells only: the operator differs from hertz_point's by a factor.",
        ),
    )
