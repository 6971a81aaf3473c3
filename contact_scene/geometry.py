"""Indenters: bodies with a shape, and the undeformed gap below them."""

from abc import abstractmethod
from typing import Annotated, Any, ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pydantic import Discriminator, Tag

from contact_scene.array_file import FileKey
from contact_scene.body import Body
from contact_scene.height_map import PairOfSpacings, interpolate
from contact_scene.quantity import PositiveLength, SlopeAngle

Gap = NDArray[np.float64]


class ShapedBody(Body):
    """A body with a shape, first touching the plane z = 0 (at the origin where it has a tip)."""

    # While the load grows, the normal force goes with this power of the contact radius, and the
    # approach with that one; None where the contact radius does not change.
    load_exponent: ClassVar[int | None] = 3
    approach_exponent: ClassVar[int | None] = 2

    @abstractmethod
    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Undeformed distance from the plane at first touch [length], shape of x + y.

        x, y  coordinates in the contact plane [length], broadcast together
        Infinite where the body can never touch.
        """


class Sphere(ShapedBody):
    """A sphere, as the exact arc: r^2 / (R + sqrt(R^2 - r^2)) up to its silhouette."""

    shape: Literal["sphere"] = "sphere"
    radius: PositiveLength
    """Radius R [length]."""

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """The arc, continued beyond the silhouette by the height R of the equator."""
        R = self.radius
        r = np.minimum(np.hypot(x, y), R)
        return np.asarray(r * (r / (R + np.sqrt((R - r) * (R + r)))))


class Paraboloid(ShapedBody):
    """A paraboloid of revolution, r^2 / 2R: the shape of Hertz's closed form."""

    shape: Literal["paraboloid"] = "paraboloid"
    radius: PositiveLength
    """Radius of curvature R at the tip [length]."""

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """(x^2 + y^2) / 2R."""
        return np.asarray((np.square(x) + np.square(y)) / (2.0 * self.radius))


class Ellipsoid(ShapedBody):
    """An elliptical paraboloid, x^2 / 2Rx + y^2 / 2Ry: any smooth convex tip, to second order."""

    shape: Literal["ellipsoid"] = "ellipsoid"
    radii: tuple[PositiveLength, PositiveLength]
    """Principal radii of curvature (Rx, Ry) at the tip [length]."""

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """x^2 / 2Rx + y^2 / 2Ry."""
        Rx, Ry = self.radii
        return np.asarray(np.square(x) / (2.0 * Rx) + np.square(y) / (2.0 * Ry))


class Cone(ShapedBody):
    """A cone, r tan(slope)."""

    load_exponent: ClassVar[int | None] = 2
    approach_exponent: ClassVar[int | None] = 1

    shape: Literal["cone"] = "cone"
    slope_angle: SlopeAngle
    """Angle between the flank and the contact plane."""

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """r tan(slope)."""
        return np.asarray(np.hypot(x, y) * np.tan(self.slope_angle))


class FlatPunch(ShapedBody):
    """A circular cylinder pressed on with its flat end."""

    load_exponent: ClassVar[int | None] = None
    approach_exponent: ClassVar[int | None] = None

    shape: Literal["flat_punch"] = "flat_punch"
    radius: PositiveLength
    """Radius of the flat end [length]."""

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Zero below the end, its rim included; infinite outside."""
        return np.where(np.hypot(x, y) <= self.radius, 0.0, np.inf)


class HeightMap(ShapedBody):
    """A measured or made-up surface: heights above the plane, on a grid about the origin."""

    shape: Literal["height_map"] = "height_map"
    file: FileKey
    """A `.npy` file with heights [length], index [i, j] = (x_i, y_j); the lowest touches first."""

    spacing: PairOfSpacings
    """Distance of neighbouring heights along x and y [length]; one number for both."""

    @property
    def extent(self) -> tuple[float, float]:
        """Lengths along x and y that the cells of the map cover [length]."""
        (nx, ny), (dx, dy) = self.file.shape, self.spacing
        return nx * dx, ny * dy

    def initial_gap(self, x: ArrayLike, y: ArrayLike) -> Gap:
        """Heights above the lowest: bit for bit at the map's own points, smooth between them.

        Between points the cubic may dip below the lowest height, by no more than its own error.
        ValueError if a point lies outside the map.
        """
        heights = self.file.values
        return interpolate(heights - heights.min(), self.spacing, x, y)


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
