"""Linear extrapolation of the load history, as an initial guess for the next increment."""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.increments.tangential_solve import TangentialTarget

# Largest relative deviation of an increment of the tangential load from a multiple of the last
# increment, for extrapolation.
STRAIGHT = 1e-6
# Largest ratio of the new increment of the tangential load to the last one, for extrapolation.
FURTHEST = 2.0


@dataclass(frozen=True)
class PreviousIncrement:
    """Data of an earlier converged state, from which the predictor extrapolates the next increment.

    target         prescribed normal load
    pressure       p (nx, ny) [force/length^2]
    shear          q (2, nx, ny) [force/length^2]
    displacement   tangential surface displacement (2, nx, ny) [length]
    force, shift   tangential force (2,) [force] and shift (2,) [length]
    torque, twist  torque [force length] and twist of the indenter; None without torsion
    """

    target: NormalTarget
    pressure: Field
    shear: VectorField
    displacement: VectorField
    force: Vector
    shift: Vector
    torque: float | None = None
    twist: float | None = None


def further(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> float:
    """Compute the ratio of the next increment of the tangential load to the last increment.

    The predictor extrapolates shear and displacement by this ratio. The load is force or shift,
    and torque or twist. The result is 0 where no extrapolation applies: the proportions of the load
    increment or the normal load change, or the ratio exceeds FURTHEST.

    now         data of the last converged state
    behind      data of the converged state before `now`; None if unknown
    tangential  tangential load of the next increment
    """
    if behind is None or behind.target != now.target:
        return 0.0
    step, last = np.zeros(3), np.zeros(3)
    for part, goal, here, there in (
        (slice(2), tangential.force, now.force, behind.force),
        (slice(2), tangential.shift, now.shift, behind.shift),
        (slice(2, 3), tangential.torque, now.torque, behind.torque),
        (slice(2, 3), tangential.twist, now.twist, behind.twist),
    ):
        if goal is not None and here is not None and there is not None:
            change, before = np.subtract(goal, here), np.subtract(here, there)
            unit = np.linalg.norm(change) or 1.0  # force and torque have different units
            step[part], last[part] = change / unit, before / unit
    if not np.any(last):
        return 0.0
    ratio = float(step @ last / (last @ last))
    straight = np.linalg.norm(step - ratio * last) <= STRAIGHT * np.linalg.norm(step)
    return ratio if straight and 0 < ratio <= FURTHEST * (1 + STRAIGHT) else 0.0


def further_fields(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> PreviousIncrement:
    """Predict pressure, shear and tangential displacement of the next increment.

    The prediction is the initial guess, by linear extrapolation at constant normal load. Without
    valid extrapolation it is the last state.

    now         data of the last converged state
    behind      data of the converged state before `now`; None if unknown
    tangential  tangential load of the next increment
    """
    ratio = further(now, behind, tangential)
    if behind is None or ratio == 0:
        return now
    p, q, u = (
        one + ratio * (one - other)
        for one, other in (
            (now.pressure, behind.pressure),
            (now.shear, behind.shear),
            (now.displacement, behind.displacement),
        )
    )
    return replace(now, pressure=np.maximum(p, 0.0), shear=q, displacement=u)


def further_motion(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> Vector:
    """Predict the rigid tangential motion at the end of the next increment by extrapolation.

    Extrapolated displacements require this motion: with the last motion, all cells would slip.

    now         data of the last converged state
    behind      data of the converged state before `now`; None if unknown
    tangential  tangential load of the next increment
    """
    motion, ratio = tangential.rigid_motion(now.shift, now.twist), further(now, behind, tangential)
    if behind is None:
        return motion
    return motion + ratio * (motion - tangential.rigid_motion(behind.shift, behind.twist))
