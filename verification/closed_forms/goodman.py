"""Indentation with friction without effect of the shear on the pressure (Goodman; Spence).

A rigid indenter is pressed on a half-space. The pressure moves the surface towards the axis;
friction prevents slip in a central disc. The state is self-similar in the load, so that the ratio
of stick and contact radius is one number for flat punch, cone and paraboloid:

    (a/2c) ln((a + c)/(a - c)) = (µ/β) K'(c/a)

The equation holds for µ > 0, β > 0 under an increasing load. The shear in the stick disc depends on
the load path. The normal displacement by the shear is neglected, which is a relative error of order
β² (Goodman 1962; Spence 1975).
"""

from math import atanh, exp

from scipy.optimize import brentq
from scipy.special import ellipkm1

# Range of log(c/a) in which doubles differ from 0 (for the square) and from 1.
SMALLEST, LARGEST = -340.0, -(2.0**-52)


def stick_ratio(friction: float, dundurs_beta: float) -> float:
    """Compute c/a, between 0 (gross slip) and 1 (full stick).

    friction      µ > 0
    dundurs_beta  β > 0; (1 - 2ν)/(2(1 - ν)) under a rigid indenter

    A ratio that differs from 0 or 1 by less than double precision is returned as 0 or 1.
    """

    def excess(log_c: float) -> float:
        """Compute the difference of both sides of the equation, which grows with c."""
        c = exp(log_c)
        # K of the modulus √(1 - c²), from its complementary parameter c².
        return float(atanh(c) / c - friction / dundurs_beta * ellipkm1(c * c))

    if excess(SMALLEST) >= 0:
        return 0.0
    if excess(LARGEST) <= 0:
        return 1.0
    return exp(brentq(excess, SMALLEST, LARGEST, xtol=1e-16, rtol=1e-15))
