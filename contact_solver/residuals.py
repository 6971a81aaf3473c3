"""Dimensionless residuals of the contact and friction conditions, independent of the cell size.

Where points represent different areas, pressure, shear and friction limit are multiplied by them.
See `contact_scene.quantities.residuals.Residuals`. A NaN in a field gives a NaN.
"""

from collections.abc import Sequence
from math import hypot

import numpy as np

from contact_scene.array_types import Field, Vector

# Least scale of slip, relative to the tangential displacement: the direction of smaller slip is
# undefined.
LEAST_SLIP = 1e-3


def complementarity(p: Field, g: Field, approach: float) -> float:
    """Compute the complementarity residual of the contact: pressure where the gap is open.

    The residual is Σ|g| p / (approach Σp), dimensionless.

    p         pressure (n,)
    g         gap (n,) [length]; may be infinite where p = 0
    approach  approach or overlap of the bodies, the scale of the gap [length]
    """
    pressed = p > 0
    return float(np.sum(np.abs(g[pressed]) * p[pressed]) / (np.sum(p) * abs(approach)))


def penetration(g: Field, approach: float) -> float:
    """Compute the penetration residual of the contact conditions: largest overlap of the bodies.

    The residual is max(-g) / approach, dimensionless; zero if the bodies do not overlap.

    g         gap (n,) [length]
    approach  approach or overlap of the undeformed bodies, the scale of the gap [length]
    """
    return float(np.maximum(0.0, -np.min(g)) / abs(approach))


def friction_cone(q: Field, bound: Field) -> float:
    """Compute the residual of Coulomb's friction limit: largest excess of the shear over the limit.

    The residual is max(|q| - bound) / max(bound), dimensionless, and at least 0. Without friction
    it is 0.

    q      shear (2, n)
    bound  friction limit µp (n,)
    """
    excess, largest = np.max(np.sqrt(q[0] ** 2 + q[1] ** 2) - bound), np.max(bound)
    return 0.0 if largest == 0 else float(np.maximum(0.0, excess) / largest)


def slip_direction(q: Field, bound: Field, slip: Field, displacement: Field) -> float:
    """Compute the residual of Coulomb's slip rule: shear of magnitude µp in the slip direction.

    The residual is Σ(bound |w| - q·w) / Σ bound |w| with the slip w, dimensionless. It is zero if
    the rule holds in all slipping points.

    q             shear (2, n)
    bound         friction limit µp (n,), zero outside the contact
    slip          slip w (2, n) of the indenter relative to the body, in the direction of q
    displacement  tangential displacement (2, n), which sets the least scale of slip
    """
    work = bound * np.sqrt(slip[0] ** 2 + slip[1] ** 2)
    missing = (work - q[0] * slip[0] - q[1] * slip[1]).sum()
    contact = bound != 0
    if not contact.any():
        return 0.0
    largest = np.maximum(np.abs(displacement[:, contact]).max(), np.abs(slip[:, contact]).max())
    least = LEAST_SLIP * largest * bound.sum()
    return 0.0 if largest == 0 else float(missing / np.maximum(work.sum(), least))


def equilibrium(
    carried: Vector, prescribed: Sequence[float | None], most: tuple[float, float]
) -> tuple[float | None, float | None]:
    """Compute the errors of the tangential force and of the torque, over the friction limit [1].

    An error is None if no load is prescribed, or without friction.

    carried     force along two axes and torque of the shear (3,)
    prescribed  prescribed loads (3,); None where the motion is prescribed
    most        largest force and largest torque that friction can carry
    """
    errors = [
        None if load is None else float(found - load)
        for found, load in zip(carried, prescribed, strict=True)
    ]
    forces, torque = [error for error in errors[:2] if error is not None], errors[2]
    return (
        hypot(*forces) / most[0] if forces and most[0] > 0 else None,
        abs(torque) / most[1] if torque is not None and most[1] > 0 else None,
    )
