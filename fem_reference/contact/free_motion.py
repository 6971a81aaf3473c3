"""Free motion of points until they come into contact in an increment of growing loads."""

import numpy as np

from contact_scene.array_types import Field
from contact_scene.stepping.growing_contact import GrowingContact
from fem_reference.contact.point_contact import PointContact
from fem_reference.contact.point_state import PointState
from fem_reference.loads import ALONG, TWIST, Loads
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
    for coupled bodies, and if the contact does not grow or the tangential force does not change.

    contact   contact problem at the points of the surface, without loads
    before    state at the start of the increment
    loads     prescribed loads or motions at the end of the increment
    pressure  pressure at the end (points,) [force/length^2]
    approach  approach at the end [length]
    """
    compliance, w = contact.compliance, contact.compliance.areas
    grown, more = pressure - before.pressure, float(w @ (pressure - before.pressure))
    begins = (before.pressure == 0) & (contact.gap > 0)
    assert before.motions is not None
    target, by_force = loads.tangential, loads.tangential.loads[ALONG] is not None
    ends, starts = target.motions, before.motions
    if by_force:
        ends, starts = target.loads, before.loads
    shifts = [shift for shift in compliance.acting if shift != TWIST]
    changes = {shift: (ends[shift] or 0.0) - starts[shift] for shift in shifts}
    changes = {shift: change for shift, change in changes.items() if change}
    pushed = contact.rings.path in (Path.SHEARING, Path.WHOLE_CIRCLE) and not compliance.couples
    if not (pushed and changes and more > 0 and np.any(begins & (pressure > 0))):
        return None
    nothing, (down, spring) = np.zeros_like(grown), contact.rig
    unit = compliance.motions[list(changes)]
    along = np.stack([compliance.displacement(nothing, one * grown)[0] for one in unit])
    _, normal = compliance.displacement(grown, np.zeros_like(unit[0]))
    along = along - (compliance.springs * grown + spring * more) * unit
    normal = normal - compliance.springs * grown - down * more
    limit = contact.friction.limit
    k, moved = GrowingContact(
        pressure=w * (before.pressure + pressure),
        normal=normal,
        along=along,
        unit=unit,
        approach=approach - before.approach - down * more,
        load=more,
        limit=float(w @ (limit(pressure) - limit(before.pressure))),
        spring=spring,
    ).ratio(np.array([*changes.values()]), by_force=by_force)
    return np.where(begins, np.tensordot(k, along, 1) - np.tensordot(moved, unit, 1), 0.0)
