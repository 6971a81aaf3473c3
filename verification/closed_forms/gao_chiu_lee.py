"""First-order effect of a film on the stiffness of a flat punch (Gao, Chiu and Lee 1992).

For a film that differs little from its substrate the contact stiffness S = W/approach of a flat
punch of radius a has, with xi = h/a and derivatives at equal materials,

    d ln S / d ln G1 = I0(xi),    (1 - nu) d ln S / d nu1 at fixed G1 = I1(xi).

The result is analytic and does not use a layered FRF. Differences of any solver for a film on a
substrate must reproduce the derivatives.
"""

from math import atan, log, pi


def modulus_weight(xi: float, poisson_ratio: float) -> float:
    """Compute I0, the weight of the film's shear modulus in the stiffness [1]."""
    nu = poisson_ratio
    logarithm = (1 - 2 * nu) * xi * log((1 + xi**2) / xi**2)
    return 2 / pi * atan(xi) + (logarithm - xi / (1 + xi**2)) / (2 * pi * (1 - nu))


def ratio_weight(xi: float) -> float:
    """Compute I1, the weight of the film's Poisson ratio in the stiffness [1]."""
    return 2 / pi * atan(xi) + xi / pi * log((1 + xi**2) / xi**2)
