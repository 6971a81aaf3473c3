"""The shear half of an increment: stick, slip, and what the surfaces remember."""

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import ShearResiduals
from contact_scene.solver_errors import GrossSliding
from contact_scene.summary import ContactStatus
from fem_reference.contact.complementarity.box_program import Sides
from fem_reference.contact.complementarity.contact_problem import Sideways
from fem_reference.contact.complementarity.shearing import SidewaysTarget
from fem_reference.contact.complementarity.state import Slid, resultant
from fem_reference.loads import Loads
from fem_reference.residuals import friction_cone, slip_direction

Field = NDArray[np.float64]

# A force this close to the friction limit, relatively, is at it: what sticks there is round-off.
AT_LIMIT = 1e-6


def target_of(loads: Loads) -> SidewaysTarget:
    """What leads the indenter sideways or round; nothing for radial shear."""
    if loads.tangential is not None:
        force, motion = loads.tangential.force, loads.tangential.shift
    elif loads.twisting is not None:
        force, motion = loads.twisting.torque, loads.twisting.twist
    else:
        return SidewaysTarget()
    return SidewaysTarget(None if force is None else force / (2 * pi), motion)


def capacity(sideways: Sideways, p: Field) -> float:
    """The largest resultant over 2π that friction carries."""
    if sideways.motion is None:
        return 0.0
    return sideways.coefficient * float(np.sum(sideways.motion * limited(sideways, p)))


def limited(sideways: Sideways, p: Field) -> Field:
    """The pressure, without the ring on the axis where there can be no shear."""
    return p if sideways.on_axis else np.where(np.arange(len(p)) > 0, p, 0.0)


def reaches_limit(target: SidewaysTarget, capacity: float) -> bool:
    """Whether a force is at the friction limit; GrossSliding if it is beyond."""
    if target.resultant is None:
        return False
    size = abs(target.resultant)
    if size > capacity * (1 + AT_LIMIT):
        raise GrossSliding(
            f"tangential force or torque {2 * pi * size:.6g} exceeds the friction limit "
            f"{2 * pi * capacity:.6g}: gross sliding; prescribe the shift or twist instead"
        )
    return size >= capacity * (1 - AT_LIMIT)


def slid(
    sideways: Sideways, p: Field, q: Field, motion: float, sides: Sides, last: Slid
) -> tuple[Slid, Field]:
    """The shear part after an increment, and the slip increment over the hats (n,)."""
    offset = displaced(sideways, p, q)
    if sideways.motion is not None:
        offset -= motion * sideways.motion
    step = offset - last.offset
    # Without friction there are no sides, and all that touches slips.
    slips = sides != 0 if sideways.coefficient > 0 else limited(sideways, p) > 0
    slipped = np.where(slips, step, 0.0)
    assert last.dissipated is not None
    after = Slid(
        shear=q,
        offset=offset,
        motion=motion,
        sides=sides,
        slip=last.slip + slipped,
        dissipated=last.dissipated - 2 * pi * float(np.sum(q * slipped)),
        resultant=resultant(sideways, q),
        status=_status(sideways, p, q, sides),
    )
    return after, step


def at_limit(sideways: Sideways, p: Field, target: SidewaysTarget, last: Slid) -> Slid:
    """Force control at the friction limit: the shear is known, the motion is not.

    Where friction carries nothing at all, because its coefficient vanishes, the indenter stays.
    """
    assert target.resultant is not None
    sign = int(np.sign(target.resultant))
    q = sign * sideways.coefficient * limited(sideways, p)
    loose = sign == 0
    return replace(
        last,
        shear=q,
        offset=displaced(sideways, p, q),
        motion=last.motion if loose else None,
        sides=np.where(q != 0, sign, 0).astype(np.int8),
        dissipated=last.dissipated if loose else None,
        resultant=resultant(sideways, q),
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

    step  slip increment over the hats; None where it is undefined
    """
    bound, target = sideways.coefficient * p, target_of(loads)
    direction = missing = None
    if step is not None:
        room = limited(sideways, bound)
        # Apart, for where nothing slips the two cancel.
        moved = np.abs(displaced(sideways, p, np.zeros_like(p)))
        moved += np.abs(sideways.compliance @ after.shear)
        direction = slip_direction(after.shear, room, step, moved)
    if target.resultant is not None:
        limit = capacity(sideways, p)
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
    loaded = limited(sideways, p) > 0
    stuck = loaded & (sides == 0)
    if sideways.coefficient > 0 and np.any(stuck):
        return ContactStatus.FULL_STICK if np.all(stuck == loaded) else ContactStatus.PARTIAL_SLIP
    if sideways.motion is None:
        return ContactStatus.NO_STICK_AREA_LEFT
    carried = abs(float(np.sum(sideways.motion * q)))
    everything = carried >= capacity(sideways, p) * (1 - AT_LIMIT)
    return ContactStatus.GROSS_SLIDING if everything else ContactStatus.NO_STICK_AREA_LEFT
