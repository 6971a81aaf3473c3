"""Contact stiffnesses at the end of an increment: normal, tangential and torsional."""

from dataclasses import replace

import numpy as np

from contact_scene import LoadRamp
from contact_scene.rig import compliances
from contact_scene.stepping.load_path import LoadChange
from contact_solver.rigid_motion import RigidMotion, RigidMotions
from contact_solver.tangent import contact_stiffnesses
from semi_analytical.coupled.coupled_increment import coupled_problem
from semi_analytical.increments.increment import State, tangential_target
from semi_analytical.increments.normal_solve import MARGIN
from semi_analytical.increments.tangential_state import untouched_state
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import box_around
from semi_analytical.operator.points import points_of


def contact_stiffness(
    model: ContactModel, before: State | None, after: State, ramp: LoadRamp, change: LoadChange
) -> dict[str, float]:
    """Compute the contact stiffnesses at the end of a load step, by the names of the results.

    before  state at the start of the last increment; None before first contact
    after   state at its end
    ramp    controls of the load step
    change  loads that the load step changes
    """
    nothing = untouched_state(model.grid.cells)
    sheared = after.sheared or nothing
    last = (before.sheared if before else None) or nothing
    load = tangential_target(ramp, None, 1.0, sheared.twist is not None)
    # Displacements are those of the solve, which counts them from a separation.
    load = replace(
        load,
        shift=None if load.shift is None else sheared.shift,
        twist=None if load.twist is None else sheared.twist,
        strain=sheared.strain,
    )
    box = box_around(after.pressing.pressure > 0, MARGIN, model.domain)
    problem = coupled_problem(model, box, last, after.target, load, sheared.free)
    p, q = (points_of(t[(..., *box.slices)]) for t in (after.pressing.pressure, sheared.shear))
    shifting, motion = problem.shifting, None
    if load.twist is not None:
        turn = points_of(model.rotation[(..., *box.slices)]) / model.reach
        shifting = RigidMotions(2, (*shifting.each, RigidMotion(turn)))
    if sheared.shift is not None and np.any(problem.friction_limit(p)):
        motion = load.scaled(model, load.rigid_motion(sheared.shift, sheared.twist))
    axes = [axis for axis in (0, 1) if model.domain.summed[axis]]
    count = len(shifting) + len(problem.closing)
    shift, approach, twist = np.zeros((3, count))
    shift[: len(axes)] = np.array(change.direction or (0.0, 0.0))[axes]
    approach[len(shifting)] = 1.0
    twist[len(axes) : len(shifting)] = 1.0
    sizes = np.where(shift + approach == 0, model.reach, 1.0)
    sizes[: len(axes)] = 1.0
    down, along = compliances(model.scene.rig)
    return contact_stiffnesses(
        problem,
        np.concatenate([q, p[None]]),
        motion,
        shifting,
        np.sqrt(model.grid.cell_area) * sizes,
        {
            "normal_stiffness": approach,
            "tangential_stiffness": shift,
            "torsional_stiffness": twist,
        },
        change.changes,
        {"normal_stiffness": down, "tangential_stiffness": along},
    )
