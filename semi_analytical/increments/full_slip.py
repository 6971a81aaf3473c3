"""Friction limit of the whole contact, and the tangential state at this limit under force."""

from dataclasses import replace

import numpy as np

from contact_scene.array_types import Field, Vector
from contact_scene.friction_limit import reaches_limit, refuse_above_limit
from contact_scene.quantities.residuals import ShearResiduals
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding, motion_undefined
from contact_solver.gross_slip import exhausts_friction, full_slip, limit_load
from contact_solver.residuals import friction_cone
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import (
    TangentialState,
    torque_of,
)
from semi_analytical.model import ContactModel
from semi_analytical.operator.points import points_of


def force_reaches_limit(force: Vector, limit: float) -> bool:
    """Return True if a tangential force is at the friction limit, so that all cells slip.

    Raise GrossSliding if the force is larger than the limit.

    force  tangential force (2,) [force]
    limit  friction limit Σµp Δ of the contact [force]: sum over the cells of area Δ
    """
    magnitude = float(np.hypot(*force))
    if magnitude:
        refuse_above_limit(magnitude, 0.0, limit / magnitude)
    return reaches_limit(magnitude, limit)


def loads_reach_limit(model: ContactModel, bound: Field, load: TangentialTarget) -> bool:
    """Return True if the prescribed tangential loads are at the friction limit.

    The result is False without friction. Raise GrossSliding if friction cannot carry the loads.

    bound  friction limit µp (nx, ny)
    load   prescribed tangential load
    """
    if load.torque is not None:
        return torque_reaches_limit(model, bound, load)
    if load.force is None or not np.any(load.force):
        return False
    return force_reaches_limit(load.force, float(np.sum(bound)) * model.grid.cell_area)


def torque_reaches_limit(model: ContactModel, bound: Field, load: TangentialTarget) -> bool:
    """Return True if a torque, with the tangential force, is at the friction limit.

    Raise GrossSliding if friction cannot carry them, or at the limit under a prescribed shift.

    bound  friction limit µp (nx, ny)
    load   tangential load with a prescribed torque
    """
    assert load.torque is not None
    torque, force = abs(load.torque), load.force
    if torque == 0 and (force is None or not np.any(force)):
        return False
    if not np.any(bound):
        raise GrossSliding(f"torque {torque:.6g} N m on a contact without friction")
    motions, limits = load.motions(model), points_of(bound)
    if not exhausts_friction(motions, limits):
        return False
    size = 0.0 if force is None else float(np.hypot(*force))
    refuse_above_limit(size, torque, limit_load(motions.held, limits)[0])
    if force is None:
        raise motion_undefined()
    return True


def gross_slip_state(
    model: ContactModel, pressure: Field, last: TangentialState, load: TangentialTarget
) -> TangentialState:
    """Return the tangential state in which prescribed tangential loads are at the friction limit.

    The shear of all cells is µp, in the direction of the force or of a rotation. Shift, and twist
    under a torque, are undefined (None), because the indenter could slide any distance. A load
    below the limit by less than `AT_LIMIT` reduces the shear by this part.

    pressure  p (nx, ny) [force/length^2]
    last      tangential state of the previous increment
    load      tangential load with a prescribed force, and torque if there is one
    """
    bound, force = model.friction_limit(pressure), load.force
    assert force is not None
    motions = load.motions(model)
    q, _ = full_slip(motions, points_of(bound), np.zeros(len(motions)))
    q = q.reshape(2, *bound.shape)
    defect = model.domain.resultant(q) - force / model.grid.cell_area
    twist, torque = load.twist, load.torque
    if twist is not None:
        torque = torque_of(model, q)
    return replace(
        last,
        shear=q,
        pressure=pressure,
        displacement=model.operator(bound.shape).tangential(q),
        shift=None,
        in_stick=np.zeros_like(bound, dtype=bool),
        dissipated_energy=None,
        status=ContactStatus.GROSS_SLIDING,
        force=force,
        residuals=ShearResiduals(
            friction_cone(q, bound),
            None,
            float(np.hypot(*defect) / np.sum(bound)),
        ),
        iterations=0,
        twist=twist,
        torque=torque,
        strain=load.strain,
    )
