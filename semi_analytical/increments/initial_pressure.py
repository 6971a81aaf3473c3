"""Initial guess of the pressure from Hertz theory applied to the bearing area of the gap.

A paraboloid x²/2R touches where its gap is below c = a²/2R, on the area A = πa². In terms of c and
A, Hertz's pressure and load (Johnson 1985, section 4.2) are

    p = 4 E* √(c (c - h) / (π A)),   W = 8/3 E* c √(A/π).

These formulas apply to any gap h: A is its bearing area, the area where h is below c.
"""

from math import pi

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.model import ContactModel


def bearing_pressure(model: ContactModel, target: NormalTarget) -> Field:
    """Compute an initial guess of the contact pressure (nx, ny) from the gap by Hertz theory.

    Cells whose gap is below the bearing depth carry the load. Where Hertz theory does not apply,
    the guess is uniform: if these cells cannot carry the load, or if E* is not positive, as for a
    uniform pressure that raises its centre on an incompressible film with rigid base.

    model   contact model
    target  prescribed normal load
    """
    gap, modulus = target.gap(model), model.bearing_modulus
    touchable = np.isfinite(gap)
    gaps = np.sort(gap[touchable], kind="stable")  # fast, as runs of gaps are sorted
    # Cells of equal gap bear together: the initial guess does not depend on the domain.
    last = np.flatnonzero(np.diff(gaps, append=np.inf))
    gaps, radii = gaps[last], np.sqrt(model.grid.cell_area / pi * (last + 1))
    depth = target.bearing_depth(model, gaps, 8 / 3 * modulus * radii)
    bearing = gap < depth
    if modulus <= 0 or not target.touches(model, np.where(bearing, gap, np.inf)):
        return np.where(touchable, 1.0, 0.0)
    factor = 4 * modulus / (pi * radii[np.count_nonzero(gaps < depth) - 1])
    return np.asarray(factor * np.sqrt(depth * np.maximum(depth - gap, 0.0)))
