"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

import numpy as np

from contact_scene.stepping.load_path import LoadChange
from contact_solver.tangent import contact_stiffnesses
from fem_reference.contact.increment import solved_problem
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.loads import TWIST, Loads


def contact_stiffness(
    contact: PointContact,
    before: PointState | None,
    loads: Loads,
    state: PointState,
    change: LoadChange,
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    contact  contact problem at the points of the surface, without loads
    before   state at the start of the increment; None before first contact
    loads    prescribed loads or motions at the end of the increment
    state    state at the end
    change   loads that the load step changes, with the direction along and across the first
             tangential load
    """
    problem = solved_problem(contact, before, loads, state)
    coupled, scale, acting = problem.coupled, problem.scale, list(problem.compliance.acting)
    reaches, motion = problem.compliance.reaches[acting], None
    if state.motions is not None and np.any(problem.bound(state.pressure)):
        motion = np.array(state.motions)[acting] * reaches
    unit = np.eye(4)[[*acting, TWIST + 1]]
    down, along = contact.rig
    return contact_stiffnesses(
        coupled,
        scale.roots * state.tractions,
        motion,
        coupled.shifting,
        np.sqrt(scale.mean) * np.append(reaches, 1.0),
        {
            "normal_stiffness": unit[:, TWIST + 1],
            "tangential_stiffness": unit[:, :TWIST] @ (change.direction or (0.0, 0.0)),
            "torsional_stiffness": unit[:, TWIST],
        },
        change.changes,
        {"normal_stiffness": down, "tangential_stiffness": along},
    )
