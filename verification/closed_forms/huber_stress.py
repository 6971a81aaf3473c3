"""Closed-form stress of a Hertz point contact in a homogeneous half-space, tension positive.

The functions give cylindrical components at radius r and depth z >= 0 under the Hertz pressure
alone. Under the shear of gross slip they give the stress on the axis of symmetry and on the x axis.

`hamilton_stress` gives all components below a sliding contact at any point. Hamilton (1983) has a
closed form. Here the stress is one integral of the same potentials, without special cases. The
pressure √(a²-r²) is the sum over -a < s < a of point sources of strength (a²-s²)/4 at the complex
depth -is. Every potential of a point force at the depth z + is therefore gives that of the contact
(Sackfield and Hills 1983 use the same shift).
"""

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class AxisymmetricStress:
    """Hold stress components in cylindrical coordinates [force/length²], as arrays of one shape.

    radial, hoop, axial  normal stresses σ_rr, σ_θθ, σ_zz, tension positive
    shear                shear stress σ_rz
    """

    radial: Array
    hoop: Array
    axial: Array
    shear: Array


def huber_stress(
    r: ArrayLike, z: ArrayLike, contact_radius: float, peak_pressure: float, poisson_ratio: float
) -> AxisymmetricStress:
    """Compute the stress in a half-space under the Hertz pressure p0 √(1-r²/a²) (Huber 1904).

    r, z            radius and depth >= 0 of the points [length], broadcast together
    contact_radius  contact radius a > 0 [length]
    peak_pressure   peak pressure p0 > 0 [force/length²]
    poisson_ratio   ν of the half-space

    u is the positive root of r²/(a²+u) + z²/u = 1 and t = z/√u. With t² = 1 - r²/(a²+u) the
    classical terms in a²/r² have no singularity on the axis. Raises ValueError for z < 0.
    """
    _require_half_space(contact_radius, peak_pressure, poisson_ratio)
    rho, depth = np.asarray(r, dtype=float), np.asarray(z, dtype=float)
    if not np.all(depth >= 0):
        raise ValueError(f"depth down to {np.min(depth)!r}: the body occupies z >= 0")
    nu = poisson_ratio
    rho, depth = np.broadcast_arrays(np.abs(rho) / contact_radius, depth / contact_radius)
    half = ((rho - 1) * (rho + 1) + depth**2) / 2
    root = np.hypot(half, depth)
    deep = root + np.abs(half)
    near = np.divide(depth**2, deep, out=np.zeros_like(deep), where=deep > 0)
    u = np.where(half >= 0, deep, near)
    t = np.sqrt(np.maximum(1 - rho**2 / (1 + u), 0))
    # at the contact edge u = t = 0 and every term that divides by this sum vanishes
    edge = u + t**2
    edge = np.where(edge > 0, edge, 1.0)
    ring = (1 - 2 * nu) / 3 * (1 + t + t**2) / ((1 + t) * (1 + u))
    arc = (1 + nu) * np.sqrt(u) * np.arctan2(1, np.sqrt(u))
    radial = ring + t**3 / edge + t * ((1 - nu) * u / (1 + u) + arc - 2)
    hoop = -ring - t * (2 * nu + (1 - nu) * u / (1 + u) - arc)
    axial = -(t**3) / edge
    shear = -rho * t**2 * np.sqrt(u) / (edge * (1 + u))
    p0 = peak_pressure
    return AxisymmetricStress(p0 * radial, p0 * hoop, p0 * axial, p0 * shear)


def _require_half_space(a: float, p0: float, nu: float) -> None:
    if not -1 < nu <= 0.5:
        raise ValueError(f"Poisson's ratio is {nu!r}, expected -1 < nu <= 0.5")


def stress_by_hertz_shear(
    x: ArrayLike, contact_radius: float, peak_shear: float, poisson_ratio: float
) -> Array:
    """Compute the surface stress σ_xx at (x, 0) by the shear of a Hertz contact in gross slip
    [force/length²].

    The shear traction on the body is q0 √(1-r²/a²) along +x.

    x               coordinates inside or outside the contact [length]
    contact_radius  contact radius a > 0 [length]
    peak_shear      q0, of any sign [force/length²]
    poisson_ratio   ν of the half-space

    Within the circle the result is -(π/8)(4+ν) q0 x/a (Hamilton and Goodman 1966). Outside, the
    stress -(Q/π)[3ν X³/R⁵ + (1-2ν) X/R³] by a force Q on the surface (Cerruti) is integrated over
    the rays through the circle. Along the ray at the angle φ to the x axis the integral of the
    shear over R is π (x cos φ - √(x²-a²)) q0/a. The integrals over φ from 0 to m = arcsin(a/x) are
    elementary.
    """
    nu = poisson_ratio
    t = np.asarray(x, dtype=float) / contact_radius
    outside = np.abs(t) > 1
    sine = 1 / np.where(outside, np.abs(t), 1.0)
    m, cosine = np.arcsin(sine), np.sqrt((1 - sine) * (1 + sine))
    once = (m - sine * cosine) / 2
    fourth = 3 * m / 8 + np.sin(2 * m) / 4 + np.sin(4 * m) / 32
    cubed = fourth - cosine * (sine - sine**3 / 3)
    beyond = 2 * (3 * nu * cubed + (1 - 2 * nu) * once)
    return np.asarray(-peak_shear * t * np.where(outside, beyond, pi / 8 * (4 + nu)))


def stress_by_partial_slip(
    x: ArrayLike,
    contact_radius: float,
    stick_radius: float,
    peak_shear: float,
    poisson_ratio: float,
) -> Array:
    """Compute the surface stress σ_xx at (x, 0) by the shear of a Hertz contact in partial slip.

    The shear is that of gross slip less that of the stick disc (Hamilton and Goodman 1966).

    stick_radius  radius of the stick disc; 0 for gross slip [length]
    """
    slipping = stress_by_hertz_shear(x, contact_radius, peak_shear, poisson_ratio)
    if stick_radius == 0:
        return slipping
    part = peak_shear * stick_radius / contact_radius
    return slipping - stress_by_hertz_shear(x, stick_radius, part, poisson_ratio)


def stress_by_hertz_pressure(
    x: ArrayLike, contact_radius: float, peak_pressure: float, poisson_ratio: float
) -> Array:
    """Compute the surface stress σ_xx at (x, 0) by the Hertz pressure p0 √(1-r²/a²)
    [force/length²].

    On the x axis σ_xx is the radial stress of Huber (1904).
    """
    return huber_stress(np.abs(x), 0.0, contact_radius, peak_pressure, poisson_ratio).radial


def trailing_edge_tension(
    peak_pressure: float, friction_coefficient: float, poisson_ratio: float
) -> float:
    """Compute the largest tensile stress of a Hertz contact in gross slip [force/length²].

    The maximum p0 [(1-2ν)/3 + (π/8)(4+ν) µ] is at the trailing edge of the contact (Hamilton and
    Goodman 1966; Johnson 1985, section 7.1).
    """
    nu, mu = poisson_ratio, friction_coefficient
    return peak_pressure * ((1 - 2 * nu) / 3 + pi / 8 * (4 + nu) * mu)


POINTS = 120


def hamilton_stress(
    x: ArrayLike,
    y: ArrayLike,
    z: ArrayLike,
    contact_radius: float,
    peak_pressure: float,
    peak_shear: float,
    poisson_ratio: float,
) -> Array:
    """Compute all stress components below a Hertz contact in gross slip along x [force/length²].

    Returns an array (6, …) in the order xx, yy, zz, yz, xz, xy, tension positive.

    x, y, z         positions, z > 0 into the body, broadcast together [length]
    contact_radius  contact radius a [length]
    peak_pressure   p0 of the pressure p0 √(1-r²/a²) [force/length²]
    peak_shear      q0 of the shear q0 √(1-r²/a²) along +x on the body [force/length²]
    poisson_ratio   ν of the half-space

    The stress is an integral over s from -a to a. The integrand varies within a distance z of s =
    r; with s = r + z sinh u this distance is of order one. Raises ValueError for z <= 0, where the
    integral does not exist.
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
    x: Array,
    y: Array,
    z: Array,
    deep: NDArray[np.complex128],
    nu: float,
) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Compute 2π times the stress by unit point forces along z and along x, at a complex depth.

    The integral of the stress over s, with the source at the complex depth -is, gives the stress of
    a Hertz contact. The potentials are 1/ρ, -ln(ρ+z) and z ln(ρ+z)-ρ (Boussinesq; Cerruti; Johnson
    1985, sections 3.2 and 3.6).

    x, y, z  position relative to the force, in contact radii
    deep     complex depth z + is
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
