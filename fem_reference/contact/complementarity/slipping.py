"""The shear half of an increment: stick, slip, and what the surfaces remember."""

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from contact_scene.friction import sliding_friction
from contact_scene.residuals import ShearResiduals
from contact_scene.summary import ContactStatus
from fem_reference.contact.box_program import Sides
from fem_reference.contact.complementarity.contact_problem import Sideways
from fem_reference.contact.complementarity.ring_state import Slid
from fem_reference.contact.friction_limit import contact_status
from fem_reference.contact.one_component import SidewaysTarget, target_of
from fem_reference.loads import Loads
from fem_reference.residuals import friction_cone, slip_direction

Field = NDArray[np.float64]


def slid(
    sideways: Sideways, p: Field, q: Field, motion: float, sides: Sides, last: Slid, share: Field
) -> tuple[Slid, Field]:
    """The shear part after an increment, and the motion past each other over the hats (n,).

    share  of the increment for which rings touch (n,): of the motion that is slip
    """
    offset = displaced(sideways, p, q)
    if sideways.motion is not None:
        offset -= motion * sideways.motion
    step = offset - last.offset
    # Without friction there are no sides, and all that touches slips; what parts always does.
    slips = sides != 0 if sideways.friction.largest > 0 else sideways.limited(p) > 0
    slipped = np.where(slips | (p == 0), share * step, 0.0)
    assert last.dissipated is not None
    limit = sideways.friction.limit(sideways.limited(p))
    friction = sliding_friction(last.shear[None], q[None], -step[None], last.limit, limit)[0]
    after = Slid(
        shear=q,
        limit=limit,
        offset=offset,
        motion=motion,
        sides=sides,
        slip=last.slip + slipped,
        dissipated=last.dissipated - 2 * pi * float(np.sum(friction * slipped)),
        resultant=2 * pi * sideways.resultant(q),
        status=_status(sideways, p, q, sides),
    )
    return after, step


def at_limit(sideways: Sideways, p: Field, target: SidewaysTarget, last: Slid) -> Slid:
    """Force control at the friction limit: the shear is known, the motion is not.

    Where friction carries nothing at all, because its coefficient vanishes, the indenter stays.
    """
    assert target.resultant is not None
    sign = int(np.sign(target.resultant))
    limit = sideways.friction.limit(sideways.limited(p))
    q = sign * limit
    loose = sign == 0
    return replace(
        last,
        shear=q,
        limit=limit,
        offset=displaced(sideways, p, q),
        motion=last.motion if loose else None,
        sides=np.where(q != 0, sign, 0).astype(np.int8),
        dissipated=last.dissipated if loose else None,
        resultant=2 * pi * sideways.resultant(q),
        status=ContactStatus.GROSS_SLIDING,
    )


def displaced(sideways: Sideways, p: Field, q: Field) -> Field:
    """Displacement of the surfaces past each other over the hats (n,)."""
    displacement = sideways.compliance @ q
    if sideways.by_pressure is not None:
        displacement = displacement + sideways.by_pressure @ p
    return np.asarray(displacement)


def slip_residuals(
    sideways: Sideways, p: Field, after: Slid, step: Field | None, loads: Loads
) -> ShearResiduals:
    """How well a state obeys friction and carries its load.

    step  motion past each other over the hats; None where it is undefined
    """
    bound, target = sideways.friction.limit(p), target_of(loads)
    direction = missing = None
    if step is not None:
        room = sideways.limited(bound)
        # Apart, for where nothing slips the two cancel.
        moved = np.abs(displaced(sideways, p, np.zeros_like(p)))
        moved += np.abs(sideways.compliance @ after.shear)
        direction = slip_direction(after.shear, room, step, moved)
    if target.resultant is not None:
        limit = sideways.capacity(p)
        defect = abs(after.resultant / (2 * pi) - target.resultant)
        missing = 0.0 if limit == 0 else defect / limit
    return ShearResiduals(
        friction_cone=friction_cone(np.abs(after.shear), bound),
        slip_direction=direction,
        tangential_equilibrium=None if loads.twisting else missing,
        torque_equilibrium=missing if loads.twisting else None,
    )


def _status(sideways: Sideways, p: Field, q: Field, sides: Sides) -> ContactStatus:
    """Of the rings that carry pressure and can carry shear."""
    loaded = sideways.limited(p) > 0
    stuck = loaded & (sides == 0) & (sideways.friction.largest > 0)
    carried = None if sideways.motion is None else sideways.resultant(q)
    return contact_status(loaded, stuck, carried, sideways.capacity(p))
