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
    """Compute the ratio part / whole of a residual or relative error, also for a zero denominator.

    The ratio is 0 if the numerator `part` is zero, and infinite if only the denominator `whole` is
    zero.
    """
    if not part:
        return 0.0
    return part / whole if whole else float("inf")


def complementarity(p: Field, gap: Field, weights: Field, approach: float) -> float:
    """Compute the residual of the complementarity of gap and pressure [1].

    Pressure and gap must not both differ from zero at a ring, a circle around the axis on the
    surface. The residual is Σ |g| p / (approach Σ w p).

    p         pressure at the rings (rings,) [force/length^2]
    gap       g, integral of the gap over each hat function (rings,) [length^3]
    weights   w, integral of each hat function (rings,) [length^2]
    approach  rigid approach of the indenter [length]
    """
    return float(np.sum(np.abs(gap) * p) / (np.sum(weights * p) * abs(approach)))


def penetration(gap: Field, weights: Field, approach: float) -> float:
    """Compute the largest overlap of the two surfaces, divided by the rigid approach [1].

    The result is the residual of the condition that the gap is not negative. The overlap at a ring
    is the negative part of the mean gap, weighted with the hat function of the ring.

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
