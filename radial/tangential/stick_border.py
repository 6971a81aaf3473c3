"""Area of the stick zone of a contact with tangential load, with its border between the points.

The distance from gross slip is d = µp - q·n, with n the direction of the shear in the slip zone. d
is zero at the border. It is proportional to the root of the distance from the border where slip
spreads (Cattaneo 1938), and to its power of 3/2 where stick spreads. The ratio of d at the last
sticking points determines the position of the border between two points: from plane contact of a
parabola with the same hats (Johnson 1985, section 4.2), and of a wave with the same harmonics
(Westergaard 1939). The border is interpolated on rings and rays, and is straight between them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Array, Mask

# Coefficients of the distance of the border from the last sticking point over the distance of
# points, as a polynomial in the ratio of d at the last two sticking points. Errors: 2e-5 for hats,
# 1.3e-3 for harmonics.
ON_HATS = (0.02807, 1.00215, 0.12215, 0.01960)
ON_HARMONICS = (-0.1913, 1.0209, 0.3219, 0.3288)
# The ratio of d at the second and third sticking point from the border distinguishes the powers: at
# most 0.54 for 3/2 and at least 0.7 for 1/2. For 3/2, the ratio of d at the last two sticking
# points is AT_NEXT if the border is at the next point.
GAINING = 0.66
AT_NEXT = 0.3
DEEP = 3  # number of sticking points required on rings, see `deep` of `_border_positions`
UNTOLD = 0.5  # position of the border between two points without sufficient data


def stick_area(radii: Array, shear: Array, bound: Array, sticks: Mask) -> float:
    """Compute the area of the stick zone of a contact with tangential load [length²].

    The border of the stick zone is interpolated between the points, which lie on n rings at J
    equidistant angles of the full circle.

    radii   radii of the rings, from the axis (n,) [length]
    shear   q_r and q_θ at the points (2, n, J) [force/length²]
    bound   friction limit µp at the points, zero outside of contact (n, J) [force/length²]
    sticks  true for sticking points (n, J)
    """
    turn = sticks.shape[1]
    angles = 2 * np.pi * np.arange(turn) / turn
    directions, size = np.arctan2(shear[1], shear[0]) + angles, np.hypot(*shear)
    along_rays = _border_positions(directions, size, bound, sticks, ON_HATS, radii, 0)
    directions, size, limit = (np.concatenate([field.T] * 3) for field in (directions, size, bound))
    whole = np.concatenate([sticks.T] * 3)
    along_rings = _border_positions(
        directions, size, limit, whole, ON_HARMONICS, np.arange(3.0 * turn), DEEP
    )
    along_rings = along_rings[turn : 2 * turn].T
    inner, outer = radii[:-1, None], radii[1:, None]
    across = along_rays * (outer - inner)
    # Positions are converted from r to r², so that they are fractions of area.
    along_rays = across * (2 * inner + across) / ((outer - inner) * (outer + inner))
    areas = np.pi / turn * (outer - inner) * (outer + inner)
    return float(np.sum(areas * _stick_fractions(sticks, along_rays, along_rings)))


def _border_positions(
    directions: Array,
    size: Array,
    bound: Array,
    sticks: Mask,
    table: tuple[float, ...],
    places: Array,
    deep: int,
) -> Array:
    """Find the border of the stick zone between adjacent points on rays or on rings (n - 1, …).

    Points are adjacent on the first axis. The position of the border is 0 at the first and 1 at the
    second of two points. The position has no meaning where both points stick or both do not. It
    follows from the distance from gross slip d = µp - q·n of the last sticking points, where q is
    the shear and n the direction of the shear in the slip zone.

    directions  angle of the shear of each point (n, …) [radian]
    size        magnitude of the shear (n, …) [force/length²]
    bound       friction limit µp (n, …) [force/length²]
    sticks      true for sticking points (n, …)
    table       coefficients of the polynomial that gives the distance of the border from the ratio
                of d at two points
    places      coordinates of the points along the first axis (n,)
    deep        number of further sticking points required to distinguish the powers 1/2 and 3/2 of
                d; in a narrow stick zone d decreases towards the opposite border
    """
    found = np.full((len(bound) - 1, *bound.shape[1:]), UNTOLD)
    slips = (bound > 0) & ~sticks
    for step in (1, -1):
        inside, beyond = (sticks[:-1], sticks[1:])[::step]
        k, j = np.nonzero(inside & ~beyond)
        at = k if step > 0 else k + 1
        direction, turn = _slip_direction(directions, slips, at, step, j)
        last, before, further, fourth = (
            _distance_from_slip(
                directions, size, bound, sticks, at - step * back, j, direction + (1 + back) * turn
            )
            for back in (0, 1, 2, deep)
        )
        even = _spacing_ratio(places, at, step)
        off = _border_distance(last, before, further, ~np.isnan(fourth), even, table)
        found[k, j] = off if step > 0 else 1 - off
    return found


def _distance_from_slip(
    directions: Array,
    size: Array,
    bound: Array,
    sticks: Mask,
    near: NDArray[np.intp],
    j: NDArray[np.intp],
    direction: Array,
) -> Array:
    """Compute d = µp - q·n [force/length²] at points (near, j) (k,), from angle and size
    of q and µp of all points (n, J), and the angle of n; NaN where points do not stick."""
    known = (near >= 0) & (near < len(bound))
    near = np.clip(near, 0, len(bound) - 1)
    d = bound[near, j] - size[near, j] * np.cos(directions[near, j] - direction)
    return np.where(known & sticks[near, j] & (d > 0), d, np.nan)


def _border_distance(
    last: Array, before: Array, further: Array, deep: Mask, even: Array, table: tuple[float, ...]
) -> Array:
    """Estimate the distance of the border from the last sticking point (k,) [1].

    Its unit is the distance to the next point. d is proportional to the power 1/2 or 3/2 of the
    distance from the border. Without data the result is 0.5.

    last, before, further  d of the last three sticking points, from the border inwards (k,)
    deep                   true where enough points stick to distinguish the powers 1/2 and 3/2 (k,)
    even                   distance to the next point over the distance to the previous point (k,)
    table                  polynomial in last/before that gives the distance for the power 1/2
    """
    # Interpolate d to equal distances of points: d² is linear in the position near a root.
    before = np.sqrt(last**2 + np.maximum(before**2 - last**2, 0.0) * even)
    with np.errstate(invalid="ignore"):
        ratio = np.minimum(last / before, 1.0)
        gains = (before < GAINING * further) & deep
    by_root = np.polynomial.polynomial.polyval(ratio, table)
    off = np.clip(np.where(gains, (ratio / AT_NEXT) ** (2 / 3), by_root), 0.0, 1.0)
    return np.where(np.isnan(off), UNTOLD, off)


def _spacing_ratio(places: Array, at: NDArray[np.intp], step: int) -> Array:
    """Return the distance to the next point over that to the previous point;
    1 without a previous point."""
    before = at - step
    known = (before >= 0) & (before < len(places))
    behind = np.where(known, places[at] - places[np.clip(before, 0, len(places) - 1)], 1.0)
    return np.where(known, np.abs((places[at + step] - places[at]) / behind), 1.0)


def _slip_direction(
    directions: Array, slips: Mask, at: NDArray[np.intp], step: int, j: NDArray[np.intp]
) -> tuple[Array, Array]:
    """Find the angle of the shear at the first slipping point, and its change per point [radian].

    If that point sticks, the angle is that of the last sticking points (at, j), and the change 0.

    directions  angle of the shear of all points (n, J) [radian]
    step        +1 or -1, the index step from the last sticking points to the border
    """
    one, two = at + step, at + 2 * step
    within = (two >= 0) & (two < len(slips))
    two = np.clip(two, 0, len(slips) - 1)
    known = slips[one, j]
    turn = (directions[one, j] - directions[two, j] + np.pi) % (2 * np.pi) - np.pi
    turn = np.where(known & within & slips[two, j], turn, 0.0)
    return np.where(known, directions[one, j], directions[at, j]), turn


def _stick_fractions(sticks: Mask, along_rays: Array, along_rings: Array) -> Array:
    """Compute the fraction of the area between adjacent rings and rays that sticks (n - 1, J) [1].

    A cell between two rings and two rays has points at its four corners. The stick zone in a cell
    is a polygon. Its corners are the sticking points and the positions of the border on the sides.

    sticks       true for sticking points on n rings and J rays (n, J)
    along_rays   position of the border between adjacent rings, 0 to 1 (n - 1, J)
    along_rings  position of the border between adjacent rays, 0 to 1 (n, J)
    """
    low, high = along_rays, np.roll(along_rays, -1, axis=1)
    left, right = along_rings[:-1], along_rings[1:]
    near, far = sticks[:-1], sticks[1:]
    sticking = np.stack([near, far, np.roll(near, -1, axis=1), np.roll(far, -1, axis=1)])
    cut = np.stack([low * left, (1 - low) * right, high * (1 - left), (1 - high) * (1 - right)]) / 2
    count = np.sum(sticking, axis=0)
    some = np.sum(np.where(sticking, cut, 0.0), axis=0)
    but_some = 1 - np.sum(np.where(sticking, 0.0, cut), axis=0)
    across, along = (left + right) / 2, (low + high) / 2
    # Two opposite corners are two separate zones.
    two = np.select(
        [
            sticking[0] & sticking[1],
            sticking[2] & sticking[3],
            sticking[0] & sticking[2],
            sticking[1] & sticking[3],
        ],
        [across, 1 - across, along, 1 - along],
        some,
    )
    return np.choose(count, [np.zeros_like(some), some, two, but_some, np.ones_like(some)])
