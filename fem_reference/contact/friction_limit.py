"""Friction limit of a whole contact: comparison with the tangential load, and contact status."""

import numpy as np

from contact_scene.array_types import Mask
from contact_scene.quantities.summary import ContactStatus
from contact_scene.solver_errors import GrossSliding

# Relative distance from the friction limit within which a load counts as gross slip. The radius of
# the remaining stick zone is 1 % of the contact radius (the cube root), less than an element.
AT_LIMIT = 1e-6


def reaches_limit(load: float | None, capacity: float) -> bool:
    """Return True if a tangential load reaches the friction limit of a contact (gross slip).

    The load counts as reaching the limit if it differs from the largest load that friction can
    carry by less than the relative amount AT_LIMIT, or exceeds this load.

    load      tangential force or torque; None if the motion is prescribed, then the result is False
    capacity  largest force or torque that friction can carry under the present pressure
    """
    return load is not None and abs(load) >= capacity * (1 - AT_LIMIT)


def refuse_beyond_limit(load: float | None, capacity: float) -> None:
    """Raise GrossSliding if a prescribed tangential force or torque exceeds the friction limit.

    No equilibrium exists then. A relative excess up to AT_LIMIT is allowed.

    load      tangential force or torque; None if the motion is prescribed
    capacity  largest force or torque that friction can carry under the present pressure
    """
    if load is not None and abs(load) > capacity * (1 + AT_LIMIT):
        raise GrossSliding(
            f"tangential force or torque {abs(load):.6g} exceeds the friction limit "
            f"{capacity:.6g}: gross sliding; prescribe the shift or twist instead"
        )


def contact_status(
    loaded: Mask, stuck: Mask, carried: float | None, capacity: float
) -> ContactStatus:
    """Determine the contact status: full stick, partial slip, gross sliding, or no stick area left.

    Gross sliding requires that the tangential load reaches the friction limit.

    loaded    True for points in contact that can carry shear (points,)
    stuck     True for points in contact that can carry shear and stick (points,)
    carried   tangential force or torque of the shear, of either sign; None if no tangential motion
              of the indenter is possible
    capacity  largest load that friction can carry
    """
    if np.any(stuck):
        whole = np.array_equal(stuck, loaded)
        return ContactStatus.FULL_STICK if whole else ContactStatus.PARTIAL_SLIP
    if carried is not None and reaches_limit(carried, capacity):
        return ContactStatus.GROSS_SLIDING
    return ContactStatus.NO_STICK_AREA_LEFT
