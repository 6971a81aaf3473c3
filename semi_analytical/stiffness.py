"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

import numpy as np

from contact_scene.rig import compliances
from contact_scene.stepping.load_path import load_changes
from contact_solver.rigid_motion import RigidMotion, RigidMotions
from contact_solver.tangent import contact_stiffnesses
from semi_analytical.coupled.coupled_increment import coupled_problem
from semi_analytical.increments.increment import State
from semi_analytical.increments.normal_solve import MARGIN
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import untouched_state
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import box_around
from semi_analytical.operator.points import points_of


def contact_stiffness(
    model: ContactModel, before: State | None, after: State, step: int
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of a load step, by the names of the results.

    before  state at the start of the last increment; None before first contact
    after   state at its end
    step    number of the load step, from 1
    """
    nothing = untouched_state(model.grid.cells)
    sheared, load = after.sheared or nothing, after.load or TangentialTarget(np.zeros(2))
    last = (before.sheared if before else None) or nothing
    box = box_around(after.pressing.pressure > 0, MARGIN, model.domain)
    problem = coupled_problem(model, box, last, after.target, load, sheared.free)
    p, q = (points_of(t[(..., *box.slices)]) for t in (after.pressing.pressure, sheared.shear))
    shifting, motion = problem.shifting, None
    if load.twist is not None:
        turn = points_of(model.rotation[(..., *box.slices)]) / model.reach
        shifting = RigidMotions(2, (*shifting.each, RigidMotion(turn)))
    if sheared.shift is not None and np.any(problem.friction_limit(p)):
        motion = load.scaled(model, load.rigid_motion(sheared.shift, sheared.twist))
    direction, changes = load_changes(model.scene.load_path(), step)
    axes = [axis for axis in (0, 1) if model.domain.summed[axis]]
    units = np.zeros((3, len(shifting) + len(problem.closing)))
    units[0, len(shifting)] = 1.0
    units[1, : len(axes)] = np.array(direction)[axes]
    units[2, len(axes) : len(shifting)] = model.reach
    return contact_stiffnesses(
        problem,
        np.concatenate([q, p[None]]),
        motion,
        shifting,
        np.sqrt(model.grid.cell_area) * units,
        changes,
        compliances(model.scene.rig),
    )
