"""Surface stress by root-like tractions at the contact edge, integrated along rays.

The observer is the point at which the stress is computed. Near the observer φ = p², with the
pressure p, is a quadratic. Along a ray of direction e at the distance r, φ is Q = f + b r + c r²,
with b = grad·e, c = e·H·e/2 and the Hessian H. The surface stress of a point force falls with 1/r².
The contribution of a ray is therefore its angular function times the finite part of the integral of
√Q+/r, which has a closed form. The singular parts cancel, because the angular functions have zero
mean.
"""

from math import pi

import numpy as np

from contact_scene.array_types import Field
from semi_analytical.edge.quadratic import Quadratic
from semi_analytical.stress.point_force import stress_by_force

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(6)
# Bounds of angular panels, graded towards the directions at which rays begin to meet the contact.
GRADES = (0.02, 0.1, 0.5)
# Argument below which the limit k = 0 is used.
STRAIGHT = 1e-9


def stress_by_root(phi: Quadratic, box: Field, slip: Field, nu: float) -> Field:
    """Compute the surface stress (6, n) at points by root-like tractions in boxes about them.

    The tractions are the pressure p = √φ, zero where φ is negative, and the shear q = slip p. The
    sides of the box are parallel to x and y.

    phi   quadratics of φ about the points (n,); lengths in the unit of the box
    box   distances of the sides at -x, +x, -y, +y from the points, positive (4, n)
    slip  shear over pressure (2, n)
    nu    Poisson's ratio
    """
    angle, weight = _ray_directions(phi, box)
    cos, sin = np.cos(angle), np.sin(angle)
    f, f_x, f_y, f_xx, f_xy, f_yy = (
        np.asarray(part)[:, None]
        for part in (phi.f, phi.f_x, phi.f_y, phi.f_xx, phi.f_xy, phi.f_yy)
    )
    b = f_x * cos + f_y * sin
    c = ((f_xx * cos + 2 * f_xy * sin) * cos + f_yy * sin * sin) / 2
    with np.errstate(divide="ignore"):
        reach = np.minimum(
            np.where(cos < 0, box[0][:, None], box[1][:, None]) / np.abs(cos),
            np.where(sin < 0, box[2][:, None], box[3][:, None]) / np.abs(sin),
        )
    force = _along_ray(np.broadcast_to(f, b.shape), b, c, reach) * weight
    forces = np.stack([slip[0][:, None] * force, slip[1][:, None] * force, force])
    stress = np.sum(stress_by_force(-cos, -sin, 0.0, nu, forces), axis=-1)
    p = np.sqrt(np.maximum(phi.f, 0.0))
    stress[:2] -= (1 + 2 * nu) / 2 * p
    stress[2] -= p
    stress[3] -= slip[1] * p
    stress[4] -= slip[0] * p
    return np.asarray(stress)


def _ray_directions(phi: Quadratic, box: Field) -> tuple[Field, Field]:
    """Choose angles and quadrature weights of the rays from each of n points (n, rays).

    The surface stress near the contact edge is an integral over the angle. Gauss points are placed
    on panels between the corners of the box and the directions near which the integral along a ray
    varies rapidly.

    phi  quadratics of φ = p² about the points (n,), with the pressure p
    box  distances of the sides of the box of integration from the points (4, n)
    """
    left, right, down, up = box
    corners = [np.arctan2(y, x) for x in (-left, right) for y in (-down, up)]
    g = phi.slope
    n_x, n_y = phi.f_x / g, phi.f_y / g
    # In the axes of gradient n and tangent t the discriminant b² - 4 f c along n u + t is
    # nn u² + 2 nt u + tt.
    turned_nn = phi.f_xx * n_x**2 + 2 * phi.f_xy * n_x * n_y + phi.f_yy * n_y**2
    turned_nt = (phi.f_yy - phi.f_xx) * n_x * n_y + phi.f_xy * (n_x**2 - n_y**2)
    turned_tt = phi.f_xx * n_y**2 - 2 * phi.f_xy * n_x * n_y + phi.f_yy * n_x**2
    nn, nt, tt = g * g - 2 * phi.f * turned_nn, -2 * phi.f * turned_nt, -2 * phi.f * turned_tt
    nn = np.maximum(nn, 0.1 * g * g)
    width, middle = np.sqrt(np.abs(nt * nt - nn * tt)) / nn, -nt / nn
    towards = np.arctan2(n_y, n_x)
    turns = []
    for side in (1, -1):  # either end of the tangent
        for sign in (1, -1):
            zero = np.arctan2(1.0, side * middle + sign * width)
            turns += [towards + side * (zero - sign * grade) for grade in (0.0, *GRADES)]
    bounds = np.sort(np.stack([*corners, *turns], axis=-1) % (2 * pi), axis=-1)
    bounds = np.concatenate([bounds, bounds[:, :1] + 2 * pi], axis=-1)
    half = np.diff(bounds, axis=-1)[..., None] / 2
    angle = (bounds[:, :-1] + bounds[:, 1:])[..., None] / 2 + half * POINTS
    rays = (len(bounds), -1)
    return angle.reshape(rays), (half * WEIGHTS).reshape(rays)


def _along_ray(f: Field, b: Field, c: Field, reach: Field) -> Field:
    """Integrate the pressure over the distance from the observed point, p/r, along rays 0 < r <
    reach.

    The squared pressure along a ray is Q = f + b r + c r² at the distance r; the pressure is zero
    where Q is negative. The result is the Hadamard finite part of the integral, of the shape of b.

    f, b, c  coefficients of Q
    reach    length of each ray
    """
    root = np.sqrt(np.maximum(b * b - 4 * f * c, 0.0))
    q = -(b + np.where(b < 0, -root, root)) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        roots = np.stack([np.where(c == 0, np.inf, q / c), np.where(q == 0, 0.0, f / q)])
    roots = np.where((b * b >= 4 * f * c) & np.isfinite(roots), roots, 0.0)
    first, second = np.sort(np.clip(roots, 0.0, reach), axis=0)
    total = np.zeros(b.shape)
    for low, high in ((np.zeros_like(reach), first), (first, second), (second, reach)):
        middle = (low + high) / 2
        loaded = (high > low) & (f + b * middle + c * middle * middle > 0)
        if np.any(loaded):
            parts = (part[loaded] for part in (f, b, c, low, high))
            total[loaded] += _integrate_between(*parts)
    return total


def _integrate_between(f: Field, b: Field, c: Field, low: Field, high: Field) -> Field:
    """Integrate the pressure over the distance, √Q/r, along a loaded section low < r < high of a
    ray.

    Q = f + b r + c r² >= 0 is the squared pressure at the distance r from the observed point. The
    singular part of the integral is omitted if `low` is 0.

    f, b, c    coefficients of Q
    low, high  ends of the section
    """
    at_low, at_high = (np.sqrt(np.maximum(f + (b + c * r) * r, 0.0)) for r in (low, high))
    whole = at_high - at_low + b / 2 * _inverse_tangent_term(c, high - low, at_low + at_high)
    from_zero = low == 0
    away = np.where(from_zero, high, low)
    last = f * _inverse_tangent_term(f, 1 / away - 1 / high, at_low / away + at_high / high)
    centre = np.sqrt(np.maximum(f, 0.0))
    regular = from_zero & (centre > 0)
    below = np.where(regular, 2 * centre * at_high + b * high + 2 * f, 1.0)
    ratio = np.where(regular, 4 * f * high / below, 1.0)
    return np.asarray(whole + np.where(from_zero, centre * np.log(ratio), last))


def _inverse_tangent_term(k: Field, n: Field, d: Field) -> Field:
    """Compute 2 arctan(√-k n/d)/√-k for k < 0, and 2 artanh(√k n/d)/√k for k > 0.

    The two formulas are branches of one primitive. They occur in the integral of √Q/r along a ray,
    with a quadratic Q in the distance r from the observed point.
    """
    size = np.sqrt(np.abs(k))
    flat = size * n <= STRAIGHT * d
    size_or_one, d_or_one = np.where(flat, 1.0, size), np.where(d > 0, d, 1.0)
    ratio = np.minimum(size * n / d_or_one, 1 - 1e-16)
    round_ = 2 * np.arctan2(size * n, d) / size_or_one
    open_ = 2 * np.arctanh(ratio) / size_or_one
    return np.where(flat, 2 * n / d_or_one, np.where(k < 0, round_, open_))
