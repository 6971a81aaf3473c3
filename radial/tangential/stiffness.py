"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

from __future__ import annotations

import numpy as np

from contact_scene.stepping.load_path import LoadChange
from contact_solver.tangent import contact_stiffnesses
from radial.tangential.ring_problem import RingProblem
from radial.tangential.ring_state import NORMAL, TORSION, PointState


def contact_stiffness(
    problem: RingProblem, end: PointState, change: LoadChange, rig: tuple[float, float]
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    problem  contact problem of the increment
    end      its solution
    change   loads that the load step changes, with the direction along θ = 0 and across it
    rig      compliances of the springs of a rig, normal and tangential [length/force]
    """
    coupled, moving, scale = problem.coupled, [*problem.moving, NORMAL], problem.points.scale
    p, q, motion = problem.start(np.append(end.tractions, end.motion))
    slides = end.slides or not np.any(coupled.friction_limit(p))
    unit, (down, along) = np.eye(4)[moving], rig
    return contact_stiffnesses(
        coupled,
        np.concatenate([q, p[None]]),
        None if slides else motion,
        coupled.shifting,
        np.sqrt(scale.mean) * problem.units[moving],
        {
            "normal_stiffness": unit[:, NORMAL],
            "tangential_stiffness": unit[:, :TORSION] @ (change.direction or (0.0, 0.0)),
            "torsional_stiffness": unit[:, TORSION],
        },
        change.changes,
        {"normal_stiffness": down, "tangential_stiffness": along},
    )
