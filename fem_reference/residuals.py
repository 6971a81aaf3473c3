"""Dimensionless residuals of the contact law and of Coulomb's friction law on rings.

The residuals do not depend on the mesh size. All sums run over the rings of the surface. Tractions
are nodal values. Gaps and slips are integrals over the hat functions, so that Σ traction × gap is
the integral of the product of both fields. The definitions are those of
`contact_scene.quantities.residuals.Residuals`. A NaN in a field gives a NaN residual.
"""

import numpy as np

from contact_scene.array_types import Field

# Least ratio of slip to the displacement of the surfaces for which the direction of slip is
# defined. Smaller slip is measured relative to the displacement.
LEAST_SLIP = 1e-3


def over(part: float, whole: float) -> float:
    """Divide two numbers of a residual or relative error, also if the denominator is zero.

    part, whole  numerator and denominator; the result is 0 if `part` is zero, and infinity if only
                 `whole` is zero
    """
    if not part:
        return 0.0
    return part / whole if whole else float("inf")


def complementarity(p: Field, gap: Field, weights: Field, approach: float) -> float:
    """Compute the complementarity residual of gap and pressure: Σ |g| p / (approach Σ w p) [1].

    p         pressure at the rings (rings,) [force/length^2]
    gap       g, integral of the gap over each hat function (rings,) [length^3]
    weights   w, integral of each hat function (rings,) [length^2]
    approach  rigid approach of the indenter [length]
    """
    return float(np.sum(np.abs(gap) * p) / (np.sum(weights * p) * abs(approach)))


def penetration(gap: Field, weights: Field, approach: float) -> float:
    """Compute the largest overlap of the surfaces, divided by the rigid approach [1].

    The overlap at a ring is the negative part of the mean gap, weighted with the hat function.

    gap       integral of the gap over each hat function (rings,) [length^3]
    weights   integral of each hat function (rings,) [length^2]
    approach  rigid approach of the indenter [length]
    """
    return float(np.maximum(0.0, -np.min(gap / weights)) / abs(approach))


def friction_cone(size: Field, bound: Field) -> float:
    """Compute the residual of the friction limit: the largest excess of the shear over µp [1].

    The excess is relative to the largest friction limit of all points.

    size   magnitude of the shear at the points (points,) [force/length^2]
    bound  friction limit µp at the points (points,) [force/length^2]
    """
    largest = np.max(bound)
    return 0.0 if largest == 0 else float(np.maximum(0.0, np.max(size - bound)) / largest)


def slip_direction(q: Field, bound: Field, passed: Field, areas: Field, moved: float) -> float:
    """Compute the residual of the slip direction: ∫(b|s| − q·s) / ∫b|s| [1].

    The residual is zero if the shear q is equal to the friction limit b and parallel to the slip s
    wherever there is slip. Here s is the slip of the indenter relative to the lower body.

    q       shear (2, points) [force/length^2]
    bound   b, friction limit µp (points,) [force/length^2]
    passed  s, slip in the increment (2, points) [length]
    areas   surface areas that the points represent (points,) [length^2]
    moved   largest displacement; limits the denominator from below if the slip is too small to have
            a direction [length]
    """
    work = areas * bound * np.hypot(*passed)
    missing = np.sum(work - areas * np.sum(q * passed, axis=0))
    scale = np.maximum(np.sum(work), LEAST_SLIP * moved * np.sum(areas * bound))
    return 0.0 if scale == 0 else float(missing / scale)
