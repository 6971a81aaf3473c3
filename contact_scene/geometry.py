"""Indenters: bodies with a shape, and the undeformed gap below them."""

import math
from abc import abstractmethod
from functools import lru_cache
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Discriminator, Tag, model_validator

from contact_scene.body import Body
from contact_scene.height_map import (
    HeightUnit,
    PairOfSpacings,
    filled,
    interpolate,
    lowest_point,
)
from contact_scene.reading.array_file import (
    ArrayFile,
    FileKey,
)
from contact_scene.reading.quantity import (
    PositiveLength,
    SlopeAngle,
)
from contact_scene.reading.validator_error import refusal

Gap = NDArray[np.float64]
Pair = tuple[float, float]

# Share of the points of a height map without a height: the corners around a round field of view
# take 1 - π/4 = 0.21, and more on few points.
_MOST_UNMEASURED = 1 / 3


class ShapedBody(Body):
    """A body with a shape, first touching the plane z = 0 (at the origin where it has a tip).

    All that a shape must have is its gap. What else it says of itself solvers may rely on, and what
    it leaves out they do not assume: a class with a gap of its own inherits nothing that another
    shape says.
    """

    @classmethod
    def __pydantic_init_subclass__(cls, **kwargs: Any) -> None:
        super().__pydantic_init_subclass__(**kwargs)
        others = [base for base in cls.__mro__[1:] if "initial_gap" in vars(base)]
        if "initial_gap" in vars(cls) and others != [ShapedBody]:
            for name in _SAID.difference(vars(cls)):
                setattr(cls, name, vars(ShapedBody)[name])

    @abstractmethod
    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Undeformed distance from the plane at first touch [length], shape of x + y.

        x, y  coordinates in the contact plane [length], broadcast together
        Infinite where the body can never touch.
        """

    @property
    def is_of_revolution(self) -> bool:
        """Whether the gap is the same all around the origin."""
        return False

    @property
    def is_even(self) -> bool:
        """Whether the gap is the same at (x, y), (-x, y) and (x, -y)."""
        return self.is_of_revolution

    @property
    def rim(self) -> float | None:
        """Radius of an edge that bounds the contact whatever the load [length]; None without."""
        return None

    @property
    def extent(self) -> Pair | None:
        """Lengths along x and y about the origin within which the gap is known [length]; None
        where it is known everywhere."""
        return None

    @property
    def gap_exponent(self) -> float | None:
        """The gap rises with this power k of the distance from first touch: while the load grows,
        the approach goes with a^k and the normal force with a^(k+1), a the contact radius. None
        where the contact does not grow, or nobody knows how."""
        return None

    # Good to an order of magnitude, for layouts. As powers of the radius, so that the last digit of
    # a root is not decided here.

    def contact_at(self, approach: float) -> Pair | None:
        """Reach of the contact along x and y at an approach, to the power k; None if not known."""
        return None

    def contact_under(self, force: float, modulus: float) -> Pair | None:
        """The same under a normal force, between half-spaces, to the power k + 1.

        modulus  E* [force/length^2]
        """
        return None


_SAID = {
    "gap_exponent",
    "is_of_revolution",
    "is_even",
    "rim",
    "extent",
    "contact_at",
    "contact_under",
}


class SmoothTip(ShapedBody):
    """A shape with two radii of curvature where it touches first (Johnson 1985, section 4.2)."""

    @property
    def gap_exponent(self) -> float:
        """Of a parabola."""
        return 2

    @property
    @abstractmethod
    def tip_radii(self) -> Pair:
        """Along x and along y [length]."""

    def contact_at(self, approach: float) -> Pair:
        """a^2 = R delta, which bounds it along either axis."""
        R_x, R_y = self.tip_radii
        return R_x * approach, R_y * approach

    def contact_under(self, force: float, modulus: float) -> Pair:
        """a^3 = 3 W R / 4 E* with the larger radius."""
        power = 3.0 * force * max(self.tip_radii) / (4.0 * modulus)
        return power, power


class RoundTip(SmoothTip):
    """The same curvature all around."""

    shape: Literal["sphere", "paraboloid"]
    radius: PositiveLength
    """Radius of curvature R at the tip [length]."""

    @property
    def is_of_revolution(self) -> bool:
        """It is."""
        return True

    @property
    def tip_radii(self) -> Pair:
        """R along either."""
        return self.radius, self.radius


class Sphere(RoundTip):
    """A sphere, as the exact arc: r^2 / (R + sqrt(R^2 - r^2)) up to its silhouette."""

    shape: Literal["sphere"] = "sphere"

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """The arc, continued beyond the silhouette by the height R of the equator."""
        R = self.radius
        r = np.minimum(np.hypot(x, y), R)
        return np.asarray(r * (r / (R + np.sqrt((R - r) * (R + r)))))


class Paraboloid(RoundTip):
    """A paraboloid of revolution, r^2 / 2R: the shape of Hertz's closed form."""

    shape: Literal["paraboloid"] = "paraboloid"

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """(x^2 + y^2) / 2R."""
        return np.asarray((np.square(x) + np.square(y)) / (2.0 * self.radius))


class Ellipsoid(SmoothTip):
    """An elliptical paraboloid, x^2 / 2Rx + y^2 / 2Ry: any smooth convex tip, to second order."""

    shape: Literal["ellipsoid"] = "ellipsoid"
    radii: tuple[PositiveLength, PositiveLength]
    """Principal radii of curvature (Rx, Ry) at the tip [length]."""

    @property
    def is_of_revolution(self) -> bool:
        """Where its radii are the same."""
        return self.radii[0] == self.radii[1]

    @property
    def is_even(self) -> bool:
        """It is."""
        return True

    @property
    def tip_radii(self) -> Pair:
        """Rx and Ry."""
        return self.radii

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """x^2 / 2Rx + y^2 / 2Ry."""
        Rx, Ry = self.radii
        return np.asarray(np.square(x) / (2.0 * Rx) + np.square(y) / (2.0 * Ry))


class Cone(ShapedBody):
    """A cone, r tan(slope)."""

    shape: Literal["cone"] = "cone"
    slope_angle: SlopeAngle
    """Angle between the flank and the contact plane."""

    @property
    def gap_exponent(self) -> float:
        """Of a straight flank."""
        return 1

    @property
    def is_of_revolution(self) -> bool:
        """It is."""
        return True

    def contact_at(self, approach: float) -> Pair:
        """a = 2 delta / pi tan(slope) (Johnson 1985, section 5.2)."""
        reach = 2.0 * approach / (np.pi * self._slope)
        return reach, reach

    def contact_under(self, force: float, modulus: float) -> Pair:
        """a^2 = 2 W / pi E* tan(slope)."""
        power = 2.0 * force / (np.pi * modulus * self._slope)
        return power, power

    @property
    def _slope(self) -> float:
        return math.tan(self.slope_angle)

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """r tan(slope)."""
        return np.asarray(np.hypot(x, y) * np.tan(self.slope_angle))


class FlatPunch(ShapedBody):
    """A circular cylinder pressed on with its flat end."""

    shape: Literal["flat_punch"] = "flat_punch"
    radius: PositiveLength
    """Radius of the flat end [length]."""

    @property
    def is_of_revolution(self) -> bool:
        """It is."""
        return True

    @property
    def rim(self) -> float:
        """The edge of its end."""
        return self.radius

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Zero below the end, its rim included; infinite outside."""
        return np.where(np.hypot(x, y) <= self.radius, 0.0, np.inf)


class HeightMap(ShapedBody):
    """A measured or made-up surface: heights above the plane, on a grid about the origin."""

    shape: Literal["height_map"] = "height_map"
    file: FileKey
    """A `.npy` file with heights, index [i, j] = (x_i, y_j), or a `.csv` or `.txt` file, printed as
    seen from above with x to the right and y upwards; the lowest point of the interpolated surface
    touches first. NaN, empty fields of a text file too, are points that were not measured."""

    spacing: PairOfSpacings
    """Distance of neighbouring heights along x and y [length]; one number for both."""

    height_unit: HeightUnit = 1.0
    """Unit of the heights, such as "um"."""

    flip: bool = False
    """Whether the heights count towards the body, as of an indenter measured from outside."""

    @property
    def gap_exponent(self) -> float:
        """Of the bumps that it touches with."""
        return 2

    @property
    def is_even(self) -> bool:
        """Where its heights are, to the last bit."""
        return all(np.array_equal(self.heights, np.flip(self.heights, axis)) for axis in (0, 1))

    @property
    def extent(self) -> Pair:
        """Lengths along x and y that the cells of the map cover [length]."""
        (nx, ny), (dx, dy) = self.file.shape, self.spacing
        return nx * dx, ny * dy

    @model_validator(mode="after")
    def _is_measured(self) -> "HeightMap":
        if self.unmeasured > _MOST_UNMEASURED:
            raise refusal(
                f"the map {self.file} has no height at {self.unmeasured:.0%} of its points",
                f"at most {_MOST_UNMEASURED:.0%}",
                "cut the map to the part that was measured",
            )
        return self

    @property
    def unmeasured(self) -> float:
        """Share of points without a height."""
        return float(np.mean(np.isnan(self.file.values)))

    @property
    def heights(self) -> Gap:
        """Above the body, smooth where they were not measured [length]."""
        return _surface(self.file, self.height_unit, self.flip)[0]

    @property
    def lowest_on_rim(self) -> bool:
        """Whether the lowest point, which touches first, is an outermost one."""
        *_, place = _surface(self.file, self.height_unit, self.flip)
        return any(at in (0.0, n - 1.0) for at, n in zip(place, self.file.shape, strict=True))

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Heights above the minimum of the surface between the outermost points.

        ValueError if a point lies outside the map.
        """
        heights, lowest, dip, _ = _surface(self.file, self.height_unit, self.flip)
        return np.asarray(interpolate(heights - lowest, self.spacing, x, y) - dip)


@lru_cache(maxsize=2)
def _surface(file: ArrayFile, unit: float, flip: bool) -> tuple[Gap, float, float, Pair]:
    """Heights of a map, the lowest one, the minimum of the interpolated surface above it (not
    positive), and the position of this minimum in indices of points."""
    factor = -unit if flip else unit
    heights = file.values if factor == 1.0 else factor * file.values
    heights = filled(heights)
    return heights, float(np.min(heights)), *lowest_point(heights)


SHAPES: dict[str, type[ShapedBody]] = {
    "sphere": Sphere,
    "paraboloid": Paraboloid,
    "ellipsoid": Ellipsoid,
    "cone": Cone,
    "flat_punch": FlatPunch,
    "height_map": HeightMap,
}


def _shape(value: Any) -> str:
    shape = value.get("shape") if isinstance(value, dict) else getattr(value, "shape", None)
    return f"<{shape}>" if isinstance(shape, str) else ""


Indenter = Annotated[
    Annotated[Sphere, Tag("<sphere>")]
    | Annotated[Paraboloid, Tag("<paraboloid>")]
    | Annotated[Ellipsoid, Tag("<ellipsoid>")]
    | Annotated[Cone, Tag("<cone>")]
    | Annotated[FlatPunch, Tag("<flat_punch>")]
    | Annotated[HeightMap, Tag("<height_map>")],
    Discriminator(_shape),
]
