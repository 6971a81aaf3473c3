"""A first pressure where nothing is known yet: Hertz's, on the cells that lie deepest.

A paraboloid x²/2R touches where its gap is below c = a²/2R, on the area A = πa². By these two,
Hertz's pressure and load (Johnson 1985, section 4.2) are

    p = 4 E* √(c (c - h) / (π A)),   W = 8/3 E* c √(A/π),

which can be asked of any gap h: A is the area on which it is below c, its bearing area.
"""

from math import asinh, pi

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.normal.normal_load import NormalLoad


def bearing_pressure(gap: Field, load: NormalLoad, modulus: float, area: float) -> Field:
    """Pressure (nx, ny) below an undeformed gap (nx, ny); the same everywhere where the cells that
    bear by Hertz cannot carry the load, or no half-space yields like the bodies.

    modulus  E* [force/length^2]; not positive where the middle of an even pressure rises, as an
             incompressible film on a rigid base does
    area     of a cell, with its images beyond mirror planes [length^2]
    """
    touchable = np.isfinite(gap)
    # Mirror images have equal gaps: they bear together, so that all domains have the same start.
    gaps, counts = np.unique(gap[touchable], return_counts=True)
    radii = np.sqrt(area / pi * np.cumsum(counts))
    depth = load.bearing_depth(gaps, 8 / 3 * modulus / area * radii)
    bears = gap < depth
    if modulus <= 0 or not load.touches(np.where(bears, gap, np.inf)):
        return np.where(touchable, 1.0, 0.0)
    factor = 4 * modulus / (pi * radii[np.count_nonzero(gaps < depth) - 1])
    return np.asarray(factor * np.sqrt(depth * np.maximum(depth - gap, 0.0)))


def modulus_of(compliance: Field, spacing: tuple[float, float]) -> float:
    """E* of the half-space that yields as much at the middle of an evenly pressed rectangle
    [force/length^2].

    compliance  normal displacement of a cell by unit pressure on another, at offsets (i dx, j dy)
                that end at the middle of the rectangle's sides (nx, ny) [length^3/force]
    spacing     dx, dy: cell sides [length]
    """
    at_middle = 4 * np.sum(compliance) - 2 * np.sum(compliance[0]) - 2 * np.sum(compliance[:, 0])
    a, b = ((2 * n - 1) * side for n, side in zip(compliance.shape, spacing, strict=True))
    mean_inverse_distance = 2 * (a * asinh(b / a) + b * asinh(a / b))
    return mean_inverse_distance / (pi * float(at_middle + compliance[0, 0]))
