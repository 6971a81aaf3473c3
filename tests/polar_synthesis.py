"""Fields at depth at a point by quadrature over the plane of wave vectors.

Nothing of `semi_analytical/stress` is used: the waves along and across are turned into the axes of
the scene one direction at a time, and summed over directions by the trapezoidal rule
and over wavenumbers by Gauss's.
"""

import numpy as np

from semi_analytical.frf.depth import Descent, in_plane, material_at

GAUSS = np.polynomial.legendre.leggauss(16)
DYING = 42.0  # exp(-alpha z) is 1e-18 there


def fields_at(stack, level, point, traction_transform, reach):
    """Fields (9,) at a point (x, y) by tractions given as transforms.

    traction_transform  (m, n) -> three transforms (q_x, q_y, p), each of the shape of m or zero
    reach               greatest distance between the point and a load, for the resolution
    """
    depth = level.depth
    limit = DYING / depth
    panels = int(limit * reach / 8) + 40
    bounds = np.concatenate([[0.0], limit * 2.0 ** -np.arange(40.0, 10.0, -1)])
    bounds = np.concatenate([bounds, np.linspace(0, limit, panels)[1:]])
    bounds = np.unique(bounds)
    middle, half = (bounds[1:] + bounds[:-1]) / 2, np.diff(bounds) / 2
    alpha = (middle[:, None] + half[:, None] * GAUSS[0]).ravel()
    weight = (half[:, None] * GAUSS[1]).ravel() * alpha
    waves = [w[..., None] for w in _wave_fields(stack, level, alpha)]
    count = 2 * int(limit * reach / 2 + 40)
    total = np.zeros(9)
    for part in np.array_split(np.arange(count), max(1, count * len(alpha) // 400_000)):
        theta = 2 * np.pi * part / count
        m, n = np.outer(alpha, np.cos(theta)), np.outer(alpha, np.sin(theta))
        response = _in_scene_axes(waves, np.cos(theta), np.sin(theta))
        transforms = traction_transform(m, n)
        shift = np.exp(1j * (m * point[0] + n * point[1])) * weight[:, None]
        for field in range(9):
            waved = sum(response[field][k] * transforms[k] for k in range(3))
            total[field] += np.real(np.sum(waved * shift))
    return total / (4 * np.pi**2) * 2 * np.pi / count


def _wave_fields(stack, level, alpha):
    fields = Descent(stack, alpha).at(level)
    plane = in_plane(fields, material_at(stack, level), alpha)
    return (
        *fields.displacement.reshape(4, -1),
        *fields.traction.reshape(4, -1),
        *plane.along,
        *plane.across,
        fields.transverse_displacement,
        fields.transverse_traction,
        plane.shear,
    )


def _in_scene_axes(waves, c, s):
    """Complex responses [field][traction], by the projections of each traction on s and t."""
    U_q, U_p, W_q, W_p, s_q, s_p, n_q, n_p = waves[:8]
    along_q, along_p, across_q, across_p, u_t, t_t, shear = waves[8:]
    rows = []
    # t_s = iQ: a traction t_s along the wave vector is Q = -i t_s.
    for t_s, t_t_load, p in ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)):
        Q = -1j * t_s
        us, uz = 1j * (U_q * Q + U_p * p), W_q * Q + W_p * p
        ut = u_t * t_t_load
        sz, zz = -1j * (s_q * Q + s_p * p), -(n_q * Q + n_p * p)
        tz = -t_t * t_t_load
        ss, tt = along_q * Q + along_p * p, across_q * Q + across_p * p
        st = 1j * shear * t_t_load
        rows.append(
            [
                *(c * us - s * ut, s * us + c * ut, uz),
                c * c * ss - 2 * s * c * st + s * s * tt,
                s * s * ss + 2 * s * c * st + c * c * tt,
                zz,
                *(s * sz + c * tz, c * sz - s * tz),
                s * c * (ss - tt) + (c * c - s * s) * st,
            ]
        )
    return list(zip(*rows, strict=True))


def cell_transform(dx, dy):
    """Transform of one on a cell at the origin."""
    return lambda m, n: dx * dy * np.sinc(m * dx / 2 / np.pi) * np.sinc(n * dy / 2 / np.pi)


def hertz_transform(radius):
    """Transform of sqrt(1 - r^2/a^2)."""

    def transform(m, n):
        x = np.hypot(m, n) * radius
        exact = (np.sin(x) - x * np.cos(x)) / np.maximum(x, 0.1) ** 3
        return 2 * np.pi * radius**2 * np.where(x > 0.1, exact, 1 / 3 - x**2 / 30 + x**4 / 840)

    return transform
