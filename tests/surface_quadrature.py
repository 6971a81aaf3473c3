"""Reference surface displacement of a half-space by quadrature, for tests of the closed forms.

Polar coordinates around the field point cancel the 1/distance of Boussinesq's and Cerruti's
kernels, so that only the traction is integrated along each ray.
"""

from collections.abc import Callable, Sequence

import numpy as np

RAYS = 128
NODES_PER_SEGMENT = 40


def ray_integral(
    traction: Callable[[np.ndarray, np.ndarray], np.ndarray],
    point: tuple[float, float],
    edges: Sequence[tuple[float, float]],
    weight: Callable[[np.ndarray], np.ndarray],
) -> float:
    """Integral of weight(direction) * traction / distance over the outermost ellipse.

    edges: semi-axes of concentric ellipses, growing, on which the traction has square-root edges;
    the point lies inside the first.
    """
    phi = 2 * np.pi * np.arange(RAYS) / RAYS
    cos, sin = np.cos(phi)[:, None], np.sin(phi)[:, None]
    nodes, weights = np.polynomial.legendre.leggauss(NODES_PER_SEGMENT)
    # 1 - cos turns square-root behaviour at both ends of a segment into a smooth one
    fraction = (1 - np.cos(np.pi * (nodes + 1) / 2)) / 2
    weights = weights * np.pi / 4 * np.sin(np.pi * (nodes + 1) / 2)
    total, start = np.zeros(RAYS), np.zeros((RAYS, 1))
    for edge in edges:
        end = _distance_to_ellipse(point, edge, cos, sin)
        s = start + (end - start) * fraction
        values = traction(point[0] + s * cos, point[1] + s * sin)
        total += ((end - start) * values * weights).sum(axis=1)
        start = end
    return float((weight(phi) * total).sum() * 2 * np.pi / RAYS)


def _distance_to_ellipse(point, edge, cos, sin):
    (x, y), (a, b) = point, edge
    quadratic = (cos / a) ** 2 + (sin / b) ** 2
    linear = x * cos / a**2 + y * sin / b**2
    constant = (x / a) ** 2 + (y / b) ** 2 - 1
    return (-linear + np.sqrt(linear**2 - quadratic * constant)) / quadratic


def normal_displacement(pressure, point, edges, contact_modulus):
    """Boussinesq: pressure / (πE* distance)."""
    return ray_integral(pressure, point, edges, lambda phi: 0 * phi + 1 / (np.pi * contact_modulus))


def tangential_displacement(shear, point, edges, shear_modulus, poisson_ratio):
    """Cerruti: displacement (u_x, u_y) of one half-space under traction along x."""
    G, nu = shear_modulus, poisson_ratio
    along = ray_integral(
        shear, point, edges, lambda phi: (1 - nu * np.sin(phi) ** 2) / (2 * np.pi * G)
    )
    across = ray_integral(
        shear, point, edges, lambda phi: nu * np.sin(phi) * np.cos(phi) / (2 * np.pi * G)
    )
    return along, across
