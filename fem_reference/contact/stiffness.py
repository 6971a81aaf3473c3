"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

from collections.abc import Mapping

import numpy as np

from contact_solver.tangent import contact_stiffnesses
from fem_reference.contact.increment import solved_problem
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState


def contact_stiffness(
    contact: PointContact,
    before: PointState | None,
    state: PointState,
    direction: tuple[float, float],
    changes: Mapping[str, bool],
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of an increment, by the names of the results.

    contact    contact problem at the points of the surface, without loads
    before     state at the start of the increment; None before first contact
    state      state at its end
    direction  unit vector along which the tangential load changes, along and across the first load
    changes    see `load_changes`
    """
    problem = solved_problem(contact, before, state)
    coupled, scale, acting = problem.coupled, problem.scale, list(problem.compliance.acting)
    reaches, motion = problem.compliance.reaches[acting], None
    if state.motions is not None and np.any(problem.bound(state.pressure)):
        motion = np.array(state.motions)[acting] * reaches
    units = np.array([[0, 0, 0, 1], [*direction, 0, 0], [0, 0, 1, 0]])
    return contact_stiffnesses(
        coupled,
        scale.roots * state.tractions,
        motion,
        coupled.shifting,
        np.sqrt(scale.mean) * units[:, [*acting, -1]] * [*reaches, 1.0],
        changes,
        contact.rig,
    )
