"""Contact status of a whole contact: stick and slip at its points, and its friction limit."""

import numpy as np

from contact_scene.array_types import Mask
from contact_scene.friction_limit import SLIDING
from contact_scene.quantities.summary import ContactStatus


def contact_status(loaded: Mask, stuck: Mask, limit_ratio: float) -> ContactStatus:
    """Determine the contact status: full stick, partial slip, gross sliding, or no stick area left.

    Gross sliding requires that the tangential loads reach the friction limit.

    loaded       True for points in contact that can carry shear (points,)
    stuck        True for points in contact that can carry shear and stick (points,)
    limit_ratio  factor on the tangential loads of the shear at which all points slip; infinite if
                 no tangential motion of the indenter is possible
    """
    if np.any(stuck):
        whole = np.array_equal(stuck, loaded)
        return ContactStatus.FULL_STICK if whole else ContactStatus.PARTIAL_SLIP
    if limit_ratio * (1 - SLIDING) <= 1:
        return ContactStatus.GROSS_SLIDING
    return ContactStatus.NO_STICK_AREA_LEFT
