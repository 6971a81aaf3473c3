"""The scenes that were given to other codes: a rigid paraboloid on a coated half-space, slowly.

Codes with updated coordinates measure the gap where the surface has moved to. Under the paper's
ball that raises the load at a given approach by |u_r/r| = (1−2ν)(1+ν) p_H / 2E = 0.4 %; a ball a
hundred times flatter under a hundredth of the force has the same contact radius, and a hundredth
of that difference. Millimetre, newton, megapascal.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from verification.closed_forms.hertz import PointContact

RADIUS = 1800.0
NORMAL_FORCE = 10.0
SUBSTRATE_MODULUS = 210e3
POISSON_RATIO = 0.3

CONTACT_MODULUS = SUBSTRATE_MODULUS / (1 - POISSON_RATIO**2)
HERTZ = PointContact.under_load(NORMAL_FORCE, RADIUS, CONTACT_MODULUS)
MOVED_GAP = (  # relative difference of the load that is left
    (1 - 2 * POISSON_RATIO) * (1 + POISSON_RATIO) * HERTZ.peak_pressure / (2 * SUBSTRATE_MODULUS)
)


@dataclass(frozen=True)
class CoatedScene:
    """What is pressed how far. Poisson's ratio is 0.3 everywhere.

    modulus_ratio  E1/E2, coating over substrate
    thickness      of the coating, over the Hertz radius of the bare substrate
    friction       µ
    approach       at the end, over the Hertz approach of the bare substrate
    increments     equal in the contact radius: the approach goes with the square of the time
    """

    name: str
    modulus_ratio: float
    thickness: float
    friction: float
    approach: float
    increments: int


# Approaches at which the force is the nominal one to some 1e-5, as the box is moved for it.
FRICTIONLESS = CoatedScene("coated_frictionless", 2.0, 1.0, 0.0, 0.82687, 4)
FRICTIONAL = CoatedScene("coated_frictional", 2.0, 1.0, 0.1, 0.82305, 20)


def far_displacement(r: float, z: float) -> tuple[float, float]:
    """Outward and inward displacement of the substrate under the nominal force [length].

    Boussinesq's point force on a half-space (Johnson 1985, eq. 3.18); z into the body.
    """
    shear_modulus = SUBSTRATE_MODULUS / (2 * (1 + POISSON_RATIO))
    rho = math.hypot(r, z)
    scale = NORMAL_FORCE / (4 * math.pi * shear_modulus * rho)
    outward = scale * (r * z / rho**2 - (1 - 2 * POISSON_RATIO) * r / (rho + z))
    return outward, scale * (2 * (1 - POISSON_RATIO) + z**2 / rho**2)
