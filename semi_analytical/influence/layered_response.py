"""Surface displacement of a layered body at a point by unit forces at the origin."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.influence.radial_table import RadialTable

# Number of points evaluated at a time (some megabytes of work space).
BATCH = 1 << 16


class Components(NamedTuple):
    """Displacement-traction pairs whose point response depends on the same radial functions.

    names   names as in InfluenceCoefficients, e.g. "zz"
    radial  columns of the radial table
    parity  parity of each pair along x and y: 1 even, -1 odd
    turned  function of the radial functions (n, columns), cos phi and sin phi that returns the
            response (len(names), n) in the axes x, y
    """

    names: tuple[str, ...]
    radial: slice
    parity: tuple[tuple[int, int], ...]
    turned: Callable[[Field, Field, Field], Field]


def _normal(radial: Field, cos: Field, sin: Field) -> Field:
    return radial.T


def _tangential(radial: Field, cos: Field, sin: Field) -> Field:
    mean, twist = radial.T
    along = (cos - sin) * (cos + sin) * twist
    return np.stack([mean - along, mean + along, -2 * cos * sin * twist])


def _coupling(radial: Field, cos: Field, sin: Field) -> Field:
    return np.stack([cos, sin]) * radial.T


NORMAL = Components(("zz",), slice(0, 1), ((1, 1),), _normal)
TANGENTIAL = Components(("xx", "yy", "xy"), slice(1, 3), ((1, 1), (1, 1), (-1, -1)), _tangential)
COUPLING = Components(("zx", "zy"), slice(3, 4), ((-1, 1), (1, -1)), _coupling)


def point_response(table: RadialTable, components: Components, x: Field, y: Field) -> Field:
    """Compute surface displacements at points (x, y) by unit forces at the origin [length/force].

    The origin is excluded.

    returns  shape (number of components, *x.shape)
    """
    flat_x, flat_y = x.ravel(), y.ravel()
    values = np.empty((len(components.names), x.size))
    for start in range(0, x.size, BATCH):
        part = slice(start, start + BATCH)
        r = np.hypot(flat_x[part], flat_y[part])
        radial = table(r, components.radial) / r[:, None]
        values[:, part] = components.turned(radial, flat_x[part] / r, flat_y[part] / r)
    return values.reshape(-1, *x.shape)
