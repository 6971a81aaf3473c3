"""Adapter of the radial solver to the challenges."""

from __future__ import annotations

from contact_scene import RadialDiscretisation
from contact_scene.solver_errors import NotConverged, UnsupportedScene
from radial import solve
from verification.adapters.own_numbers import answer_on_rings, given_up, in_increments, scene_of
from verification.challenge.answer import Answer, Solver
from verification.challenge.python_api import (
    CannotDo,
    Posed,
)

ON_RADII = Solver("slipstick, radial")
COARSEST = 32  # rings; fields are linear between rings, scalars do not depend on them
INCREMENTS = 10  # on the coarsest level, of load steps that prescribe none


def answer(posed: Posed, level: int) -> Answer:
    """Solve a challenge with the radial solver on 32 rings over the contact, doubled at each level.

    Raises CannotDo if the solver does not support the scene.
    """
    rings = COARSEST * 2**level
    try:
        scene = in_increments(scene_of(posed), INCREMENTS * 2**level)
        steps = solve(scene, RadialDiscretisation(rings=rings)).steps
    except UnsupportedScene as error:
        raise CannotDo(str(error)) from error
    except NotConverged as error:
        return given_up(posed, rings, error)
    return answer_on_rings(posed, steps, steps[-1].contact_radius / rings)
