"""Initial guess of the pressure from Hertz theory applied to the bearing area of the gap.

A paraboloid x²/2R touches where its gap is below c = a²/2R, on the area A = πa². In terms of c and
A, Hertz's pressure and load (Johnson 1985, section 4.2) are

    p = 4 E* √(c (c - h) / (π A)),   W = 8/3 E* c √(A/π).

These formulas apply to any gap h: A is its bearing area, the area where h is below c.
"""

from math import asinh, pi

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.normal.normal_load import NormalLoad


def bearing_pressure(gap: Field, load: NormalLoad, modulus: float, area: float) -> Field:
    """Compute an initial guess of the contact pressure (nx, ny) from the gap by Hertz theory.

    Cells whose gap is below the bearing depth carry the load. Where Hertz theory does not apply,
    the guess is uniform: if E* is not positive, or if these cells cannot carry the load.

    gap      undeformed gap (nx, ny) [length]; infinite where contact is impossible
    load     prescribed normal load
    modulus  E* [force/length^2]; not positive where a uniform pressure raises its centre, as on an
             incompressible film with rigid base
    area     area of a cell with its mirror images [length^2]
    """
    touchable = np.isfinite(gap)
    gaps = np.sort(gap[touchable], kind="stable")  # fast, as runs of gaps are sorted
    # Cells of equal gap bear together: the initial guess does not depend on the domain.
    last = np.flatnonzero(np.diff(gaps, append=np.inf))
    gaps, radii = gaps[last], np.sqrt(area / pi * (last + 1))
    depth = load.bearing_depth(gaps, 8 / 3 * modulus / area * radii)
    bearing = gap < depth
    if modulus <= 0 or not load.touches(np.where(bearing, gap, np.inf)):
        return np.where(touchable, 1.0, 0.0)
    factor = 4 * modulus / (pi * radii[np.count_nonzero(gaps < depth) - 1])
    return np.asarray(factor * np.sqrt(depth * np.maximum(depth - gap, 0.0)))


def modulus_of(compliance: Field, spacing: tuple[float, float]) -> float:
    """Compute the modulus E* of the half-space that represents layered bodies [force/length^2].

    Under a uniform pressure on a rectangle, the half-space has the same central displacement as the
    bodies (Johnson 1985, eq. 3.25). The initial guess of the pressure uses E*.

    compliance  normal displacement of a cell by unit pressure on another (nx, ny), at offsets (i
                dx, j dy) from the centre to half the sides of the rectangle [length^3/force]
    spacing     cell sides dx, dy [length]
    """
    at_middle = 4 * np.sum(compliance) - 2 * np.sum(compliance[0]) - 2 * np.sum(compliance[:, 0])
    a, b = ((2 * n - 1) * side for n, side in zip(compliance.shape, spacing, strict=True))
    mean_inverse_distance = 2 * (a * asinh(b / a) + b * asinh(a / b))
    return mean_inverse_distance / (pi * float(at_middle + compliance[0, 0]))
