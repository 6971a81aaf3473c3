"""The path so far, as the next increment may go on."""

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Vector, VectorField
from semi_analytical.increments.normal_solve import NormalTarget
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.tangential.linearised_shear import Point

# Relative: a load that turns more is not the way to go on.
STRAIGHT = 1e-6
# Of the last increment, of the tangential load or of the logarithm of the normal one: beyond, that
# tells nothing of the next one.
FURTHEST = 2.0


@dataclass(frozen=True)
class PreviousIncrement:
    """What the next increment but one needs of a state, to go on as the path went: of `State`,
    `NormalState` and `Sheared`."""

    target: NormalTarget
    pressure: Field
    shear: VectorField
    displacement: VectorField
    normal_force: float
    approach: float
    covered_cells: float
    force: Vector
    shift: Vector


def further(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> float:
    """How far the tangential load goes on, in parts of its last increment; zero where it does not
    go straight on, or the normal load has not rested."""
    if behind is None or behind.target != now.target or tangential.torsion is not None:
        return 0.0
    if tangential.force is not None:
        way, last = tangential.force - now.force, now.force - behind.force
    else:
        assert tangential.shift is not None
        way, last = tangential.shift - now.shift, now.shift - behind.shift
    along, size = float(np.sum(way * last)), float(np.sum(last * last))
    across = abs(float(way[0] * last[1] - way[1] * last[0]))
    if not 0 < along <= FURTHEST * size or across > STRAIGHT * along:
        return 0.0
    return along / size


def further_shear(
    now: PreviousIncrement, behind: PreviousIncrement | None, tangential: TangentialTarget
) -> Point:
    """The shear with its displacement, as much further as the load goes straight on; else as
    before."""
    part = further(now, behind, tangential)
    if behind is None or part == 0:
        return Point(now.shear, now.displacement)
    return Point(
        now.shear + part * (now.shear - behind.shear),
        now.displacement + part * (now.displacement - behind.displacement),
    )
