"""Free motion of points until they come into contact in an increment of growing loads."""

import numpy as np

from contact_scene.array_types import Field, Mask
from contact_scene.stepping.growing_contact import GrowingContact, at_nearest_ring
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
    compliance, nothing = contact.compliance, np.zeros_like(pressure)
    if contact.rings.path not in (Path.SHEARING, Path.WHOLE_CIRCLE) or compliance.couples:
        return None
    assert before.motions is not None
    target, by_force = loads.tangential, loads.tangential.loads[ALONG] is not None
    ends, starts = target.motions, before.motions
    if by_force:
        ends, starts = target.loads, before.loads
    shifts = [shift for shift in compliance.acting if shift != TWIST]
    changes = {shift: (ends[shift] or 0.0) - starts[shift] for shift in shifts}
    changes = {shift: change for shift, change in changes.items() if change}

    def at_nearest(values: Field, known: Mask) -> Field:
        """Return the values (2, points) at the nearest known rings; 0 at the axis."""
        on_rings = compliance.vector_on_grid(values), compliance.scalar_on_grid(known)
        found = at_nearest_ring(contact.rings.radii, *on_rings)
        axis, angles = np.zeros_like(values[:, :1]), found.shape[-1]
        return np.concatenate([axis, found.reshape(2, -1)[:, angles:]], axis=1)

    growth = GrowingContact(
        compliance.areas,
        before.pressure,
        pressure,
        contact.gap > 0,
        approach - before.approach,
        contact.rig,
        at_nearest,
    ).without_slip(
        np.array([*changes.values()]),
        compliance.motions[list(changes)],
        lambda q: compliance.displacement(nothing, q)[0] - compliance.springs * q,
        lambda p: compliance.displacement(p, np.zeros((2, len(p))))[1] - compliance.springs * p,
        contact.friction.limit,
        by_force=by_force,
    )
    return None if growth is None else growth.free
