"""Free motion of points until they come into contact in an increment of growing loads."""

import numpy as np

from contact_scene.array_types import Field
from contact_scene.stepping.growing_contact import GrowingContact
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.loads import Loads
from fem_reference.plan import Path


def free_motion(
    contact: PointContact,
    before: PointState,
    loads: Loads,
    pressure: Field,
    approach: float,
) -> Field | None:
    """Compute the free motion of all points if the contact grows without slip in an increment.

    The result (2, points) [length] is zero at points that were in contact before. None is returned
    for coupled bodies, and if the contact does not grow or the tangential load does not change.

    contact   contact problem at the points of the surface, without loads
    before    state at the start of the increment
    loads     prescribed loads or motions at the end of the increment
    pressure  pressure at the end (points,) [force/length^2]
    approach  approach at the end [length]
    """
    compliance, target = contact.compliance, loads.tangential
    unit, w = compliance.motion, compliance.areas
    grown, more = pressure - before.pressure, float(w @ (pressure - before.pressure))
    begins = (before.pressure == 0) & (contact.gap > 0)
    assert before.motion is not None
    if target.motion is None:
        change = (target.load or 0.0) - before.load
    else:
        change = target.motion - before.motion
    pushed = contact.rings.path is Path.SHEARING
    if not (pushed and change and more > 0 and np.any(begins & (pressure > 0))):
        return None
    nothing, (down, spring) = np.zeros_like(grown), contact.rig
    along, _ = compliance.displacement(nothing, unit * grown)
    _, normal = compliance.displacement(grown, np.zeros_like(unit))
    along = along - (compliance.springs * grown + spring * more) * unit
    normal = normal - compliance.springs * grown - down * more
    limit = contact.friction.limit
    k, moved = GrowingContact(
        pressure=w * (before.pressure + pressure),
        normal=normal,
        along=along[None],
        unit=unit[None],
        approach=approach - before.approach - down * more,
        load=more,
        limit=float(w @ (limit(pressure) - limit(before.pressure))),
        spring=spring,
    ).ratio(np.array([change]), by_force=target.load is not None)
    return np.where(begins, k * along - moved * unit, 0.0)
