"""Displacement and stress in a half-space below a loaded circle, as integrals along rays.

The solutions of Boussinesq and Cerruti for point forces (Johnson 1985, sections 3.2 and 3.6) are
integrated over the circle in polar coordinates about the point of evaluation. The Jacobian reduces
their d⁻² by one power, where d is the distance along the ray. At the surface the mean over the
angle of the remaining singular term is zero, so ∫ t/d of the traction t is a finite part. Lengths
are in units of the circle's radius.
"""

from __future__ import annotations

from math import pi

import numpy as np

from contact_scene.array_types import Array
from radial.response.quadrature import unit_gauss
from radial.stress.loaded_circle import LoadedCircle
from semi_analytical.frf.stack import HalfSpace

SURFACE = 1e-8  # points at smaller depths over the radius are on the surface
# Points nearer to the edge are on its inner side, however they are rounded. There the pressure is
# 4e-7 of its scale.
ON_EDGE = 1e-13
ROUND_OFF = 1e-9  # of a number of intervals
# Gauss points of a panel of angles and of a ray
ANGLES = 8
POINTS = 6
WIDER = 4.0  # largest ratio of adjacent panels
LEAST = 1e-7  # least width of a panel of a ray, and of a panel of angles
MAX_AT_ONCE = 1 << 18  # quadrature points in a block


def below_circle(
    circle: LoadedCircle, material: HalfSpace, x: Array, y: Array, depth: float, fineness: int = 1
) -> Array:
    """Compute displacement and stress in a half-space below a loaded circle (9, n).

    The fields are u_x, u_y, u_z [length] and σ_xx, yy, zz, yz, xz, xy [force/length²], at n points
    of equal depth. They are integrals over the tractions of the circle, along rays from the point.

    circle       tractions on the surface, over a circle
    material     elastic constants of the half-space
    x, y, depth  coordinates of the points from the circle's centre, over its radius
    fineness     factor on the number of quadrature points per direction, 1 by default
    """
    found = np.empty((9, len(x)))
    r = np.hypot(x, y)
    inward = np.where(np.abs(r - 1) < ON_EDGE, (1 - ON_EDGE) / np.maximum(r, 0.5), 1.0)
    x, y, r = x * inward, y * inward, r * inward
    depth = 0.0 if depth < SURFACE else depth
    # Points with the same panels are evaluated together.
    apart = np.sqrt(np.abs((1 - r) * (1 + r)))
    widths = _count_intervals(np.where(r < 1, np.maximum(apart, LEAST), 1.0))
    nearest = np.maximum(np.hypot(np.where(r < 1, 0.0, r - 1), depth), LEAST)
    if depth == 0:
        nearest = np.maximum(np.abs(1 - r), LEAST)
    lengths = 1 + _count_intervals(np.minimum(nearest, 1.0))
    kinds = np.stack([r < 1, widths, lengths]).astype(np.intp)
    for inside, wide, long in np.unique(kinds, axis=1).T:
        alike = np.flatnonzero(np.all(kinds == np.array([[inside], [wide], [long]]), axis=0))
        each = ANGLES * POINTS * fineness**2 * int(wide) * int(long) * 4
        blocks = min(len(alike), -(-len(alike) * each // MAX_AT_ONCE))
        for some in np.array_split(alike, blocks):
            angles = _ray_directions(r[some], int(wide), fineness) if inside else None
            found[:, some] = _integrate_all_rays(
                circle, material, x[some], y[some], depth, angles, int(long), fineness
            )
    found[:3] *= circle.radius
    return found


def _count_intervals(smallest: Array) -> Array:
    """Return the least number of intervals that grow from `smallest` to 1 in a constant ratio."""
    # Searches place points at powers of the ratio, where round-off must not change the number.
    return np.ceil(1 - np.log(smallest) / np.log(WIDER) - ROUND_OFF)


def _ray_directions(r: Array, count: int, fineness: int) -> tuple[Array, Array]:
    """Return angles of rays from the outward direction [radian], and weights (n, rays).

    Rays are dense where they are nearly tangential to the edge.

    r      distances of the points from the centre over the radius, below 1 (n,)
    count  number of intervals of a quadrant
    """
    width = np.sqrt((1 - r) * (1 + r))
    v, weights = unit_gauss(ANGLES * fineness)
    edges = _interval_ends(np.clip(width, LEAST, 1.0), count) * (pi / 2)
    lengths = np.diff(edges, axis=1)[..., None]
    offset = (edges[:, :-1, None] + lengths * v).reshape(len(r), -1)
    weight = (lengths * weights).reshape(len(r), -1)
    angles = [pi / 2 + offset, pi / 2 - offset, -pi / 2 + offset, -pi / 2 - offset]
    return np.concatenate(angles, axis=1), np.tile(weight, 4)


def _interval_ends(smallest: Array, count: int) -> Array:
    """Return the ends 0, smallest, …, 1 of intervals that grow in constant ratio (…, count + 1)."""
    powers = np.arange(count - 1, -1, -1) / max(count - 1, 1)
    grown = smallest[..., None] ** powers
    return np.concatenate([np.zeros_like(grown[..., :1]), grown], axis=-1)


def _integrate_all_rays(
    circle: LoadedCircle,
    material: HalfSpace,
    x: Array,
    y: Array,
    depth: float,
    angles: tuple[Array, Array] | None,
    count: int,
    fineness: int,
) -> Array:
    """Compute displacement and stress below a loaded circle, for points with equal quadrature.

    The shape is (9, n): u_x, u_y, u_z over the radius of the circle, then σ_xx, yy, zz, yz, xz, xy
    [force/length²]. The tractions are integrated along rays from each of the n points.

    circle       tractions on the surface, over a circle
    material     elastic constants of the half-space
    x, y, depth  coordinates of the points from the circle's centre, over its radius
    angles       angles of the rays from the outward direction, and weights (n, rays); None for
                 points outside the circle
    count        number of intervals of a ray
    fineness     factor on the number of quadrature points per direction, 1 by default
    """
    r = np.hypot(x, y)[:, None]
    outward = np.arctan2(y, x)[:, None]
    if angles is None:
        v, weights = unit_gauss(2 * ANGLES * fineness)
        # Between rays tangential to the edge the sine varies from -1 to 1.
        widest = np.arcsin(np.minimum(1 / r, 1.0))
        turned = widest * (2 * v - 1)
        half = np.sqrt(np.maximum(1 - (r * np.sin(turned)) ** 2, 0.0))
        first = (r - 1) * (r + 1) / (r * np.cos(turned) + half)
        length, weight = 2 * half, 2 * widest * weights
        turned = turned + pi
        scale = np.hypot(first, depth)
    else:
        turned, weight = angles
        along, half = r * np.cos(turned), np.sqrt(np.maximum(1 - (r * np.sin(turned)) ** 2, 0.0))
        # The longer part of a chord is a sum of positive terms. The shorter part follows from the
        # product of the two parts without cancellation.
        product = (1 - r) * (1 + r)
        longer = np.abs(along) + half
        ahead = np.where(along < 0, longer, product / longer)
        behind = np.where(along < 0, product / longer, longer)
        first, length = np.zeros_like(ahead), ahead
        scale = np.full_like(ahead, depth) if depth else behind
    length = np.maximum(length, 1e-300)
    share, part = _ray_quadrature(np.clip(scale / length, LEAST, 1 / WIDER), count, fineness)
    far = first[..., None] + length[..., None] * share
    weight_far = length[..., None] * part
    ways = outward + turned
    cos, sin = np.cos(ways), np.sin(ways)
    t = circle.interpolate_tractions(
        x[:, None, None] + far * cos[..., None], y[:, None, None] + far * sin[..., None]
    )
    rays = _integrate_each_ray(material, t, far, weight_far, depth, cos, sin)
    here = circle.interpolate_tractions(x, y)
    if depth == 0 and angles is not None:
        rays = rays + _finite_part(material, here, far, weight_far, length, cos, sin)
    found = _sum_over_rays(rays, cos, sin, weight)
    if depth == 0:
        p = here[2]
        nu = material.poisson_ratio
        found[3:] += np.stack([-(0.5 + nu) * p, -(0.5 + nu) * p, -p, -here[1], -here[0], 0 * p])
    return found


def _ray_quadrature(scale: Array, count: int, fineness: int) -> tuple[Array, Array]:
    """Return quadrature positions along rays, as fractions of the ray, and weights (…, points).

    The points are dense towards the start of the ray at 0. Substitutions remove roots of the
    integrand at both ends. Used to integrate tractions along rays below a loaded circle.

    scale     width of the first interval over the length of the ray, for each ray (…)
    count     number of intervals
    fineness  factor on the number of points, 1 by default
    """
    edges = _interval_ends(scale, count)
    v, weights = unit_gauss(POINTS * fineness)
    lengths = np.diff(edges, axis=-1)[..., None]
    places = edges[..., :-1, None] + lengths * v
    parts = np.broadcast_to(lengths * weights, places.shape).copy()
    places[..., 0, :] = lengths[..., 0, :] * v**2
    parts[..., 0, :] = lengths[..., 0, :] * weights * 2 * v
    places[..., -1, :] = edges[..., -2, None] + lengths[..., -1, :] * (1 - (1 - v) ** 2)
    parts[..., -1, :] = lengths[..., -1, :] * weights * 2 * (1 - v)
    shape = (*scale.shape, -1)
    return places.reshape(shape), parts.reshape(shape)


def _point_force_fields(material: HalfSpace, d: Array, depth: float) -> tuple[Array, ...]:
    """Compute displacement and stress by a unit point force on a half-space, times the distance d.

    The factor d is the Jacobian of polar coordinates about the point of evaluation. The axis s
    points along the ray from this point to the force, t across. Fourteen arrays with the shape of d
    are returned: u_s, u_z, σ_ss, σ_tt, σ_zz, σ_sz by a normal force, these six fields by a force
    along s, and u_t, σ_st by a force along t.

    material  elastic constants of the half-space
    d         horizontal distance between the point and the force (any shape)
    depth     depth of the point, in the unit of d
    """
    g = 1 - 2 * material.poisson_ratio
    R = np.hypot(d, depth)
    # Sine and cosine of the angle between the distance R and the axis, and the tangent of its half.
    # At the surface (depth 0) all quadrature points have d > 0.
    s, c, h = d / R, depth / R, d / (R + depth)
    ss, cc, sc, hh = s * s, c * c, s * c, h * h
    move, unit = 1 / (4 * pi * material.shear_modulus), 1 / (2 * pi * R)
    by_p = (
        move * s * (g * h - sc),
        move * s * (1 + g + cc),
        unit * (g * h - 3 * ss * sc),
        unit * g * (sc - h),
        unit * (-3 * sc * cc),
        unit * (3 * sc * sc),
    )
    by_s = (
        move * (s + s * ss + g * (h - s * hh)),
        -move * s * (sc + g * h),
        unit * (3 * ss * ss + g * (3 * hh - ss - ss * hh - 2 * s * h * hh)),
        unit * g * (hh - ss),
        by_p[5],
        unit * (-3 * ss * sc),
    )
    return (*by_p, *by_s, move * (s + g * h), unit * g * hh)


def _integrate_each_ray(
    material: HalfSpace, t: Array, d: Array, weight: Array, depth: float, cos: Array, sin: Array
) -> Array:
    """Integrate displacement and stress below tractions along each ray (8, n, rays).

    The fields are u_s, u_t, u_z, σ_ss, σ_tt, σ_zz, σ_sz, σ_st at the n points where the rays start.
    s points along the ray and t across.

    material   elastic constants of the half-space
    t          tractions q_x, q_y, p at the quadrature points of the rays (3, n, rays, points)
    d, weight  distances of the quadrature points from the start of the ray, and weights (n, rays,
               points)
    depth      depth of the points of evaluation
    cos, sin   cosine and sine of the direction of each ray (n, rays)
    """
    pu, pw, pss, ptt, pzz, psz, su, sw, sss, stt, szz, ssz, tu, tst = _point_force_fields(
        material, d, depth
    )
    q_x, q_y, p = t * weight

    c, s = cos[..., None], sin[..., None]
    along, across = c * q_x + s * q_y, c * q_y - s * q_x
    integrands = (
        pu * p + su * along,
        tu * across,
        pw * p + sw * along,
        pss * p + sss * along,
        ptt * p + stt * along,
        pzz * p + szz * along,
        psz * p + ssz * along,
        tst * across,
    )
    return np.stack([np.sum(integrand, axis=-1) for integrand in integrands])


def _finite_part(
    material: HalfSpace, here: Array, d: Array, weight: Array, length: Array, cos: Array, sin: Array
) -> Array:
    """Compute the correction of singular stress integrals along rays at the surface (8, n, rays).

    At the surface the integrals of t/d are singular, with the traction t and the distance d from
    the point of evaluation. Their values are finite parts. For the traction at the point of
    evaluation the correction of the quadrature is ln(length of the ray) minus the quadrature of
    1/d. The fields are u_s, u_t, u_z, σ_ss, σ_tt, σ_zz, σ_sz, σ_st, with s along the ray and t
    across.

    material   elastic constants of the half-space
    here       tractions q_x, q_y, p at the points of evaluation (3, n)
    d, weight  distances of the quadrature points from the start of the ray, and weights (n, rays,
               points)
    length     lengths of the rays (n, rays)
    cos, sin   cosine and sine of the direction of each ray (n, rays)
    """
    left = np.log(length) - np.sum(weight / d, axis=-1)
    unit, g, nu = 1 / (2 * pi), 1 - 2 * material.poisson_ratio, material.poisson_ratio
    q_x, q_y, p = here[..., None]
    along, across = cos * q_x + sin * q_y, cos * q_y - sin * q_x
    nothing = np.zeros_like(left)
    return np.stack(
        [
            nothing,
            nothing,
            nothing,
            left * unit * (g * p + 2 * (1 + nu) * along),
            -left * unit * g * p,
            nothing,
            nothing,
            left * unit * g * across,
        ]
    )


def _sum_over_rays(rays: Array, cos: Array, sin: Array, weight: Array) -> Array:
    """Sum u_s, u_t, u_z, σ_ss, tt, zz, sz, st (8, n, rays), with s along and t across each ray,
    over the rays to u_x, u_y, u_z, σ_xx, yy, zz, yz, xz, xy (9, n)."""
    u_s, u_t, u_z, ss, tt, zz, sz, st = rays * weight
    c2, s2, cs = cos * cos, sin * sin, cos * sin
    each = (
        cos * u_s - sin * u_t,
        sin * u_s + cos * u_t,
        u_z,
        c2 * ss + s2 * tt - 2 * cs * st,
        s2 * ss + c2 * tt + 2 * cs * st,
        zz,
        sin * sz,
        cos * sz,
        cs * (ss - tt) + (c2 - s2) * st,
    )
    return np.stack([np.sum(part, axis=-1) for part in each])
