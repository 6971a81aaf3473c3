"""How well a state fulfils the equations of contact: dimensionless, independent of the mesh.

All sums run over rings. Tractions are nodal values, gaps and slips are integrals over the hat
functions, so that the sum of their products is the integral of the product of the fields. Measures
of `contact_scene.quantities.residuals.Residuals`; a NaN in a field is one in its measure.
"""

import numpy as np

from contact_scene.array_types import Field

# Slip below this part of what the surfaces move is measured against the motion instead: without
# any slip its direction means nothing.
LEAST_SLIP = 1e-3


def over(part: float, whole: float) -> float:
    """Their ratio; zero where there is no part, infinite where the whole vanishes alone."""
    if not part:
        return 0.0
    return part / whole if whole else float("inf")


def complementarity(p: Field, gap: Field, weights: Field, approach: float) -> float:
    """Σ|g| p / (approach Σ w p), g the integral of the gap over a hat and w of the hat."""
    return float(np.sum(np.abs(gap) * p) / (np.sum(weights * p) * abs(approach)))


def penetration(gap: Field, weights: Field, approach: float) -> float:
    """Largest overlap as a mean over a hat, relative to the approach."""
    return float(np.maximum(0.0, -np.min(gap / weights)) / abs(approach))


def friction_cone(size: Field, bound: Field) -> float:
    """Largest excess of the shear over its bound, relative to the largest bound."""
    largest = np.max(bound)
    return 0.0 if largest == 0 else float(np.maximum(0.0, np.max(size - bound)) / largest)


def slip_direction(q: Field, bound: Field, passed: Field, areas: Field, moved: float) -> float:
    """∫(b|s| − q·s) / ∫b|s| with s the motion of the indenter past the body: zero if the shear has
    its full length along s wherever there is slip.

    q, passed  (2, points)
    moved      largest displacement: the scale where slip nearly vanishes and has no direction
    """
    work = areas * bound * np.hypot(*passed)
    missing = np.sum(work - areas * np.sum(q * passed, axis=0))
    scale = np.maximum(np.sum(work), LEAST_SLIP * moved * np.sum(areas * bound))
    return 0.0 if scale == 0 else float(missing / scale)
