"""Increments drawn near gross slip, T/µW from .99 to .9999, of alike, unlike and coated bodies."""

from __future__ import annotations

from typing import Any

import numpy as np
from contact_scenes import LOAD, PRESS, A, paraboloid, scene, steel

import slipstick
from contact_scene import (
    RIGID,
    Body,
    FiniteElementDiscretisation,
    Layer,
    RadialDiscretisation,
    Scene,
    SurfaceDiscretisation,
)
from contact_scene.solver_errors import SolverError

ELEMENTS = FiniteElementDiscretisation(elements_per_radius=5, harmonics=3)
COARSE: dict[str, Any] = {
    "semi-analytical": SurfaceDiscretisation(cells=(16, 16)),
    "radial": RadialDiscretisation(rings=8),
    "fem": ELEMENTS,
    "fem-complementarity": ELEMENTS,
}


def draw_scene(rng: np.random.Generator) -> Scene:
    """Draw a scene of one to four pushes of alternating sign, some with a growing normal force."""
    ratio, thickness = 10 ** rng.uniform(-1.5, 1.5), 10 ** rng.uniform(-1.3, 0.5)
    base = steel(young_modulus=210e9)
    other = steel(float(rng.choice([0.0, 0.3, 0.49])), 210e9 * ratio)
    bare = Body(material=base)
    coated = Body(material=base, layers=(Layer(thickness=thickness * A, material=other),))
    body, indenter = ((bare, base), (bare, other), (coated, RIGID), (coated, base))[rng.integers(4)]
    friction = float(10 ** rng.uniform(-3, 0.5))
    steps: list[dict] = [{**PRESS, "increments": 1}]
    for number in range(rng.integers(1, 5)):
        part = (1 - 10 ** rng.uniform(-4, -2)) * (-1) ** number
        force = (part * friction * LOAD, 0.0)
        steps.append({"tangential_force": force, "increments": int(rng.integers(1, 4))})
        if rng.random() < 0.3:
            steps.append({"normal_force": LOAD * float(rng.uniform(1, 1.01)), "increments": 1})
    return scene(*steps, friction=friction, indenter=paraboloid(indenter), body=body)


def failures(count: int, seed: int, solver: str) -> tuple[list[str], int]:
    """Solve drawn scenes; return the failures in words, and the number of increments.

    count   least number of increments
    seed    seed of the random numbers
    solver  name of the solver
    """
    rng, found, solved = np.random.default_rng(seed), list[str](), 0
    while solved < count:
        drawn = draw_scene(rng)
        solved += sum(step.increments or 1 for step in drawn.loading)
        try:
            slipstick.solve(drawn, solver, COARSE[solver])
        except SolverError as error:
            found.append(f"{solver}: {type(error).__name__}: {error}\n{drawn!r}")
    return found, solved
