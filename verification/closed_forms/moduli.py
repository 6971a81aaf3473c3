"""Effective moduli of a pair of isotropic half-spaces.

Each body is a pair (Young's modulus [force/length²], Poisson's ratio). A rigid counterbody adds no
compliance and is simply left out. All three moduli combine by adding the bodies' compliances.
"""

import math

ElasticConstants = tuple[float, float]


def contact_modulus(*bodies: ElasticConstants) -> float:
    """Modulus E* of normal contact: 1/E* = sum of (1 - nu²)/E [force/length²].

    The contact stiffness dW/d(approach) of a circular contact is 2 E* a (Johnson 1985, ch. 4).
    """
    return 1 / sum((1 - nu**2) / E for E, nu in _checked(bodies))


def tangential_modulus(*bodies: ElasticConstants) -> float:
    """Modulus G* of tangential contact: 1/G* = sum of (2 - nu)/(4 G) [force/length²].

    The tangential stiffness of a stuck circular contact is 2 G* a (Mindlin 1949).
    """
    return 1 / sum((2 - nu) * (1 + nu) / (2 * E) for E, nu in _checked(bodies))


def _checked(bodies: tuple[ElasticConstants, ...]) -> tuple[ElasticConstants, ...]:
    if not bodies:
        raise ValueError("no elastic body given: at least one of the two must be deformable")
    for E, nu in bodies:
        if not (math.isfinite(E) and E > 0):
            raise ValueError(f"Young's modulus is {E!r}, expected a finite number > 0")
        if not -1 < nu <= 0.5:
            raise ValueError(f"Poisson's ratio is {nu!r}, expected -1 < nu <= 0.5")
    return bodies
