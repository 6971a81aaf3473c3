"""Width of the contact and of the stick zone of a line contact, resolved below the strip width.

Towards the edge of a smooth contact the pressure falls like the square root of the distance, so
that p² passes through zero with a finite slope. A parabola is fitted to p² in strips near the edge
and extrapolated to its root.
"""

import numpy as np

from contact_scene.array_types import Array, Mask

# Strips of the fit, counted from the edge. The tractions of the outermost strips differ from the
# means of the exact ones.
FIRST = 3
COUNT = 8
LEAST_COUNT = 4  # for a parabola with a residual
# Largest distance of the root from the border of the outermost strip, in strips. The strip is in
# contact if its centre is, to the error of its neighbours.
FARTHEST = 1.0


def covered_strips(values: Array, inside: Mask) -> float:
    """Compute the width of a contact or stick zone in strips, with fractions of strips at its ends.

    Ends without a root near the border of the outermost strip are at this border: those of a zone
    of few strips, and of tractions that do not fall towards the edge.

    values  traction that is positive inside the zone and falls like a square root towards its
            edges (n,)
    inside  strips in the zone (n,)
    """
    total = float(np.count_nonzero(inside))
    ends = np.flatnonzero(np.diff(np.pad(inside, 1).astype(int)))
    phi = np.square(values)
    for first, last in zip(ends[::2], ends[1::2], strict=True):
        zone = phi[first:last]
        total += _beyond_border(zone) + _beyond_border(zone[::-1])
    return total


def _beyond_border(phi: Array) -> float:
    """Find the root of a parabola through phi, beyond the border of its first strip, in strips.

    phi  squared traction from one edge of the zone to the other (n,)
    """
    first = min(FIRST, len(phi) // 4)
    used = phi[first : first + COUNT]
    if len(used) < LEAST_COUNT:
        return 0.0
    at = first + 0.5 + np.arange(len(used))
    roots = np.roots(np.polyfit(at, used / np.max(used), 2))
    near = roots[np.abs(roots) <= FARTHEST]
    return 0.0 if len(near) != 1 or np.iscomplex(near[0]) else -float(near[0].real)
