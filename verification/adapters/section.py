"""Adapter of the finite-element solver to the challenges."""

from __future__ import annotations

import numpy as np

from contact_scene import FiniteElementDiscretisation, Scene
from contact_scene.solver_errors import NotConverged, UnsupportedScene
from fem_reference import plan, solve
from verification.adapters.own_numbers import answer_on_rings, given_up, scene_of
from verification.challenge.answer import Answer, Solver
from verification.challenge.python_api import (
    CannotDo,
    Posed,
)

ON_ELEMENTS = Solver("slipstick, finite elements")
COARSEST = 16  # elements over the contact radius
HARMONICS = 8


def answer(posed: Posed, level: int) -> Answer:
    """Solve a challenge with finite elements, 16 per contact radius, doubled at each level.

    Raises CannotDo if the finite elements do not support the scene.
    """
    elements = COARSEST * 2**level
    on = FiniteElementDiscretisation(elements_per_radius=elements, harmonics=HARMONICS)
    try:
        result = solve(_refined(scene_of(posed), level), on)
    except UnsupportedScene as error:
        raise CannotDo(str(error)) from error
    except NotConverged as error:
        return given_up(posed, elements, error)
    end = result.steps[-1]
    sides = np.diff(end.radii)
    at_edge = int(np.searchsorted(end.radii, end.contact_radius))
    h = float(sides[min(at_edge, sides.size) - 1])
    return answer_on_rings(posed, result.steps, h)


def _refined(scene: Scene, level: int) -> Scene:
    """Double the increments of path-dependent load steps at each level, so that their error falls
    too.

    Load steps with a prescribed number of increments keep the number.
    """
    decided = plan(scene)
    steps = tuple(
        step.model_copy(update={"increments": count * 2**level})
        if matters and step.increments is None
        else step
        for step, count, matters in zip(
            scene.loading, decided.increments, decided.path_matters, strict=True
        )
    )
    return scene.model_copy(update={"loading": steps})
