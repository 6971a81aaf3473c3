"""Hertz's contact of the paper's ball: its force on bodies of its E*, without friction."""

from __future__ import annotations

from contact_scene import LoadStep, Scene
from verification.problems import paper_scene as paper
from verification.problems.paper_scene import HERTZ
from verification.problems.problem import OVER_PEAK, Problem

SOURCE = "Hertz 1882; Johnson 1985, ch. 4"


def hertzian(scene: Scene) -> Problem:
    """A scene whose single step ends in the paper's contact."""
    return Problem(
        scene,
        (HERTZ,),
        HERTZ.contact_radius,
        SOURCE,
        scales={OVER_PEAK: HERTZ.peak_pressure},
        equations=(
            r"a^3 = \frac{3 W R}{4 E^*},\quad \delta = \frac{a^2}{R},\quad "
            r"p = \frac{3 W}{2 \pi a^2} \sqrt{1 - r^2/a^2}",
        ),
    )


def _pressed(title: str, load: LoadStep) -> Problem:
    ball = paper.paraboloid(paper.STEEL)
    return hertzian(paper.frictionless(title, ball, paper.STEEL, load))


BALL = _pressed("Ball on a half-space (paper's data, paraboloid)", paper.pressing())
LED_BALL = _pressed("Ball on a half-space, approach prescribed", LoadStep(approach=HERTZ.approach))
