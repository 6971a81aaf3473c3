"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

from __future__ import annotations

import numpy as np

from contact_solver.tangent import coupled_tangent, stiffnesses
from radial.tangential.ring_problem import RingProblem
from radial.tangential.ring_state import NORMAL, TORSION, PointState

Pair = tuple[float, float]


def contact_stiffness(
    problem: RingProblem, end: PointState, direction: Pair, rig: Pair
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    A stiffness is the derivative of the force at the end of the increment by the motion there. The
    other loads and the state at the start are kept.

    problem    contact problem of the increment
    end        its solution
    direction  unit vector along which the tangential load changes, along θ = 0 and across it; zero
               without a tangential load
    rig        compliances of the springs of a rig, normal and tangential [length/force]
    raises     NotConverged
    """
    coupled, moving = problem.coupled, [*problem.moving, NORMAL]
    p, q, motion = problem.start(np.append(end.tractions, end.motion))
    slides = end.slides or not np.any(coupled.friction_limit(p))
    motions = coupled.shifting.with_closing(coupled.closing)
    tangent = coupled_tangent(
        coupled, np.concatenate([q, p[None]]), None if slides else motion, motions
    )
    unit, (down, along) = np.eye(4)[moving], rig
    return stiffnesses(
        problem.points.scale.derivative(tangent, problem.units[moving]),
        motions,
        {
            "normal_stiffness": unit[:, NORMAL],
            "tangential_stiffness": unit[:, :TORSION] @ direction,
            "torsional_stiffness": unit[:, TORSION],
        },
        {"normal_stiffness": down, "tangential_stiffness": along},
    )
