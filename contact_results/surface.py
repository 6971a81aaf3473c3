"""Surface grids of a result: the points that carry tractions, gap and slip.

`Cells` holds the rectangular cells of the semi-analytical solver. `Rings` holds the rings around
the z axis of the finite elements and of the radial solver, or pairs of lines in a line contact.
Files, figures and sums read the results of all solvers through `Surface`, which is one of the two.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field

Surface: TypeAlias = "Cells | Rings"

if TYPE_CHECKING:
    import fem_reference
    import radial
    import semi_analytical

    Increment = semi_analytical.Increment | fem_reference.Increment | radial.Increment
    Result = semi_analytical.Result | fem_reference.Result | radial.Result


AROUND = 48  # points on a full circle if the fields depend on the radius alone
# Vector fields on the surface, their components on rings, and all fields of an increment.
VECTORS = ("shear", "slip")
POLAR = ("radial", "circumferential", "along_load")
SURFACE_FIELDS = (
    *("pressure", "gap", "in_contact", "in_stick", "dissipation", *VECTORS),
    *(f"{vector}_{component}" for vector in VECTORS for component in POLAR),
)


class ProfileLine(NamedTuple):
    """ProfileLine through the z axis on the surface, on which profiles of the fields are drawn.

    places      coordinates of the points along the line (n,) [length]
    label       text for the axis of a figure that shows these coordinates
    components  names of the vector components along and across the line
    """

    places: Field
    label: str
    components: tuple[str, str]


@dataclass(frozen=True, eq=False)
class Cells:
    """Surface grid of equal rectangular cells; index [i, j] is the cell centred at (x_i, y_j).

    Scalar fields have the shape (nx, ny), vector fields the shape (2, nx, ny). Profiles are drawn
    on the line y = 0.

    x, y       coordinates of the cell centres (nx,), (ny,) [length]
    cell_area  area of one cell [length^2]
    """

    x: Field
    y: Field
    cell_area: float

    @property
    def axes(self) -> Mapping[str, Field]:
        """Coordinates of the cell centres by name: x (nx,) and y (ny,) [length]."""
        return {"x": self.x, "y": self.y}

    @property
    def positions(self) -> Field:
        """Coordinates x and y of the cell centres (2, nx, ny) [length]."""
        return np.stack(np.meshgrid(self.x, self.y, indexing="ij"))

    @property
    def weights(self) -> Field:
        """Quadrature weights: the area of one cell at every cell centre (nx, ny) [length^2].

        The sum of weight times field over all points is the integral of the field over the surface.
        """
        return np.full((len(self.x), len(self.y)), self.cell_area)

    @property
    def profile_line(self) -> ProfileLine:
        """ProfileLine on which profiles of the fields are drawn: all cell centres x, at y = 0."""
        return ProfileLine(self.x, "x" if self.of_strips else "x at y = 0", ("x", "y"))

    @property
    def of_strips(self) -> bool:
        """True for the strips of a line contact: one row of cells, 1 m long."""
        return len(self.y) == 1

    @property
    def direction(self) -> tuple[float, float]:
        """Unit vector along the line on which profiles of the fields are drawn: the x axis."""
        return 1.0, 0.0

    def scalar(self, increment: Increment, name: str) -> NDArray[Any] | None:
        """Return a field of an increment on the cells, as the solver stored it.

        name  name of the field, an attribute of the increment

        Returns None if the increment has no such field.
        """
        field: NDArray[Any] | None = getattr(increment, name, None)
        return field

    vector = scalar

    def along(self, field: Field) -> Field:
        """Evaluate a field (…, nx, ny) of the cells at all x on the line y = 0.

        If ny is odd, the result is the central row of cells. If ny is even, it is the mean of the
        two rows next to y = 0. The error of this mean is h^2/8 times the second derivative along y,
        with the cell width h.
        """
        ny = field.shape[-1]
        return np.asarray((field[..., (ny - 1) // 2] + field[..., ny // 2]) / 2)

    vector_along = along


@dataclass(frozen=True, eq=False)
class Rings:
    """Surface grid of rings around the z axis; fields are linear between the rings.

    A field has the index [ring] or [ring, angle]. Without angles, the points lie on the ray in the
    direction of the load. With angles, the points cover one of two ranges:

    - a half circle with both ends; the points then represent their mirror images as well,
    - the full circle, equally spaced from 0.

    radii      radii of the rings, ascending (rings,) [length]
    angles     angles from the direction of the tangential load (angles,) [radian]; None if the
               fields depend on the radius alone
    direction  unit vector of the tangential load
    polar      True if all vectors have constant radial and circumferential components on each ring
    of_strips  True in a line contact: a ring is a pair of lines at x and -x with equal fields
    """

    radii: Field
    angles: Field | None
    direction: tuple[float, float]
    polar: bool
    of_strips: bool = False

    @property
    def covers_circle(self) -> bool:
        """True if the angles of the points cover the full circle.

        False if they cover a half circle, or if there are none.
        """
        return self.angles is not None and bool(self.angles[-1] > 1.25 * np.pi)

    @property
    def axes(self) -> Mapping[str, Field]:
        """Radii of the rings [length], and angles [radian] if the fields have any, by name.

        The radii of a line contact have the name "distances".
        """
        if self.of_strips:
            return {"distances": self.radii}
        return {"radii": self.radii} | ({} if self.angles is None else {"angles": self.angles})

    @property
    def positions(self) -> Field:
        """Coordinates x and y of the points, shape (2, rings) or (2, rings, angles) [length]."""
        if self.angles is None:
            return self._rotate_from_load_axes(np.stack([self.radii, np.zeros_like(self.radii)]))
        around = np.stack([np.cos(self.angles), np.sin(self.angles)])
        return self._rotate_from_load_axes(self.radii[:, None] * around[:, None])

    @property
    def weights(self) -> Field:
        """Quadrature weights of the points on the rings [length^2].

        The weight is ∫ψ r dr times the range of angles that a point represents (2π without angles).
        ψ is the hat function of a ring: 1 on this ring, linear, 0 on the adjacent rings. Inside the
        first ring its hat function stays 1 up to the axis. In a line contact the weight is ∫ψ dr of
        both lines, per unit length.
        """
        inner, outer = self.radii[:-1], self.radii[1:]
        if self.of_strips:
            width = np.zeros_like(self.radii)
            width[0] = 2 * self.radii[0]
            width[:-1] += outer - inner
            width[1:] += outer - inner
            return width
        area = np.zeros_like(self.radii)
        area[0] = self.radii[0] ** 2 / 2
        area[:-1] += (outer - inner) * (2 * inner + outer) / 6
        area[1:] += (outer - inner) * (inner + 2 * outer) / 6
        if self.angles is None:
            return 2 * np.pi * area
        if self.covers_circle:
            return np.outer(area, np.full(len(self.angles), 2 * np.pi / len(self.angles)))
        ends = [0.0, *(self.angles[1:] + self.angles[:-1]) / 2, np.pi]
        return 2 * np.diff(ends) * area[:, None]

    @property
    def profile_line(self) -> ProfileLine:
        """ProfileLine on which profiles of the fields are drawn.

        The line is a radius if the fields depend on the radius alone, else the diameter along the
        load.
        """
        along_x = self.direction == (1.0, 0.0)
        load = ("x", "y") if along_x else ("∥", "⊥")
        if self.angles is None:
            label = "x" if self.of_strips else "radius r"
            return ProfileLine(self.radii, label, ("r", "θ") if self.polar else load)
        places = np.concatenate([-self.radii[::-1], self.radii])
        label = "x at y = 0" if along_x else "distance from the axis along the load"
        return ProfileLine(places, label, load)

    def scalar(self, increment: Increment, name: str) -> NDArray[Any] | None:
        """Return a scalar field of an increment on the rings.

        If the grid has angles, a field that depends on the radius alone is repeated at every angle.

        name  name of the field, an attribute of the increment

        Returns None if the increment has no such field.
        """
        return self._repeat_at_angles(getattr(increment, name, None))

    def components(self, increment: Increment, name: str) -> Field | None:
        """Return three components (3, …) of shear or slip: radial, circumferential, along the load.

        A result stores either the first two or the last one. Missing components are zero. Returns
        None if the increment has no such vector.

        name  "shear" or "slip"
        """
        parts = [
            self._repeat_at_angles(getattr(increment, f"{name}_{component}")) for component in POLAR
        ]
        given = [part for part in parts if part is not None]
        if not given:
            return None
        return np.stack([np.zeros_like(given[0]) if part is None else part for part in parts])

    def vector(self, increment: Increment, name: str) -> Field | None:
        """Return the x and y components (2, …) of shear or slip on the rings.

        The method transforms the radial, circumferential and along-load components that the solver
        stored. It returns None if the increment has no such vector.

        name  "shear" or "slip"
        """
        components = self.components(increment, name)
        if components is None:
            return None
        angles = np.zeros_like(self.radii) if self.angles is None else self.angles
        return self.in_scene_axes(components, angles)

    def in_scene_axes(self, components: Iterable[Field], angles: Field) -> Field:
        """Transform vectors on rings to x and y components (2, …).

        components  radial, circumferential and along-load components (3, …)
        angles      angles from the direction of the tangential load [radian]
        """
        outward, around, ahead = components
        cos, sin = np.cos(angles), np.where(angles == np.pi, 0.0, np.sin(angles))
        return self._rotate_from_load_axes(
            np.stack([outward * cos - around * sin + ahead, outward * sin + around * cos])
        )

    def full_circle(self, increment: Any) -> tuple[Rings, Any]:
        """Extend the rings and the fields of an increment to angles over the full circle.

        A half circle is reflected about the direction of the load. Rings without angles get AROUND
        angles, and their fields stay functions of the radius.
        """
        if self.covers_circle:
            return self, increment
        if self.angles is None:
            angles = np.linspace(0.0, 2 * np.pi, AROUND, endpoint=False)
            return replace(self, angles=angles), increment
        angles = np.append(self.angles, 2 * np.pi - self.angles[-2:0:-1])
        given = {name: getattr(increment, name, None) for name in SURFACE_FIELDS}
        fields = {name: _reflect_field(name, field) for name, field in given.items()}
        return replace(self, angles=angles), SimpleNamespace(**fields)

    def on_both_sides(self) -> Rings:
        """Return rings on which profiles are drawn along the whole diameter in load direction.

        Rings without angles get the angles 0 and π, which are the two rays of this diameter. Rings
        with angles are returned unchanged.
        """
        return self if self.angles is not None else replace(self, angles=np.array([0.0, np.pi]))

    def along(self, field: Field) -> Field:
        """Evaluate a field at the points of the line on which profiles are drawn.

        Without angles, the field itself is returned. With angles, the values follow the diameter
        from the outermost ring on the ray at angle π to the outermost ring on the ray at angle 0.
        """
        if self.angles is None:
            return field
        behind = len(self.angles) // 2 if self.covers_circle else -1
        return np.concatenate([field[..., ::-1, behind], field[..., :, 0]], axis=-1)

    def vector_along(self, vector: Field) -> Field:
        """Evaluate a vector field (2, …) at the points of the line on which profiles are drawn.

        vector  x and y components of the vector

        Returns the components along and across the tangential load.
        """
        return self.along(self._rotate_from_load_axes(vector, -1))

    def _repeat_at_angles(self, field: NDArray[Any] | None) -> NDArray[Any] | None:
        if field is None or self.angles is None or field.ndim > 1:
            return field
        return np.broadcast_to(field[:, None], (len(self.radii), len(self.angles)))

    def _rotate_from_load_axes(self, vector: Field, sense: int = 1) -> Field:
        """Rotate a vector field (2, …) from load axes to scene axes, or back with sense = -1."""
        (x, y), (along, across) = self.direction, vector
        y *= sense
        return np.stack([along * x - across * y, along * y + across * x])


def _reflect_field(name: str, field: NDArray[Any] | None) -> NDArray[Any] | None:
    """Extend a field on rings to the full circle. Circumferential components are odd."""
    if field is None or field.ndim == 1:
        return field
    image = field[:, -2:0:-1]
    return np.concatenate([field, -image if name.endswith("circumferential") else image], axis=1)


def surface_on(axes: Mapping[str, Field], direction: tuple[float, float]) -> Surface:
    """Create the surface grid with the given coordinates of its points.

    axes       coordinates by name: x and y of cell centres, or radii and, optionally, angles of
               rings, or distances in a line contact
    direction  unit vector of the tangential load, which points at angle 0; used for rings only
    """
    if "radii" in axes:
        return Rings(axes["radii"], axes.get("angles"), direction, polar=False)
    if "distances" in axes:
        return Rings(axes["distances"], None, direction, polar=False, of_strips=True)
    x, y = axes["x"], axes["y"]
    if len(y) == 1:
        return Cells(x, y, float(x[-1] - x[0]) / (len(x) - 1))
    return Cells(x, y, float((x[-1] - x[0]) * (y[-1] - y[0])) / ((len(x) - 1) * (len(y) - 1)))


def surface_of(result: Result) -> Surface:
    """Create the surface grid that carries the fields of a result of any solver."""
    if hasattr(result, "grid"):
        return Cells(result.grid.x, result.grid.y, result.grid.cell_area)
    increments = result.increments
    angles = next((i.angles for i in increments if i.angles is not None), None)
    polar = all(i.shear_along_load is None and i.slip_along_load is None for i in increments)
    strips = increments[0].is_line
    return Rings(increments[0].radii, angles, result.plan.direction, polar, strips)
