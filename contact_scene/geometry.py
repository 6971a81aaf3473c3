"""Indenter shapes, with the undeformed gap between the indenter and the plane of contact."""

import math
from abc import abstractmethod
from collections.abc import Callable
from difflib import get_close_matches
from functools import lru_cache
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Discriminator, StrictBool, Tag, model_validator

from contact_scene.body import Body
from contact_scene.height_map import (
    HeightUnit,
    PairOfSpacings,
    fill_missing_heights,
    interpolate,
    leave_out_every_second,
    lowest_point,
)
from contact_scene.profile import PlaneProfile, Profile, sine_rule
from contact_scene.reading.array_file import (
    ArrayFile,
    FileKey,
    TableKey,
    refuse_missing,
)
from contact_scene.reading.quantity import (
    PositiveLength,
    PressingLength,
    SlopeAngle,
)
from contact_scene.reading.scene_error import refusal

Gap = NDArray[np.float64]
Pair = tuple[float, float]

# Least number of points of a profile: two intervals between which its curvature changes.
_LEAST_POINTS = 4
# Asymmetry of a table that is round-off of its units, over the range of its numbers.
_ROUND_OFF = 1e-12

# Largest fraction of points of a height map without a height. The corners around a circular field
# of view are 1 - π/4 = 0.21 of a square, and more on few points.
_MAX_UNMEASURED = 1 / 3


# Relative half distance of the points between which a slope is taken.
_NEAR = 1e-4
# Half widths between which the contact of a line contact is searched [length], and bisections of
# their logarithm, to round-off.
_HALF_WIDTHS = 1e-15, 1e9
_BISECTIONS = 60


class ShapedBody(Body):
    """Body with a shape, in first contact with the plane z = 0 (at the origin if it has a tip).

    A shape must define `initial_gap`. All other properties are optional; solvers rely on those
    that are defined and assume none of the others. A subclass that redefines the gap of another
    shape therefore does not inherit the properties of that shape.
    """

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: Any) -> None:
        super().__pydantic_init_subclass__(**kwargs)
        others = [base for base in cls.__mro__[1:] if "initial_gap" in vars(base)]
        if "initial_gap" in vars(cls) and others != [ShapedBody]:
            for name in _SHAPE_PROPERTIES.difference(vars(cls)):
                setattr(cls, name, vars(ShapedBody)[name])

    @abstractmethod
    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the gap between the undeformed indenter and the plane at first contact.

        Parameters
        ----------
        x, y : array_like
            Coordinates in the plane of contact [length], broadcast together.

        Returns
        -------
        ndarray, shape of x + y
            Distance of the indenter from the plane [length]; infinite where there is no indenter.
        """

    @property
    def is_of_revolution(self) -> bool:
        """True if the gap of the indenter depends on the distance from the origin only."""
        return False

    @property
    def is_line(self) -> bool:
        """True if the gap depends on x only: a line contact in plane strain, loaded per length."""
        return False

    @property
    def is_even(self) -> bool:
        """True if the gap of the indenter is equal at (x, y), (-x, y) and (x, -y)."""
        return self.is_of_revolution

    @property
    def rim(self) -> float | None:
        """Radius of an edge of the indenter that bounds the contact at every load [length].

        An example is the edge of a flat punch. The value is None without such an edge.
        """
        return None

    @property
    def lowest_radius(self) -> float:
        """Radius of first contact of an indenter of revolution, 0 on the axis [length]."""
        return 0.0

    @property
    def known_radius(self) -> float:
        """Largest distance from the axis at which the shape is known [length].

        A contact beyond it is refused. The value is infinite for shapes given by formulas.
        """
        return math.inf

    @property
    def breaks(self) -> Gap:
        """Radii at which a derivative of the gap of an indenter of revolution jumps (n,) [length].

        Between these radii the gap is smooth, and it is even at the axis. Without breaks the gap is
        smooth up to a tip or a rim.
        """
        return np.empty(0)

    @property
    def extent(self) -> Pair | None:
        """Side lengths along x and y of the region where the indenter's gap is defined [length].

        The region is a rectangle about the origin. The value is None if the gap is defined
        everywhere.
        """
        return None

    @property
    def gap_exponent(self) -> float | None:
        """Exponent k of the gap as a power of the distance from the point of first contact.

        The gap is that of the undeformed indenter; k = 2 for a paraboloid. Under a growing load the
        approach is proportional to a^k and the normal force to a^(k+1), with the contact radius a.
        The value is None if the contact does not grow or follows no such law.
        """
        return None

    @property
    def load_exponent(self) -> float | None:
        """Exponent of the normal force as a power of the contact radius; None without a law."""
        k = self.gap_exponent
        return k if k is None or self.is_line else k + 1

    def with_half_the_points(self) -> "ShapedBody | None":
        """Return the shape with every second of its measured points left out.

        Used for an error estimate. The value is None for a shape that is not given by points.
        """
        return None

    # Estimates to an order of magnitude, for grids and meshes. Callers take the root of the degree
    # `gap_exponent` or `load_exponent`.

    def contact_at(self, approach: float) -> Pair | None:
        """Estimate the size of the contact at a given approach of the indenter.

        The estimate is correct to an order of magnitude and serves to choose a grid or mesh.

        approach  approach of the bodies [length]
        returns   a^k along x and along y [length^k], with the half width a of the contact and the
                  exponent k of the gap as a power of the distance; None without an estimate
        """
        return None

    def contact_under(self, force: float, modulus: float) -> Pair | None:
        """Estimate the size of the contact of half-spaces under a given normal force.

        The estimate is correct to an order of magnitude and serves to choose a grid or mesh.

        force    normal force [force]
        modulus  contact modulus E* [force/length^2]
        returns  a^n along x and along y [length^n], with the half width a of the contact and the
                 `load_exponent` n; None without an estimate
        """
        return None


_SHAPE_PROPERTIES = {
    "gap_exponent",
    "is_of_revolution",
    "is_even",
    "rim",
    "lowest_radius",
    "known_radius",
    "breaks",
    "extent",
    "contact_at",
    "contact_under",
    "with_half_the_points",
}


class SmoothTip(ShapedBody):
    """Shape with two radii of curvature at the point of first contact (Johnson 1985, sec. 4.2)."""

    @property
    def gap_exponent(self) -> float:
        """Exponent of the gap of the indenter as a power of the distance from the tip: 2.

        The tip is a parabola to second order.
        """
        return 2

    @property
    @abstractmethod
    def tip_radii(self) -> Pair:
        """Radii of curvature of the indenter along x and y at its tip [length]."""

    def contact_at(self, approach: float) -> Pair:
        """Estimate the square of the half width a of the contact along x and y at an approach.

        The estimate is a^2 = R delta, with the radius of curvature R of the tip along the axis and
        the approach delta. It is exact for a paraboloid of revolution on half-spaces (Johnson 1985,
        Eq. 4.23). For unequal radii, a^2 is up to twice the estimate along the axis with the larger
        radius, and less than the estimate along the other axis. The results [length^2] are for x
        and for y.

        approach  delta, approach of the bodies [length]
        """
        R_x, R_y = self.tip_radii
        return R_x * approach, R_y * approach

    def contact_under(self, force: float, modulus: float) -> Pair:
        """Estimate the cube of the half width a of the contact along x and y under a normal force.

        The estimate is a^3 = 3 W R / 4 E* by Hertz theory (Johnson 1985, Eq. 4.22), with the larger
        radius of curvature R of the tip. The results [length^3] for x and y are equal.

        force    W, normal force [force]
        modulus  E*, contact modulus [force/length^2]
        """
        power = 3.0 * force * max(self.tip_radii) / (4.0 * modulus)
        return power, power


class RoundTip(SmoothTip):
    """Shape of revolution with one radius of curvature at the tip."""

    shape: Literal["sphere", "paraboloid"]
    radius: PositiveLength
    """Radius of curvature R at the tip [length]."""

    @property
    def is_of_revolution(self) -> bool:
        """True: the gap of the indenter depends on the distance from the origin only."""
        return True

    @property
    def tip_radii(self) -> Pair:
        """Radius of curvature R at the tip, equal along x and y [length]."""
        return self.radius, self.radius


class Sphere(RoundTip):
    """Sphere with the exact arc: gap r^2 / (R + sqrt(R^2 - r^2)) up to the equator."""

    shape: Literal["sphere"] = "sphere"

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap of the sphere: the height of its arc above the plane [length].

        Beyond the equator, the gap is the radius R.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        R = self.radius
        r = np.minimum(np.hypot(x, y), R)
        return np.asarray(r * (r / (R + np.sqrt((R - r) * (R + r)))))


class Paraboloid(RoundTip):
    """Paraboloid of revolution with the gap r^2 / 2R, the shape of Hertz theory."""

    shape: Literal["paraboloid"] = "paraboloid"

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap (x^2 + y^2) / 2R of the paraboloid at first contact [length].

        R is the radius of curvature at the tip.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        return np.asarray((np.square(x) + np.square(y)) / (2.0 * self.radius))


class Ellipsoid(SmoothTip):
    """Elliptical paraboloid with the gap x^2 / 2Rx + y^2 / 2Ry: a smooth tip to second order."""

    shape: Literal["ellipsoid"] = "ellipsoid"
    radii: tuple[PositiveLength, PositiveLength]
    """Principal radii of curvature (Rx, Ry) at the tip [length]."""

    @property
    def is_of_revolution(self) -> bool:
        """True if the radii of curvature of the indenter along x and y are equal."""
        return self.radii[0] == self.radii[1]

    @property
    def is_even(self) -> bool:
        """True: the gap of the indenter is equal at (x, y), (-x, y) and (x, -y)."""
        return True

    @property
    def tip_radii(self) -> Pair:
        """Radii of curvature Rx and Ry along x and y at the tip [length]."""
        return self.radii

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap x^2 / 2Rx + y^2 / 2Ry of the indenter [length].

        Rx and Ry are the radii of curvature along x and y at the tip.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        Rx, Ry = self.radii
        return np.asarray(np.square(x) / (2.0 * Rx) + np.square(y) / (2.0 * Ry))


class Cone(ShapedBody):
    """Cone with the gap r tan(slope)."""

    shape: Literal["cone"] = "cone"
    slope_angle: SlopeAngle
    """Angle between the flank and the contact plane."""

    @property
    def gap_exponent(self) -> float:
        """Exponent of the gap of the cone as a power of the distance from the tip: 1.

        The flank of the cone is straight.
        """
        return 1

    @property
    def is_of_revolution(self) -> bool:
        """True: the gap of the cone depends on the distance from the origin only."""
        return True

    def contact_at(self, approach: float) -> Pair:
        """Estimate the contact radius a of the cone at an approach: a = 2 delta / pi tan(slope).

        slope is the angle between the flank and the plane of contact (Johnson 1985, section 5.2).
        The results [length] for x and y are equal.

        approach  delta, approach of the bodies [length]
        """
        reach = 2.0 * approach / (np.pi * self._slope)
        return reach, reach

    def contact_under(self, force: float, modulus: float) -> Pair:
        """Estimate the square of the contact radius a of the cone under a normal force.

        The square is a^2 = 2 W / pi E* tan(slope), with the angle slope between the flank and the
        plane of contact. The results [length^2] for x and y are equal.

        force    W, normal force [force]
        modulus  E*, contact modulus [force/length^2]
        """
        power = 2.0 * force / (np.pi * modulus * self._slope)
        return power, power

    @property
    def _slope(self) -> float:
        return math.tan(self.slope_angle)

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap r tan(slope) of the cone at first contact [length].

        r is the distance from the tip, and slope the angle between flank and plane.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        return np.asarray(np.hypot(x, y) * np.tan(self.slope_angle))


class FlatPunch(ShapedBody):
    """Circular cylinder with a flat end face."""

    shape: Literal["flat_punch"] = "flat_punch"
    radius: PositiveLength
    """Radius of the end face [length]."""

    @property
    def is_of_revolution(self) -> bool:
        """True: the gap of the punch depends on the distance from the origin only."""
        return True

    @property
    def rim(self) -> float:
        """Radius of the edge of the end face, which bounds the contact [length]."""
        return self.radius

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Return the undeformed gap of the punch at first contact [length].

        The gap is 0 at the end face and its edge, and infinite outside.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        return np.where(np.hypot(x, y) <= self.radius, 0.0, np.inf)


class HeightMap(ShapedBody):
    """Measured or computed surface: heights above the plane on a grid centred on the origin."""

    shape: Literal["height_map"] = "height_map"
    file: FileKey
    """Name of a `.npy` file with heights, index [i, j] = (x_i, y_j), or of a `.csv` or `.txt` file
    in the orientation of a top view, with x to the right and y upwards. First contact is at the
    lowest point of the interpolated surface. NaN, and empty fields of a text file, are points
    without a measurement."""

    spacing: PairOfSpacings
    """Distance between adjacent heights along x and y [length]; one number applies to both."""

    height_unit: HeightUnit = 1.0
    """Unit of the heights, such as "um"; absent: metres."""

    flip: StrictBool = False
    """True if heights are positive towards the body, as in a measurement of the indenter's
    surface; absent: positive away from the body."""

    @property
    def gap_exponent(self) -> float:
        """Exponent of the gap as a power of the distance from first contact: 2.

        The value is that of a paraboloid and applies to the first asperities in contact.
        """
        return 2

    @property
    def is_even(self) -> bool:
        """True if the heights of the map are symmetric about the planes x = 0 and y = 0.

        The heights must be equal bit for bit. Solvers may then compute one part of the window only.
        """
        return all(np.array_equal(self.heights, np.flip(self.heights, axis)) for axis in (0, 1))

    @property
    def extent(self) -> Pair:
        """Side lengths along x and y of the area covered by the height map [length]."""
        (nx, ny), (dx, dy) = self.file.shape, self.spacing
        return nx * dx, ny * dy

    @model_validator(mode="after")
    def _is_measured(self) -> "HeightMap":
        if self.unmeasured_fraction > _MAX_UNMEASURED:
            missing = f"{self.unmeasured_fraction:.0%}"
            raise refusal(
                f"the map {self.file} has no height at {missing} of its points",
                f"at most {_MAX_UNMEASURED:.0%}",
                "cut the map to its measured area",
            )
        return self

    @property
    def unmeasured_fraction(self) -> float:
        """Fraction of the points of the height map without a measured height."""
        return float(np.mean(np.isnan(self.file.values)))

    @property
    def heights(self) -> Gap:
        """Heights of the height map, positive away from the body (nx, ny) [length].

        Points without a measurement have interpolated values.
        """
        return _interpolated_surface(self.file, self.height_unit, self.flip)[0]

    @property
    def lowest_on_rim(self) -> bool:
        """True if first contact is on an outermost row or column of points of the height map."""
        *_, place = _interpolated_surface(self.file, self.height_unit, self.flip)
        return any(at in (0.0, n - 1.0) for at, n in zip(place, self.file.shape, strict=True))

    def with_half_the_points(self) -> "HeightMap":
        """Return the map with every second row and column replaced by interpolated heights.

        Used to estimate the error of the surface between the points.
        """
        heights = leave_out_every_second(self.heights, self.spacing)
        changed = {"file": heights, "height_unit": 1.0, "flip": False}
        return type(self).model_validate({**dict(self), **changed})

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap of the height map: its height above its lowest point [length].

        The height is interpolated at the points (x, y). The lowest point is the minimum of the
        interpolated surface between the outermost points of the map. Raises ValueError if a point
        lies outside the map.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        heights, lowest, dip, _ = _interpolated_surface(self.file, self.height_unit, self.flip)
        return np.asarray(interpolate(heights - lowest, self.spacing, x, y) - dip)


@lru_cache(maxsize=2)
def _interpolated_surface(
    file: ArrayFile, unit: float, flip: bool
) -> tuple[Gap, float, float, Pair]:
    """Compute heights without NaN (nx, ny), the lowest one, and the minimum of their
    interpolated surface (first contact) minus the lowest [length], with its position in indices."""
    factor = -unit if flip else unit
    heights = file.values if factor == 1.0 else factor * file.values
    heights = fill_missing_heights(heights)
    return heights, float(np.min(heights)), *lowest_point(heights)


def _refuse_other_tables(file: ArrayFile, columns: str) -> None:
    """Raise a validation error for a table without two columns of enough finite numbers."""
    refuse_missing(file)
    shape = file.values.shape
    if 2 not in shape or max(shape) < _LEAST_POINTS:
        raise refusal(
            f"the table {file} holds {' x '.join(map(str, shape))} numbers",
            f"two columns, {columns}, of at least {_LEAST_POINTS} values",
        )


def _order_text(x: Gap) -> str:
    """Name the first coordinate of a profile that does not ascend, else its range [length]."""
    late = np.flatnonzero(np.diff(x) <= 0)
    if len(late):
        return f"has {x[late[0] + 1]:g} m after {x[late[0]]:g} m"
    return f"runs from {x[0]:g} m to {x[-1]:g} m"


class RevolvedProfile(ShapedBody):
    """Body of revolution with a measured or computed profile: a table of radii and heights."""

    shape: Literal["revolved_profile"] = "revolved_profile"
    file: TableKey
    """Name of a `.csv`, `.txt` or `.npy` file with two columns: distances from the axis, from
    the axis outwards, and heights. The profile is even at the axis. Between the points it is a
    cubic that does not dip below flats."""

    radius_unit: HeightUnit = 1.0
    """Unit of the radii, such as "um"; absent: metres."""

    height_unit: HeightUnit = 1.0
    """Unit of the heights, such as "um"; absent: metres."""

    flip: StrictBool = False
    """True if heights are positive towards the body, as in a measurement of the indenter's
    surface; absent: positive away from the body."""

    @property
    def gap_exponent(self) -> float:
        """Exponent of the gap as a power of the distance from first contact: 2.

        The value is that of a paraboloid and applies near the axis.
        """
        return 2

    @property
    def is_of_revolution(self) -> bool:
        """True: the gap of the indenter depends on the distance from the origin only."""
        return True

    @property
    def lowest_radius(self) -> float:
        """Radius at which the profile is lowest, 0 on the axis [length]."""
        return self.profile.lowest_radius

    @property
    def known_radius(self) -> float:
        """Radius of the last point of the profile [length]."""
        return float(self.profile.radii[-1])

    @property
    def breaks(self) -> Gap:
        """Radii of the points of the profile, between which it is a cubic (n,) [length]."""
        return self.profile.radii

    @property
    def profile(self) -> Profile:
        """Profile of the indenter: radii and heights of its points, and their interpolation."""
        return _interpolated_profile(self.file, self.radius_unit, self.height_unit, self.flip)

    @model_validator(mode="after")
    def _is_profile(self) -> "RevolvedProfile":
        _refuse_other_tables(self.file, "radius and height")
        radii, heights = self.profile.radii, self.profile.heights
        if radii[0] < 0 or np.any(np.diff(radii) <= 0):
            raise refusal(
                f"the first column of {self.file} {_order_text(radii)}",
                "distances from the axis in ascending order, not negative",
                "keep one half of a profile that was measured across the axis",
            )
        if heights[-1] <= heights[0]:
            raise refusal(
                f"the profile of {self.file} is not higher at its last point than at its first",
                "heights that are positive away from the body",
                f"set flip = {'false' if self.flip else 'true'} for a profile that is reversed",
            )
        return self

    def with_half_the_points(self) -> "RevolvedProfile":
        """Return the profile with every second point replaced by an interpolated one.

        The last point is kept. Used to estimate the error of the profile between the points.
        """
        radii, heights = self.profile.radii, self.profile.heights
        kept = np.union1d(np.arange(0, len(radii), 2), len(radii) - 1)
        table = np.stack([radii, Profile(radii[kept], heights[kept]).height(radii)])
        changed = {"file": table, "radius_unit": 1.0, "height_unit": 1.0, "flip": False}
        return type(self).model_validate({**dict(self), **changed})

    def contact_at(self, approach: float) -> Pair:
        """Estimate the square of the contact radius at an approach, for x and y [length^2].

        The estimate is exact for half-spaces if the contact is a disc.

        approach  approach of the bodies [length]
        """
        return (self.profile.radius_at(approach) ** 2,) * 2

    def contact_under(self, force: float, modulus: float) -> Pair:
        """Estimate the cube of the contact radius under a normal force, for x and y [length^3].

        The estimate is exact for half-spaces if the contact is a disc.

        force    normal force [force]
        modulus  contact modulus E* [force/length^2]
        """
        return (self.profile.radius_under(force, modulus) ** 3,) * 2

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap of the profile: its height above its lowest point [length].

        Beyond the last point the profile continues along a line.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        return self.profile.height(np.hypot(x, y))


@lru_cache(maxsize=4)
def _interpolated_profile(
    file: ArrayFile, radius_unit: float, height_unit: float, flip: bool
) -> Profile:
    """Create a profile from a table of radii and heights along either index, in either order.
    `flip` means heights positive towards the body."""
    radii, heights = file.values if file.shape[0] == 2 else file.values.T
    order = slice(None, None, -1 if radii[0] > radii[-1] else 1)
    sign = -1.0 if flip else 1.0
    return Profile(radius_unit * radii[order], sign * height_unit * heights[order])


class LineShape(ShapedBody):
    """Cylindrical body along y, whose gap depends on x only. Its loads are per unit length.

    Far from a line load the displacement grows like the logarithm of the distance. Approach, shift
    and elastic energy therefore depend on a distance at which the surface does not move.
    """

    reference_length: PositiveLength | None = None
    """Distance from the centre of the contact, on both sides, at which the surface does not move
    [length]; absent: approach, tangential shift, elastic energy and work are not stated."""

    @property
    def is_line(self) -> bool:
        """True: the gap depends on x only."""
        return True

    @property
    def is_even(self) -> bool:
        """True: the gap is equal at x and -x."""
        return True

    def _force_ratio(self, a: float) -> float:
        """Compute W/E* = a ∫₀^(π/2) sin φ f'(a sin φ) dφ of half-spaces [length]
        (Johnson 1985, section 2.7), for a shape f that is symmetric about x = 0."""
        sine, weights = sine_rule()
        t = a * sine
        rise = self.initial_gap(t * (1.0 + _NEAR), 0.0) - self.initial_gap(t * (1.0 - _NEAR), 0.0)
        return float(a * weights @ (sine * rise / (2.0 * _NEAR * t)))

    def _half_width(self, load: Callable[[float], float], value: float) -> float:
        """Find the half width at which an increasing load has a value, by bisection [length]."""
        low, high = _HALF_WIDTHS
        for _ in range(_BISECTIONS):
            middle = math.sqrt(low * high)
            low, high = (middle, high) if load(middle) < value else (low, middle)
        return high

    def contact_under(self, force: float, modulus: float) -> Pair | None:
        """Compute a^n under a normal force per length, with the half width a, for x and y.

        n is the `load_exponent`. The value is None for a shape whose edges bound the contact.

        force    normal force per length [force/length]
        modulus  contact modulus E* [force/length^2]
        """
        if self.load_exponent is None:
            return None
        return (self._half_width(self._force_ratio, force / modulus) ** self.load_exponent,) * 2

    def contact_at(self, approach: float) -> Pair | None:
        """Estimate a^k at an approach, with the half width a and the `gap_exponent` k, for x and y.

        The approach is that of a parabolic cylinder, W (1 + 2 ln(2L/a)) / πE* (Johnson 1985, eq.
        5.57 gives it for another reference), with the reference length L. The value is None for a
        shape whose edges bound the contact.

        approach  approach of the bodies [length]
        """
        if self.gap_exponent is None:
            return None
        far = self.reference_length or 1.0

        def moved(a: float) -> float:
            return self._force_ratio(a) * (1.0 + 2.0 * math.log(max(2.0 * far / a, 1.0))) / math.pi

        return (self._half_width(moved, approach) ** self.gap_exponent,) * 2


class Cylinder(LineShape):
    """Parabolic cylinder with the gap x^2 / 2R, the shape of Hertz theory for line contacts."""

    shape: Literal["cylinder"] = "cylinder"
    radius: PositiveLength
    """Radius of curvature R at the apex [length]."""

    @property
    def gap_exponent(self) -> float:
        """Exponent of the gap as a power of the distance from the apex: 2."""
        return 2

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap x^2 / 2R at first contact [length].

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        return np.asarray((np.square(x) + np.zeros_like(y)) / (2.0 * self.radius))


class Strip(LineShape):
    """Flat punch of infinite length along y, with sharp or rounded edges."""

    shape: Literal["strip"] = "strip"
    half_width: PositiveLength
    """Half width of the flat part [length]."""

    edge_radius: PressingLength = 0.0
    """Radius of curvature of the edges beside the flat part [length]; 0: sharp edges, which bound
    the contact."""

    @property
    def gap_exponent(self) -> float | None:
        """Exponent of the gap beside the flat part as a power of the distance: 2, or None."""
        return 2 if self.edge_radius else None

    @property
    def rim(self) -> float | None:
        """Half width of the contact if the edges are sharp [length]."""
        return None if self.edge_radius else self.half_width

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap: 0 at the flat part, beside it parabolic or infinite [length].

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        beside = np.maximum(np.abs(x) - self.half_width, 0.0) + np.zeros_like(y)
        if self.edge_radius:
            return np.asarray(np.square(beside) / (2.0 * self.edge_radius))
        return np.where(beside > 0.0, np.inf, 0.0)


class Wedge(LineShape):
    """Wedge with its edge along y, whose gap is proportional to the distance from the edge."""

    shape: Literal["wedge"] = "wedge"
    slope_angle: SlopeAngle
    """Angle between the flanks and the contact plane."""

    @property
    def gap_exponent(self) -> float:
        """Exponent of the gap as a power of the distance from the edge: 1."""
        return 1

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap |x| tan(slope) at first contact [length].

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        return np.asarray((np.abs(x) + np.zeros_like(y)) * np.tan(self.slope_angle))


class LineProfile(LineShape):
    """Cylindrical body with a measured or computed profile: a table of x and heights."""

    shape: Literal["line_profile"] = "line_profile"
    file: TableKey
    """Name of a `.csv`, `.txt` or `.npy` file with two columns, x on both sides of 0 and
    heights. Between the points the profile is a cubic that does not dip below flats."""

    x_unit: HeightUnit = 1.0
    """Unit of x, such as "um"; absent: metres."""

    height_unit: HeightUnit = 1.0
    """Unit of the heights, such as "um"; absent: metres."""

    flip: StrictBool = False
    """True if heights are positive towards the body; absent: positive away from the body."""

    @property
    def is_even(self) -> bool:
        """True if the table is symmetric about x = 0, except for round-off."""
        x, z = self.profile.radii, self.profile.heights
        apart = np.max(np.abs(x + x[::-1])), np.max(np.abs(z - z[::-1]))
        return bool(apart[0] <= _ROUND_OFF * np.ptp(x) and apart[1] <= _ROUND_OFF * np.ptp(z))

    @property
    def gap_exponent(self) -> float:
        """Exponent of the gap as a power of the distance from first contact: 2."""
        return 2

    @property
    def known_radius(self) -> float:
        """Distance from x = 0 to the nearer end of the profile [length]."""
        x = self.profile.radii
        return float(min(-x[0], x[-1]))

    @property
    def profile(self) -> PlaneProfile:
        """Profile of the body: coordinates and heights of its points, and their interpolation."""
        return _interpolated_plane_profile(self.file, self.x_unit, self.height_unit, self.flip)

    @model_validator(mode="after")
    def _is_profile(self) -> "LineProfile":
        _refuse_other_tables(self.file, "x and height")
        x = self.profile.radii
        if x[0] >= 0 or x[-1] <= 0 or np.any(np.diff(x) <= 0):
            raise refusal(
                f"the first column of {self.file} {_order_text(x)}",
                "ascending x on both sides of 0",
            )
        return self

    def with_half_the_points(self) -> "LineProfile":
        """Return the profile with every second point replaced by an interpolated one.

        The ends are kept. Used to estimate the error of the profile between the points.
        """
        x, z = self.profile.radii, self.profile.heights
        half = np.arange(0, len(x) // 2 + 1, 2)
        kept = np.union1d(half, len(x) - 1 - half)  # a symmetric table stays symmetric
        table = np.stack([x, PlaneProfile(x[kept], z[kept]).height(x)])
        changed = {"file": table, "x_unit": 1.0, "height_unit": 1.0, "flip": False}
        return type(self).model_validate({**dict(self), **changed})

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Compute the undeformed gap: the height above the lowest point of the profile [length].

        Beyond the last points the profile continues along lines.

        x, y  coordinates in the plane of contact [length], broadcast together
        """
        return np.asarray(self.profile.height(x) + np.zeros_like(y))


@lru_cache(maxsize=4)
def _interpolated_plane_profile(
    file: ArrayFile, x_unit: float, height_unit: float, flip: bool
) -> PlaneProfile:
    """Create a profile from a table of coordinates and heights along either index.
    `flip` means heights positive towards the body."""
    x, z = file.values if file.shape[0] == 2 else file.values.T
    order, sign = slice(None, None, -1 if x[0] > x[-1] else 1), -1.0 if flip else 1.0
    return PlaneProfile(x_unit * x[order], sign * height_unit * z[order])


SHAPES: dict[str, type[ShapedBody]] = {
    "sphere": Sphere,
    "paraboloid": Paraboloid,
    "ellipsoid": Ellipsoid,
    "cone": Cone,
    "flat_punch": FlatPunch,
    "height_map": HeightMap,
    "revolved_profile": RevolvedProfile,
    "cylinder": Cylinder,
    "strip": Strip,
    "wedge": Wedge,
    "line_profile": LineProfile,
}


def nearest_shape(written: Any) -> str:
    """Return the name of the indenter shape whose name is most similar to a text.

    Used to suggest a shape for a misspelt name in a scene file. The result is empty without a
    similar name.

    written  name of the shape as written in the scene file
    """
    if not isinstance(written, str):
        return ""
    name = written[:100].lower().replace(" ", "_").replace("-", "_")
    return next(iter(get_close_matches(name, SHAPES, n=1)), "")


def _indenter_tag(value: Any) -> str:
    """Return the tag of the class that validates an indenter:
    the most similar one for a misspelt shape, so that all other mistakes are found as well."""
    shape = value.get("shape") if isinstance(value, dict) else getattr(value, "shape", None)
    return f"<{nearest_shape(shape)}>"


Indenter = Annotated[
    Annotated[Sphere, Tag("<sphere>")]
    | Annotated[Paraboloid, Tag("<paraboloid>")]
    | Annotated[Ellipsoid, Tag("<ellipsoid>")]
    | Annotated[Cone, Tag("<cone>")]
    | Annotated[FlatPunch, Tag("<flat_punch>")]
    | Annotated[HeightMap, Tag("<height_map>")]
    | Annotated[RevolvedProfile, Tag("<revolved_profile>")]
    | Annotated[Cylinder, Tag("<cylinder>")]
    | Annotated[Strip, Tag("<strip>")]
    | Annotated[Wedge, Tag("<wedge>")]
    | Annotated[LineProfile, Tag("<line_profile>")],
    Discriminator(_indenter_tag),
]
