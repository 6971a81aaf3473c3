"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

import numpy as np

from contact_solver.tangent import coupled_tangent, stiffnesses
from fem_reference.contact.increment import solved_problem
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.loads import TWIST, Loads

Pair = tuple[float, float]


def contact_stiffness(
    contact: PointContact,
    before: PointState | None,
    loads: Loads,
    state: PointState,
    direction: Pair,
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    A stiffness is the derivative of the force at the end of the increment by the motion there. The
    other loads and the state at the start are kept.

    contact    contact problem at the points of the surface, without loads
    before     state at the start of the increment; None before first contact
    loads      prescribed loads or motions at the end of the increment
    state      state at the end
    direction  unit vector along which the tangential load changes, along and across the first load;
               zero without a tangential load
    raises     NotConverged
    """
    problem = solved_problem(contact, before, loads, state)
    coupled, scale, acting = problem.coupled, problem.scale, list(problem.compliance.acting)
    reaches, motion = problem.compliance.reaches[acting], None
    if state.motions is not None and np.any(problem.bound(state.pressure)):
        motion = np.array(state.motions)[acting] * reaches
    motions = coupled.shifting.with_closing(coupled.closing)
    tangent = coupled_tangent(coupled, scale.roots * state.tractions, motion, motions)
    unit = np.eye(4)[[*acting, TWIST + 1]]
    down, along = contact.rig
    return stiffnesses(
        scale.derivative(tangent, np.append(reaches, 1.0)),
        motions,
        {
            "normal_stiffness": unit[:, TWIST + 1],
            "tangential_stiffness": unit[:, :TWIST] @ direction,
            "torsional_stiffness": unit[:, TWIST],
        },
        {"normal_stiffness": down, "tangential_stiffness": along},
    )
