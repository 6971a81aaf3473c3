"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

from collections.abc import Mapping

import numpy as np

from contact_solver.tangent import contact_stiffnesses
from radial.tangential.ring_problem import RingProblem
from radial.tangential.ring_state import NORMAL, PointState


def contact_stiffness(
    problem: RingProblem,
    end: PointState,
    direction: tuple[float, float],
    changes: Mapping[str, bool],
    rig: tuple[float, float],
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    problem    contact problem of the increment
    end        its solution
    direction  unit vector along which the tangential load changes, along θ = 0 and across it
    changes    see `load_changes`
    rig        compliances of the springs of a rig, normal and tangential [length/force]
    """
    coupled, moving = problem.coupled, [*problem.moving, NORMAL]
    p, q, motion = problem.start(np.append(end.tractions, end.motion))
    slides = end.slides or not np.any(coupled.friction_limit(p))
    units = np.array([[0, 0, 0, 1], [*direction, 0, 0], [0, 0, 1, 0]])
    return contact_stiffnesses(
        coupled,
        np.concatenate([q, p[None]]),
        None if slides else motion,
        coupled.shifting,
        np.sqrt(problem.points.scale.mean) * (units * problem.units)[:, moving],
        changes,
        rig,
    )
