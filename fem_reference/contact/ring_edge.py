"""Radius of contact and of stick, much finer than the elements.

Towards the edge of a smooth contact the pressure falls like the square root of the distance. On
hats of equal width its computed values near the edge are all decided by where in its element the
edge lies: the first zero is one element beyond the last ring with pressure, and the ratio of the
last two values tells the rest. How, follows from plane contact of a parabola, solved with the same
hats and the kernel -ln|x| of a half-plane; any smooth contact looks like that close enough to its
edge. Elements next to the edge comply a little otherwise than a half-plane does, by Poisson's ratio
of what they are of. The shear that is missing from full slip behaves so at the edge of stick
(Cattaneo 1938), but for what elements do.
"""

from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from contact_scene.body import Body

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Beyond = tuple[float, ...]

# Distance of the edge beyond the last ring, in elements, by powers of the ratio of the last two
# values: cubic through the plane contact, within 2e-5. An edge that has only just passed a ring
# leaves it empty: the edge is `FURTHEST` beyond the last one at most.
BEYOND = (0.02807, 1.00215, 0.12215, 0.01960)

# What square elements add to it: powers of the ratio down, of Poisson's ratio across. Read off
# Hertz's contact on this mesh, 36 and 72 elements over the radius extrapolated to none of it being
# curved; within 3e-4.
BY_ELEMENTS = (
    (0.0173, -0.0439, -0.0072),
    (-0.0019, 0.0013, 0.0011),
    (-0.0400, 0.1039, 0.0294),
    (-0.0103, 0.0235, 0.0361),
)
FURTHEST = 1.05

# Power 3/2 is told from 1/2 by the two values before: at most 0.54 of one another against at least
# 0.77. The last value has reached this part of the one before when the edge reaches the next ring.
GAINING = 0.66
AT_NEXT_RING = 0.3


def beyond_pressure(*bodies: Body) -> Beyond:
    """How far beyond the last ring pressure between bodies ends, in elements, by the ratio of the
    last two values: each body adds what its outermost elements do by how much of the approach is
    its own. At least one deforms."""
    outermost = [body.elastic_materials[0] for body in bodies if body.deforms]
    gives = np.array([1.0 / m.plane_strain_modulus for m in outermost])
    ratios = np.polynomial.polynomial.polyvander([m.poisson_ratio for m in outermost], 2)
    return tuple((BEYOND + np.array(BY_ELEMENTS) @ (gives @ ratios) / gives.sum()).tolist())


def edge_radius(
    radii: Field, values: Field, last: int, step: int = 1, table: Beyond = BEYOND
) -> float:
    """Radius where values that fall like a square root reach zero [length].

    values  (n,), positive at the ring `last`, none at the next
    step    +1 where they fall outwards, -1 where they fall inwards
    table   elements from the last ring to the edge, by the ratio of the last two values
    """
    before, after = last - step, last + step
    width = radii[after] - radii[last]
    if not 0 <= before < len(radii) or values[before] <= 0:
        return float(radii[last] + 0.5 * width)
    middle = radii[last] + 0.5 * width
    # On a circle √(a² - r²) = √(a - r) √(a + r): the second factor is not the edge's.
    circle = sqrt((middle + radii[before]) / (middle + radii[last]))
    ratio = min(1.0, values[last] / values[before] * circle)
    if 0 <= before - step < len(radii) and values[before] < GAINING * values[before - step]:
        beyond = (ratio / AT_NEXT_RING) ** (2 / 3)
    else:
        beyond = float(np.polynomial.polynomial.polyval(ratio, table))
    return float(radii[last] + width * min(FURTHEST, beyond))


def contact_edge(radii: Field, pressure: Field, table: Beyond) -> float:
    """Radius where the pressure ends [length]: the rim of a flat punch if its last ring carries
    any, 0 where none does.

    pressure  (n,), not negative
    table     of `beyond_pressure`
    """
    carrying = np.flatnonzero(pressure > 0)
    if len(carrying) == 0:
        return 0.0
    last = int(carrying[-1])
    if last == len(radii) - 1:
        return float(radii[last])
    return edge_radius(radii, pressure, last, table=table)


def stick_area(
    radii: Field, bound: Field, shear: Field, slips: Mask, contact_radius: float
) -> float:
    """Area of the rings that stick, their edges found between the rings [length^2].

    bound  friction limit (n,), zero where there can be no shear
    shear  its components (c, n), one or two
    slips  (n,) neither where the surfaces stick nor where they are apart
    """
    if not np.any(bound > 0):
        return 0.0
    last = int(np.flatnonzero(bound > 0)[-1])
    stuck = ~slips[: last + 1]
    if bound[0] == 0:
        stuck[0] = stuck[1]
    area = 0.0
    if stuck[last]:
        rim = last == len(radii) - 1
        left = bound - np.sqrt(np.sum(shear**2, axis=0))
        outer = contact_radius if rim else edge_radius(radii, left, last)
        area = pi * min(outer, contact_radius) ** 2
    for ring in np.flatnonzero(stuck[1:] != stuck[:-1]).tolist():
        at, beside, step = (ring, ring + 1, 1) if stuck[ring] else (ring + 1, ring, -1)
        # Missing from slip the way that the neighbour slips: after a reversal not the nearer limit.
        missing = bound - shear[:, beside] @ shear / bound[beside]
        area += step * pi * edge_radius(radii, missing, at, step) ** 2
    return float(area)
