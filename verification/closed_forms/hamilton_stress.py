"""Stress below a sliding Hertz contact: all components at any point of the half-space.

Hamilton (1983) has a closed form. Here the stress is one integral of the same potentials, without
special cases. The pressure √(a²-r²) is the sum over -a < s < a of point sources of strength
(a²-s²)/4 at the complex depth -is. Every potential of a point force at the depth z + is therefore
gives that of the contact (Sackfield and Hills 1983 use the same shift).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

POINTS = 120


def hamilton_stress(
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    contact_radius: float,
    peak_pressure: float,
    peak_shear: float,
    poisson_ratio: float,
) -> NDArray[np.float64]:
    """Compute the stress below a Hertz contact in gross slip along x [force/length²].

    Returns an array (6, …) in the order xx, yy, zz, yz, xz, xy, tension positive.

    x, y, z        position, z > 0 into the body, broadcast together [length] contact_radius a
                   [length]
    peak_pressure  p0 of the pressure p0 √(1-r²/a²) [force/length²]
    peak_shear     q0 of the shear q0 √(1-r²/a²) along +x on the body [force/length²]

    The integrand varies within a distance z of s = r; with s = r + z sinh u this distance is of
    order one. Raises ValueError for z <= 0, where the integral does not exist.
    """
    nu, a = poisson_ratio, 1.0
    x, y, z = np.broadcast_arrays(*(np.asarray(v, dtype=float) / contact_radius for v in (x, y, z)))
    if not np.all(z > 0):
        raise ValueError(f"depth down to {np.min(z)!r}, expected z > 0")
    r = np.hypot(x, y)
    first, last = np.arcsinh(-r / z), np.arcsinh((a - r) / z)
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    total = np.zeros((6, *x.shape))
    for node, weight in zip(nodes, weights, strict=True):
        u = first + (last - first) * (node + 1) / 2
        s = r + z * np.sinh(u)
        step = weight * (last - first) / 2 * z * np.cosh(u)
        # Both signs of s: the real part twice.
        by_p, by_q = _point_stress(x, y, z, z + 1j * s, nu)
        total += step * (a * a - s * s) / 2 * (peak_pressure * by_p + peak_shear * by_q).real
    return total


def _point_stress(
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    z: NDArray[np.float64],
    deep: NDArray[np.complex128],
    nu: float,
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Compute 2π times the stress by a unit point force along z and by one along x, at a complex
    depth.

    The potentials are 1/ρ, -ln(ρ+z) and z ln(ρ+z)-ρ (Boussinesq; Cerruti; Johnson 1985, sections
    3.2 and 3.6).

    x, y, z  position relative to the force, in contact radii
    deep     complex depth z + is of the source
    nu       Poisson's ratio
    """
    rho = np.sqrt(x * x + y * y + deep * deep)
    add = rho + deep
    a1, a3, a5 = 1 / rho, rho**-3, 3 * rho**-5
    b1, b2 = -1 / (rho * add), (2 * rho + deep) * a3 / add**2
    b3 = -(8 * rho**2 + 9 * rho * deep + 3 * deep**2) / (rho**5 * add**3)
    c1, c3 = a1 / add**2, -(3 * rho + deep) * a3 / add**3
    a_z, g = -deep * a3, 1 - 2 * nu
    by_p = [
        g * (b1 + x * x * b2) - z * (x * x * a5 - a3) + 2 * nu * a_z,
        g * (b1 + y * y * b2) - z * (y * y * a5 - a3) + 2 * nu * a_z,
        a_z - z * (deep * deep * a5 - a3),
        -z * y * deep * a5,
        -z * x * deep * a5,
        x * y * (g * b2 - z * a5),
    ]
    by_q = [
        x * (-2 * (1 + nu) * a3 + 2 * nu * (3 * c1 + x * x * c3) + z * (3 * b2 + x * x * b3)),
        x * (2 * nu * (c1 + y * y * c3 - a3) + z * (b2 + y * y * b3)),
        -z * x * deep * a5,
        -z * x * y * a5,
        a_z - z * (x * x * a5 - a3),
        y * (-a3 + 2 * nu * (c1 + x * x * c3) + z * (b2 + x * x * b3)),
    ]
    return np.stack(by_p), np.stack(by_q)
