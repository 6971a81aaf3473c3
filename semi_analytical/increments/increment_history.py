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
    """Data of an earlier state for the predictor; see `State` and its solutions."""

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
    """Compute the ratio of the next tangential increment to the last one.

    Zero where no extrapolation applies: the direction or the normal load changes, or torsion acts.
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
    """Extrapolate shear and displacement linearly in the tangential load; see `further`."""
    ratio = further(now, behind, tangential)
    if behind is None or ratio == 0:
        return Point(now.shear, now.displacement)
    return Point(
        now.shear + ratio * (now.shear - behind.shear),
        now.displacement + ratio * (now.displacement - behind.displacement),
    )
