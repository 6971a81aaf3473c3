"""Free motion of points until they come into contact in an increment of growing loads."""

from __future__ import annotations

import numpy as np

from contact_scene import CoulombFriction
from contact_scene.array_types import Array, Field, Mask
from contact_scene.stepping.growing_contact import GrowingContact, at_nearest_ring
from radial.tangential.ring_points import ContactPoints
from radial.tangential.ring_state import NORMAL, TORSION, Loads, PointState, resultant_loads

# Relative change of a load that is round-off.
ROUND_OFF = 1e-12


def growth_without_slip(
    points: ContactPoints,
    friction: CoulombFriction,
    loads: Loads,
    last: PointState | None,
    trial: PointState,
    springs: tuple[float, float],
) -> tuple[Array, Array] | None:
    """Compute free motion and shear of an increment in which the contact grows without slip.

    The results are the free motion of N points until their contact, times their areas (2 N,)
    [length³], and tractions and rigid motion at the end, as an initial guess (3 N + 4,). None is
    returned if the contact does not grow, or if the tangential load does not change.

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
    before = np.zeros(4) if last is None else last.motion
    by_force = loads.forces[0] is not None
    prescribed = np.array([*(loads.forces if by_force else loads.motions)[:TORSION]], dtype=float)
    carried = before
    if last is not None and by_force:
        carried = resultant_loads(points, last.tractions)
    change = prescribed - carried[:TORSION]
    changes = np.abs(change) > ROUND_OFF * np.abs(prescribed)
    free = np.any(points.rigid_motions[:TORSION], axis=1) & changes
    unit = points.rigid_motions[:TORSION][free].reshape(-1, 2, size) / areas

    def displacement(tractions: Array) -> Array:
        """Return the displacements (3, size) by tractions (3, size)."""
        return points.operator(tractions) / areas

    def at_nearest(values: Field, known: Mask) -> Field:
        """Return the values (2, size) at the nearest known rings."""
        rings = len(points.radii), points.count
        found = at_nearest_ring(points.radii, values.reshape(2, *rings), known.reshape(rings))
        return found.reshape(values.shape)

    growth = GrowingContact(
        areas,
        start,
        trial.pressure,
        points.gap_areas > 0,
        trial.motion[NORMAL] - before[NORMAL],
        springs,
        at_nearest,
    ).without_slip(
        change[free],
        unit,
        lambda q: displacement(np.stack([*q, nothing]))[:2],
        lambda p: displacement(np.stack([nothing, nothing, p]))[2],
        friction.limit,
        by_force=by_force,
    )
    if growth is None:
        return None
    shear = growth.shear if last is None else last.shear + growth.shear
    motion = before.copy()
    motion[:TORSION][free] += growth.shift
    motion[NORMAL] = trial.motion[NORMAL]
    return (
        (areas * growth.free).ravel(),
        np.concatenate([shear.ravel(), trial.pressure, motion]),
    )
