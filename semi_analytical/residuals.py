"""How well a state fulfils the equations of contact: dimensionless, independent of the mesh.

Measures of `contact_scene.quantities.residuals.Residuals`; a NaN in a field is one in its measure.
"""

import numpy as np

from contact_scene.array_types import Field

# Slip below this part of the tangential displacement is judged by the displacement instead:
# with no slip at all its direction means nothing.
LEAST_SLIP = 1e-3


def complementarity(p: Field, g: Field, approach: float) -> float:
    """Σ|g| p / (approach Σp); gaps where p = 0 do not matter and may be infinite."""
    pressed = p > 0
    return float(np.sum(np.abs(g[pressed]) * p[pressed]) / (np.sum(p) * abs(approach)))


def penetration(g: Field, approach: float) -> float:
    """max(-g) / approach, zero if the bodies nowhere overlap."""
    return float(np.maximum(0.0, -np.min(g)) / abs(approach))


def friction_cone(q: Field, bound: Field) -> float:
    """max(|q| - bound) / max(bound), zero if the bound is nowhere exceeded."""
    excess = np.max(np.sqrt(q[0] ** 2 + q[1] ** 2) - bound)
    return float(np.maximum(0.0, excess) / np.max(bound))


def slip_direction(q: Field, bound: Field, slip: Field, displacement: Field) -> float:
    """Σ(bound |w| - q·w) / Σ bound |w|: zero if q has full length along w wherever w is not zero.

    q             shear (2, nx, ny)
    bound         friction limit (nx, ny), zero outside the contact
    slip          w (2, nx, ny), of the indenter relative to the body, so that q follows w
    displacement  tangential displacement (2, nx, ny): the scale where slip nearly vanishes
    """
    work = bound * np.sqrt(slip[0] ** 2 + slip[1] ** 2)
    missing = np.sum(work - q[0] * slip[0] - q[1] * slip[1])
    contact = bound > 0
    largest = np.maximum(np.max(np.abs(displacement[:, contact])), np.max(np.abs(slip[:, contact])))
    least = LEAST_SLIP * largest * np.sum(bound)
    return 0.0 if largest == 0 else float(missing / np.maximum(np.sum(work), least))
