"""Comparison of a tangential load with the friction limit of the whole contact, for all solvers.

At the friction limit all points slip in the direction of the load (gross slip). The motion of the
indenter that conforms to the load is undefined there. Above the limit there is no equilibrium.
"""

from collections.abc import Sequence
from math import ceil, hypot

from contact_scene.friction import CoulombFriction
from contact_scene.solver_errors import GrossSliding
from contact_scene.stepping.load_path import ControlKind, LoadRamp

# Relative excess of a load over the friction limit that is a rounding error. Products, and pairwise
# sums over the points of a contact, have errors of about 10 ε = 2e-15. No tolerance of a residual
# is below 1e-12.
ROUND_OFF = 1e-12
# Relative distance from the friction limit within which a load is at the limit. The shift grows
# like (1 - T/µW)^-½, here by 3e4, which exceeds the contact. A solver would determine it from a
# difference of forces below the tolerance of equilibrium.
AT_LIMIT = 1e-9
# Relative distance from the friction limit within which a load counts as gross sliding if no point
# sticks. The radius of a stick zone hidden between the points is 1 % of the contact radius (the
# cube root), less than a cell, an element or a ring.
SLIDING = 1e-6
# Round-off of a number of increments.
SHARE_ROUND_OFF = 1e-9


def reaches_limit(load: float, limit: float) -> bool:
    """Return True if a tangential load is at the friction limit (within `AT_LIMIT`) or above.

    load   magnitude of a tangential force or torque
    limit  largest load of this kind that friction can carry
    """
    return load >= limit * (1 - AT_LIMIT)


def exceeds_limit(load: float, limit: float) -> bool:
    """Return True if a tangential load is above the friction limit by more than rounding errors.

    load   magnitude of a tangential force or torque
    limit  largest load of this kind that friction can carry
    """
    return load > limit * (1 + ROUND_OFF)


def load_text(load: float, limit: float) -> str:
    """Return a load above a limit to 6 digits, or to 15 where 6 are those of the limit.

    load   magnitude of a tangential force or torque
    limit  largest load of this kind that friction can carry
    """
    digits = 15 if f"{load:.6g}" == f"{limit:.6g}" else 6
    return f"{load:.{digits}g}"


def refuse_above_limit(force: float, torque: float, times: float) -> None:
    """Raise GrossSliding if friction cannot carry a tangential force and a torque together.

    force   magnitude of the prescribed tangential force [force]; 0 without one
    torque  magnitude of the prescribed torque [force length]; 0 without one
    times   factor on both at which all points slip [1]
    """
    if not exceeds_limit(1.0, times):
        return
    if not torque:
        limit = times * force
        reached = (
            f"tangential force {load_text(force, limit)} N exceeds the friction limit {limit:.6g} N"
        )
        remedy = "tangential_shift"
    elif not force:
        limit = times * torque
        reached = (
            f"torque {load_text(torque, limit)} N m exceeds the friction limit {limit:.6g} N m"
        )
        remedy = "twist"
    else:
        reached = (
            f"torque {torque:.6g} N m and tangential force {force:.6g} N together exceed the "
            f"friction limit, which is {times:.6g} times both"
        )
        remedy = "twist or tangential_shift"
    raise GrossSliding(f"{reached}: gross sliding; prescribe {remedy} instead")


def limit_of_step(friction: CoulombFriction | None, ramp: LoadRamp) -> float | None:
    """Compute the friction limit of the tangential force at the end of a load step [force].

    The result is None if the limit depends on the solution, if the force does, or without friction.

    friction  friction law of the scene; None without friction
    ramp      load ramp of the load step
    """
    if ControlKind.DISPLACEMENT in (ramp.normal.kind, ramp.tangential.kind) or not friction:
        return None
    return friction.largest_tangential_force(ramp.normal.end)


def increments_by_force(
    friction: CoulombFriction | None, ramp: LoadRamp, share: float, most: int
) -> int:
    """Compute the number of increments of a load step in which the tangential force alone changes.

    The force changes in each increment by at most a share of the friction limit.

    friction  friction law of the scene; None without friction
    ramp      load ramp of the load step
    share     largest change over the friction limit [1]
    most      number if the limit or the change of the force depends on the solution
    """
    limit, start = limit_of_step(friction, ramp), ramp.tangential.start
    if limit is None or start is None:
        return most
    change = hypot(*(end - begin for begin, end in zip(start, ramp.tangential.end, strict=True)))
    return max(1, ceil(change / (share * limit) - SHARE_ROUND_OFF)) if limit > 0 else 1


def step_at_limit(friction: CoulombFriction | None, ramps: Sequence[LoadRamp]) -> int | None:
    """Return the first load step that ends with a tangential force at the friction limit.

    Its number counts from 1. The result is None without such a step.

    friction  friction law of the scene; None without friction
    ramps     load ramps of all load steps
    """
    for ramp in ramps:
        limit, force = limit_of_step(friction, ramp), hypot(*ramp.tangential.end)
        if limit and reaches_limit(force, limit):
            return ramp.step
    return None


def undefined_motion_warning(step: int, remedy: str) -> str:
    """Return the warning about a load step that ends at the friction limit under force control.

    step    number of the load step, counted from 1
    remedy  key to prescribe instead: "tangential_shift" or "twist"
    """
    return (
        f"step {step} ends at the friction limit: all points slip, and {remedy} and dissipated "
        f"energy are undefined; prescribe {remedy}"
    )
