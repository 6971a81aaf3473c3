"""Pressing with friction if shear does not act on the pressure (Goodman 1962; Spence 1975).

A rigid indenter pressed on a half-space: pressure draws the surface towards the axis, friction
holds a disc in the middle, outside it slips. The state is self-similar in the load, so the stick
radius over the contact radius is one number for flat punch, cone and paraboloid:

    (a/2c) ln((a + c)/(a - c)) = (µ/β) K'(c/a)

Valid for µ > 0, β > 0 under a load that only grows, with the shear of the stick disc remembering
the way there, and with the normal displacement by shear neglected: a relative error of order β².
"""

from math import atanh, exp

from scipy.optimize import brentq
from scipy.special import ellipkm1

from verification.closed_forms.validity import require_positive

# log(c/a) at the ends of what doubles can tell from 0 (by its square) and from 1.
SMALLEST, LARGEST = -340.0, -(2.0**-52)


def stick_ratio(friction: float, dundurs_beta: float) -> float:
    """c/a, between 0 (nothing sticks) and 1 (all sticks).

    friction      µ > 0
    dundurs_beta  β > 0; (1 - 2ν)/(2(1 - ν)) under a rigid indenter

    Where c/a is closer to 0 or 1 than a double can tell, it is given as that limit.
    """
    require_positive(friction=friction, dundurs_beta=dundurs_beta)

    def excess(log_c: float) -> float:
        """Grows with c: what friction has to hold in the stick disc, less what it can."""
        c = exp(log_c)
        # K of the modulus √(1 - c²), from its complementary parameter c².
        return float(atanh(c) / c - friction / dundurs_beta * ellipkm1(c * c))

    if excess(SMALLEST) >= 0:
        return 0.0
    if excess(LARGEST) <= 0:
        return 1.0
    return exp(brentq(excess, SMALLEST, LARGEST, xtol=1e-16, rtol=1e-15))
