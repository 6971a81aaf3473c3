"""Tangential problem of one increment: stick and slip zones, accumulated slip and dissipation."""

from dataclasses import replace

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from contact_scene.bulk_strain import UNSTRAINED
from contact_scene.friction import sliding_friction
from contact_scene.friction_limit import SLIDING
from contact_scene.quantities.residuals import ShearResiduals
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import NotConverged, motion_undefined
from contact_solver.admissible_shear import magnitude
from contact_solver.conjugate_gradients import Point
from contact_solver.residuals import friction_cone, slip_direction
from contact_solver.shear import ShearSolution
from semi_analytical.increments.full_slip import (
    gross_slip_state,
    loads_reach_limit,
)
from semi_analytical.increments.tangential_solve import (
    TangentialTarget,
    shear,
)
from semi_analytical.increments.tangential_state import (
    TangentialState,
    rigid,
    surface_target,
    torque_of,
    torsion_reached,
    touching_share,
)
from semi_analytical.model import ContactModel

MAX_ATTEMPTS = 3
# Slip is the difference of motion and displacement, and has their rounding errors. This fraction of
# the motion is the least scale of slip, for contacts of a single cell without displacement.
OF_MOTION = 1e-4


def slip_and_stick(
    model: ContactModel,
    pressure: Field,
    last: TangentialState,
    load: TangentialTarget,
    tolerance: float,
    guess: tuple[Point, Vector] | None = None,
    free: VectorField | None = None,
) -> TangentialState:
    """Solve the tangential problem of one increment at a given pressure, from the previous state.

    The solution determines shear, stick and slip zones, slip and dissipated energy at the end of
    the increment.

    pressure   p at the end of the increment (nx, ny) [force/length^2]
    last       tangential state at the start of the increment
    load       prescribed tangential load
    tolerance  limit of all dimensionless residuals
    guess      initial guess of the shear with its displacement, and of the rigid motion; None for
               those of the previous state
    free       free motion of cells before their contact (2, nx, ny) [length]; None without
    raises     NotConverged; GrossSliding if a force exceeds the friction limit
    """
    bound = model.friction_limit(pressure)
    if loads_reach_limit(model, bound, load):
        return gross_slip_state(model, pressure, last, load)
    if last.shift is None:
        raise motion_undefined()
    trivial = _trivial_state(model, pressure, bound, last, load)
    if trivial is not None:
        return trivial
    target = surface_target(model, last, load, free)
    here = Point(last.shear, last.displacement), load.rigid_motion(last.shift, last.twist)
    start, motion = guess or here
    aim, iterations = tolerance, 0
    for _ in range(MAX_ATTEMPTS):
        solution = shear(model, bound, target, load, start, motion, 0.5 * aim)
        iterations += solution.iterations
        solution = replace(solution, iterations=iterations)
        # Slip of the indenter relative to the body in this increment.
        relative_slip = rigid(model, solution.motion) + target - solution.displacement
        residuals = shear_residuals(model, solution, bound, relative_slip, load, last)
        if residuals.worst <= tolerance:
            after = end_state(
                model, pressure, bound, last, load, solution, relative_slip, residuals
            )
            return replace(after, free=free)
        start, motion = Point(solution.shear, solution.displacement), solution.motion
        aim *= 0.1
    raise NotConverged("the shear", iterations, residuals.worst, tolerance)


def _trivial_state(
    model: ContactModel,
    pressure: Field,
    bound: Field,
    last: TangentialState,
    load: TangentialTarget,
) -> TangentialState | None:
    """Return the tangential state of an increment in cases that need no solve; else None.

    These cases are: no tangential load so far, and slip without friction.

    pressure  p at the end of the increment (nx, ny) [force/length^2]
    bound     friction limit µp (nx, ny)
    last      tangential state at the start of the increment
    load      prescribed tangential load
    """
    if load.force is not None and load.torque is None:
        moved = last.shear, last.shift, last.displacement
        changes = load.strain not in (None, last.strain or UNSTRAINED)
        if not load.twists and not changes and not any(map(np.any, (load.force, *moved))):
            return replace(
                last, pressure=pressure, in_stick=bound > 0, iterations=0, strain=load.strain
            )
    if np.any(bound):
        return None
    motion = load.rigid_motion(last.shift if load.shift is None else load.shift, last.twist)
    return frictionless_state(model, pressure, np.zeros_like(last.shear), last, load, motion)


def frictionless_state(
    model: ContactModel,
    pressure: Field,
    displacement: VectorField,
    last: TangentialState,
    load: TangentialTarget,
    motion: Vector,
) -> TangentialState:
    """Return the tangential state of a contact that slips everywhere without friction: no shear.

    pressure      p (nx, ny) [force/length^2]
    displacement  tangential displacement (2, nx, ny) [length] by the pressure alone
    last          tangential state of the previous increment
    load          prescribed tangential load
    motion        rigid motion of the indenter: shift, and twist under torsion
    """
    nothing = np.zeros_like(last.shear)
    slips = np.ones(pressure.shape, dtype=bool)
    solution = ShearSolution(nothing, displacement, motion, slips, 0.0, 0)
    relative_slip = rigid(model, motion) + surface_target(model, last, load) - displacement
    residuals = ShearResiduals(0.0, 0.0, 0.0)
    return end_state(model, pressure, nothing[0], last, load, solution, relative_slip, residuals)


def shear_residuals(
    model: ContactModel,
    solution: ShearSolution,
    bound: Field,
    relative_slip: VectorField,
    load: TangentialTarget,
    last: TangentialState,
) -> ShearResiduals:
    """Compute the residuals of Coulomb's friction law and of tangential equilibrium for a solution.

    Residuals are dimensionless. Those of equilibrium are None without a prescribed force or torque.

    solution       solution of the tangential problem
    bound          friction limit µp (nx, ny)
    relative_slip  slip of the indenter relative to the body (2, nx, ny) [length]
    load           prescribed tangential load
    last           previous state; sets the scale of displacement where the load returns to zero
    """
    q = solution.shear
    equilibrium = None
    if load.force is not None:
        defect = model.domain.resultant(q) - load.force / model.grid.cell_area
        equilibrium = float(np.hypot(*defect) / np.sum(bound))
    torque_equilibrium = None
    if load.torque is not None:
        missing = torque_of(model, q) - load.torque
        limit = np.sum(bound * magnitude(model.rotation)) * model.grid.cell_area
        torque_equilibrium = float(abs(missing) / limit)
    moved = np.maximum(np.abs(solution.displacement), np.abs(last.displacement))
    moved = np.maximum(moved, OF_MOTION * np.abs(rigid(model, solution.motion)))
    return ShearResiduals(
        friction_cone(q, bound),
        slip_direction(q, bound, relative_slip, moved),
        equilibrium,
        torque_equilibrium,
    )


def end_state(
    model: ContactModel,
    pressure: Field,
    bound: Field,
    last: TangentialState,
    load: TangentialTarget,
    solution: ShearSolution,
    relative_slip: VectorField,
    residuals: ShearResiduals,
) -> TangentialState:
    """Build the tangential state at the end of an increment from an accepted solution.

    Slip, slip distance and dissipation of the increment are added to those of the previous state.

    pressure       p at the end of the increment (nx, ny) [force/length^2]
    bound          friction limit µp (nx, ny)
    last           tangential state at the start of the increment
    load           prescribed tangential load
    solution       solution of the tangential problem
    relative_slip  slip of the indenter relative to the body in the increment (2, nx, ny) [length]
    residuals      residuals of friction law and equilibrium
    """
    q = solution.shear
    # Within the tolerance of the solver slip may oppose the shear: such cells count as sticking.
    backward = q[0] * relative_slip[0] + q[1] * relative_slip[1] < 0
    in_stick = (bound > 0) & (~solution.in_slip | backward)
    contact_fraction = touching_share(last.pressure, pressure, model.gap)
    slips = ((pressure > 0) | (last.pressure > 0)) & ~in_stick
    slipped = np.where(slips, contact_fraction * relative_slip, 0.0)
    friction = sliding_friction(
        last.shear, q, relative_slip, model.friction_limit(last.pressure), bound
    )
    lost = np.sum(friction * slipped, axis=0)
    force = model.domain.resultant(q) * model.grid.cell_area
    assert last.dissipated_energy is not None
    twist, torque = torsion_reached(model, load, solution.motion, q)
    after = TangentialState(
        shear=q,
        pressure=pressure,
        contact_fraction=contact_fraction,
        displacement=solution.displacement,
        shift=solution.motion[:2],
        slip=last.slip - slipped,
        slip_distance=last.slip_distance + np.hypot(*slipped),
        dissipation=last.dissipation + lost,
        in_stick=in_stick,
        dissipated_energy=last.dissipated_energy + float(np.sum(lost)) * model.grid.cell_area,
        status=ContactStatus.NO_STICK_AREA_LEFT,
        force=force if load.force is None else load.force,
        residuals=residuals,
        iterations=solution.iterations,
        twist=twist,
        torque=torque,
        strain=load.strain,
    )
    return replace(after, status=_contact_status(model, after, bound, last))


def _contact_status(
    model: ContactModel, after: TangentialState, bound: Field, last: TangentialState
) -> ContactStatus:
    """Determine the contact status at the end of an increment, such as partial slip.

    If no cell sticks, the contact slides if the load reaches the friction limit. The limit is that
    of the force, or of the power of friction under torsion.

    after, last  tangential states at the end and at the start of the increment
    bound        friction limit µp (nx, ny)
    """
    if np.any(after.in_stick):
        everything = np.count_nonzero(after.in_stick) == np.count_nonzero(bound)
        return ContactStatus.FULL_STICK if everything else ContactStatus.PARTIAL_SLIP
    if after.twist is None:
        work, power = float(np.hypot(*after.force)) / model.grid.cell_area, float(np.sum(bound))
    else:
        moved = rigid(model, after.motion) - rigid(model, last.motion)
        work, power = float(np.sum(after.shear * moved)), float(np.sum(bound * magnitude(moved)))
    sliding = work >= power * (1 - SLIDING)
    return ContactStatus.GROSS_SLIDING if sliding else ContactStatus.NO_STICK_AREA_LEFT
