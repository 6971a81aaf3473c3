"""Dimensionless residuals of the contact and friction laws, independent of the mesh.

All sums run over rings. Tractions are nodal values, gaps and slips are integrals over the hat
functions, so that the sum of their products is the integral of the product of the fields. The
measures are those of `contact_scene.quantities.residuals.Residuals`. A NaN in a field gives NaN.
"""

import numpy as np

from contact_scene.array_types import Field

# Least slip over the displacement of the surfaces that has a direction. Less slip is measured
# relative to the displacement.
LEAST_SLIP = 1e-3


def over(part: float, whole: float) -> float:
    """Return part / whole; 0 if the part is zero, infinite if only the whole is zero."""
    if not part:
        return 0.0
    return part / whole if whole else float("inf")


def complementarity(p: Field, gap: Field, weights: Field, approach: float) -> float:
    """Return Σ|g| p / (approach Σ w p), with g the integral of the gap over a hat and w of the
    hat."""
    return float(np.sum(np.abs(gap) * p) / (np.sum(weights * p) * abs(approach)))


def penetration(gap: Field, weights: Field, approach: float) -> float:
    """Return the largest mean overlap over a hat, relative to the approach."""
    return float(np.maximum(0.0, -np.min(gap / weights)) / abs(approach))


def friction_cone(size: Field, bound: Field) -> float:
    """Return the largest excess of the shear over its limit, relative to the largest limit."""
    largest = np.max(bound)
    return 0.0 if largest == 0 else float(np.maximum(0.0, np.max(size - bound)) / largest)


def slip_direction(q: Field, bound: Field, passed: Field, areas: Field, moved: float) -> float:
    """Return ∫(b|s| − q·s) / ∫b|s|, with s the slip of the indenter relative to the body.

    It is zero if the shear has the length of the limit b along s wherever there is slip.

    q, passed  (2, points)
    moved      largest displacement, the scale for slip too small to have a direction
    """
    work = areas * bound * np.hypot(*passed)
    missing = np.sum(work - areas * np.sum(q * passed, axis=0))
    scale = np.maximum(np.sum(work), LEAST_SLIP * moved * np.sum(areas * bound))
    return 0.0 if scale == 0 else float(missing / scale)
