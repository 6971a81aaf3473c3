"""Interpolation of the profile of an indenter of revolution: heights over the radius.

Between two radii the height is a cubic with the limited slopes of a height map (`limited_slope`).
The profile is even: its mirror image beyond the axis continues it, so that it is flat on the axis.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from contact_scene.height_map import interpolate_cubic, limited_slope, nearer_to_zero

Values = NDArray[np.float64]

# Difference of heights over their range that is round-off.
_ROUND_OFF = 1e-14
# Bisections of the logarithm of a contact radius, to 1e-9 of the largest one.
_BISECTIONS = 64
# Quadrature points over the angle, for estimates of the contact radius or half width.
_ANGLES = 64
# Limits of the contact radius in estimates, over the radius of the last point.
_SMALLEST = 1e-12
_LARGEST = 1e6


@dataclass(frozen=True)
class Profile:
    """Profile of an indenter of revolution through measured points, from its lowest height upwards.

    radii    radii of the points, ascending, not negative (n,) [length]
    heights  heights of the points, positive away from the body (n,) [length]
    """

    radii: Values
    heights: Values

    @cached_property
    def _points(self) -> tuple[Values, Values, Values]:
        """Radii of the points and their mirror images, heights above the first point, slopes."""
        mirrored = np.flatnonzero(self.radii)[::-1]
        r = np.concatenate([-self.radii[mirrored], self.radii])
        z = np.concatenate([self.heights[mirrored], self.heights]) - self.heights[0]
        return r, z, limited_slopes(r, z)

    @cached_property
    def _lowest(self) -> tuple[float, float]:
        """Lowest height above the first point [length], and its radius, 0 on the axis [length]."""
        turning = self._turning_places()
        r = np.concatenate([[0.0], self.radii, turning[turning > 0]])
        heights = self._height_above_first(r)
        at = int(np.argmin(heights))
        on_axis = heights[0] - heights[at] <= _ROUND_OFF * np.ptp(self.heights)
        return float(heights[at]), 0.0 if on_axis else float(r[at])

    def _turning_places(self) -> Values:
        """Find the places at which the slope of the profile is zero between two points [length]."""
        r, z, slopes = self._points
        step = np.diff(r)
        mean, start, end = np.diff(z) / step, slopes[:-1], slopes[1:]
        # The slope is a t^2 + b t + start at the fraction t of an interval.
        a, b = 3.0 * (start + end) - 6.0 * mean, 6.0 * mean - 4.0 * start - 2.0 * end
        with np.errstate(all="ignore"):  # no root, or constant height
            q = -0.5 * (b + np.copysign(np.sqrt(b * b - 4.0 * a * start), b))
            found = (r[:-1] + step * np.array([q / a, start / q])).ravel()
            inside = np.array([q / a, start / q]).ravel()
        return np.asarray(found[(inside >= 0) & (inside <= 1)])

    def _interval(self, radius: Values) -> tuple[Any, Values, Values]:
        """Return indices of intervals, their widths [length], and the fractions at given radii."""
        r = self._points[0]
        k = np.clip(np.searchsorted(r, radius, side="right") - 1, 0, len(r) - 2)
        step = np.diff(r)[k]
        return k, step, (radius - r[k]) / step

    def _height_above_first(self, radius: Values) -> Values:
        """Interpolate the height above the first point, up to the last point [length]."""
        _, z, slopes = self._points
        k, step, t = self._interval(radius)
        start, end = step * slopes[k], step * slopes[k + 1]
        return interpolate_cubic(z[k], z[k + 1] - z[k], start, end, t)

    @property
    def lowest_radius(self) -> float:
        """Radius of first contact, where the profile is lowest; 0 on the axis [length]."""
        return self._lowest[1]

    def height(self, radius: ArrayLike) -> Values:
        """Compute the height above the lowest height; beyond the last point along a line [length].

        radius  distance from the axis, not negative [length]
        """
        r, end = np.asarray(radius, dtype=float), self.radii[-1]
        known = self._height_above_first(np.minimum(r, end)) - self._lowest[0]
        return np.asarray(known + np.maximum(r - end, 0.0) * self._points[2][-1])

    def slope(self, radius: ArrayLike) -> Values:
        """Compute the slope of the profile; beyond the last point that of the line [1].

        radius  distance from the axis, not negative [length]
        """
        _, z, slopes = self._points
        k, step, t = self._interval(np.minimum(np.asarray(radius, dtype=float), self.radii[-1]))
        back, mean = 1.0 - t, (z[k + 1] - z[k]) / step
        by_ends = back * (1.0 - 3.0 * t) * slopes[k] - t * (2.0 - 3.0 * t) * slopes[k + 1]
        return np.asarray(6.0 * t * back * mean + by_ends)

    def radius_at(self, approach: float) -> float:
        """Estimate the contact radius a on half-spaces at an approach δ [length].

        δ = a ∫₀^(π/2) f'(a sin φ) dφ with the slope f' (Sneddon 1965).

        approach  δ [length]
        """
        return self._contact_radius(lambda a, sine: a * self.slope(a * sine), approach)

    def radius_under(self, force: float, modulus: float) -> float:
        """Estimate the contact radius a on half-spaces under a normal force W [length].

        W = 2 E* a² ∫₀^(π/2) sin² φ f'(a sin φ) dφ with the slope f' (Sneddon 1965).

        force    W [force]
        modulus  contact modulus E* [force/length^2]
        """
        return self._contact_radius(
            lambda a, sine: 2.0 * modulus * a**2 * sine**2 * self.slope(a * sine), force
        )

    def _contact_radius(self, integrand: Callable[[float, Values], Values], load: float) -> float:
        """Find the contact radius at which an integral over 0 < φ < π/2 reaches a load [length].

        integrand  function of the contact radius and of sin φ
        load       approach [length] or normal force [force]
        """
        sine, weights = sine_rule()
        low, high = (share * float(self.radii[-1]) for share in (_SMALLEST, _LARGEST))
        for _ in range(_BISECTIONS):
            middle = float(np.sqrt(low * high))
            short = weights @ integrand(middle, sine) < load
            low, high = (middle, high) if short else (low, middle)
        return high


@lru_cache(maxsize=1)
def sine_rule() -> tuple[Values, Values]:
    """Compute sin φ at Gauss points of 0 < φ < π/2, and the weights of the points, each (64,)."""
    points, weights = np.polynomial.legendre.leggauss(_ANGLES)
    return np.sin(np.pi / 4 * (1 + points)), np.pi / 4 * weights


@dataclass(frozen=True)
class PlaneProfile(Profile):
    """Profile of a cylindrical body through measured points, for line contacts.

    radii    coordinates x of the points, ascending through 0 (n,) [length]
    heights  heights of the points, positive away from the body (n,) [length]
    """

    @cached_property
    def _points(self) -> tuple[Values, Values, Values]:
        """Coordinates of the points, heights above the lowest point, slopes."""
        z = self.heights - np.min(self.heights)
        return self.radii, z, limited_slopes(self.radii, z)

    @cached_property
    def _lowest(self) -> tuple[float, float]:
        """Lowest height above the lowest point [length], and its coordinate [length]."""
        x = np.concatenate([self.radii, self._turning_places()])
        heights = self._height_above_first(x)
        at = int(np.argmin(heights))
        return float(heights[at]), float(x[at])

    def height(self, radius: ArrayLike) -> Values:
        """Compute the height above the lowest height; beyond the points along lines [length].

        radius  coordinate x [length]
        """
        at, (x, _, slopes) = np.asarray(radius, dtype=float), self._points
        within = np.clip(at, x[0], x[-1])
        known = self._height_above_first(within) - self._lowest[0]
        return np.asarray(known + (at - within) * np.where(at < x[0], slopes[0], slopes[-1]))


def limited_slopes(x: Values, z: Values) -> Values:
    """Compute the slopes of a shape-preserving cubic interpolation at its points (n,).

    x  coordinates, ascending (n,)
    z  values (n,)
    """
    step = np.diff(x)
    rise = np.diff(z) / step
    bend = np.pad(np.diff(rise) / (step[:-1] + step[1:]), 1, mode="edge")
    turn = nearer_to_zero(bend[:-1], bend[1:]) * step
    # Slopes of the parabolas of the intervals before and after each point. Beyond the ends, the
    # last parabola continues.
    before, after = rise + turn, rise - turn
    inner = (rise[:-1] * step[1:] + rise[1:] * step[:-1]) / (step[:-1] + step[1:])
    central = np.concatenate([after[:1], inner, before[-1:]])
    at_ends = [np.concatenate([rise[:1], rise]), np.concatenate([rise, rise[-1:]])]
    parabolas = [np.concatenate([after[:1], before]), np.concatenate([after, before[-1:]])]
    return limited_slope(central, *at_ends, *parabolas)
