"""Free motion of points until they come into contact in an increment of growing loads."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array
from contact_scene.stepping.growing_contact import GrowingContact
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_state import NORMAL, TORSION, Loads, PointState, resultant_loads

# Relative change of a load that is round-off.
ROUND_OFF = 1e-12


class Growth(NamedTuple):
    """Contact that grows without slip in an increment.

    free   free motion of N points until their contact, times their areas (2 N,) [length³]; 0 at
           points that were in contact before
    guess  tractions and rigid motion at the end, as an initial guess (3 N + 4,)
    """

    free: Array
    guess: Array


def growth_without_slip(
    points: ContactPoints,
    friction: CoulombFriction,
    loads: Loads,
    last: PointState | None,
    trial: PointState,
    springs: tuple[float, float],
) -> Growth | None:
    """Compute free motion and shear of an increment in which the contact grows without slip.

    None is returned if the contact does not grow, or if the tangential load does not change.

    points    points of the contact (rings × angles)
    friction  friction law
    loads     prescribed loads and rigid motions at the end of the increment
    last      state at the start of the increment; None before first contact
    trial     state at the end, solved without free motion, whose pressure is used
    springs   compliances of the test rig, normal and tangential [length/force]
    """
    size, areas = len(points.areas), points.areas
    nothing = np.zeros(size)
    start = nothing if last is None else last.pressure
    grown = trial.pressure - start
    more = float(areas @ grown)
    by_force = loads.forces[0] is not None
    prescribed = np.array([*(loads.forces if by_force else loads.motions)[:TORSION]], dtype=float)
    if last is None:
        before = np.zeros(4)
    else:
        before = resultant_loads(points, last.tractions) if by_force else last.motion
    change = prescribed - before[:TORSION]
    changes = np.abs(change) > ROUND_OFF * np.abs(prescribed)
    free = np.any(points.rigid_motions[:TORSION], axis=1) & changes
    apart = (start == 0) & (points.gap_areas > 0)
    if more <= 0 or not np.any(free) or not np.any(apart & (trial.pressure > 0)):
        return None
    both = np.tile(areas, 2)
    unit = points.rigid_motions[:TORSION][free] / both
    shears = [np.concatenate([one * np.tile(grown, 2), nothing]) for one in unit]
    along = np.array([points.operator(one)[: 2 * size] for one in shears]) / both
    down, spring = springs
    along -= spring * more * unit
    normal = points.operator(np.concatenate([nothing, nothing, grown]))[2 * size :] / areas
    approach = trial.motion[NORMAL] - (0.0 if last is None else last.motion[NORMAL])
    parts = (len(unit), 2, size)
    k, shift = GrowingContact(
        pressure=areas * (start + trial.pressure),
        normal=normal - down * more,
        along=along.reshape(parts),
        unit=unit.reshape(parts),
        approach=approach - down * more,
        load=more,
        limit=float(areas @ (friction.limit(trial.pressure) - friction.limit(start))),
        spring=spring,
    ).ratio(change[free], by_force=by_force)
    shear = k @ unit * np.tile(grown, 2) + (0.0 if last is None else last.shear.ravel())
    motion = np.zeros(4) if last is None else last.motion.copy()
    motion[:TORSION][free] += shift + spring * more * k
    motion[NORMAL] = trial.motion[NORMAL]
    return Growth(
        np.where(np.tile(apart, 2), both * (k @ along - shift @ unit), 0.0),
        np.concatenate([shear, trial.pressure, motion]),
    )
