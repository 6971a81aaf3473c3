"""Linear extrapolation of the load history, as an initial guess for the next increment."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from semi_analytical.increments.normal_solve import NormalTarget
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.tangential.linearised_shear import Point

# Largest sine of a change of direction of the tangential load, for extrapolation.
STRAIGHT = 1e-6
# Largest ratio of the new increment to the last one, of the tangential load or of the logarithm of
# the normal load, for extrapolation.
FURTHEST = 2.0


@dataclass(frozen=True)
class PreviousIncrement:
    """Data of an earlier converged state, from which the predictor extrapolates the next increment.

    target               prescribed normal load
    pressure             p (nx, ny) [force/length^2]
    shear                q (2, nx, ny) [force/length^2]
    displacement         tangential surface displacement (2, nx, ny) [length]
    normal_force, force  normal force and tangential force (2,) [force]
    approach, shift      approach and tangential shift (2,) [length]
    """

    target: NormalTarget
    pressure: Field
    shear: VectorField
    displacement: VectorField
    normal_force: float
    approach: float
    force: Vector
    shift: Vector


def further(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> float:
    """Compute the ratio of the next increment of the tangential load to the last increment.

    The predictor extrapolates shear and displacement by this ratio. The result is 0 where no
    extrapolation applies: the direction of the tangential load or the normal load changes, the
    ratio exceeds FURTHEST, or torsion acts.

    now         data of the last converged state
    behind      data of the converged state before `now`; None if unknown
    tangential  tangential load of the next increment
    """
    if behind is None or behind.target != now.target or tangential.twists:
        return 0.0
    if tangential.force is not None:
        step, last = tangential.force - now.force, now.force - behind.force
    else:
        assert tangential.shift is not None
        step, last = tangential.shift - now.shift, now.shift - behind.shift
    along, size = float(np.sum(step * last)), float(np.sum(last * last))
    across = abs(float(step[0] * last[1] - step[1] * last[0]))
    if not 0 < along <= FURTHEST * size or across > STRAIGHT * along:
        return 0.0
    return along / size


def further_shear(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> Point:
    """Predict shear and tangential displacement of the next increment by linear extrapolation.

    The prediction is the initial guess of the tangential problem. Without valid extrapolation it is
    the last shear and displacement.

    now         data of the last converged state
    behind      data of the converged state before `now`; None if unknown
    tangential  tangential load of the next increment
    """
    ratio = further(now, behind, tangential)
    if behind is None or ratio == 0:
        return Point(now.shear, now.displacement)
    return Point(
        now.shear + ratio * (now.shear - behind.shear),
        now.displacement + ratio * (now.displacement - behind.displacement),
    )
