"""Surface grids of the fields of a result: cells, or rings around the z axis.

Files, figures and sums use the protocol `Surface` for the results of all solvers.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field

if TYPE_CHECKING:
    import fem_reference
    import radial
    import semi_analytical

    Increment = semi_analytical.Increment | fem_reference.Increment | radial.Increment
    Result = semi_analytical.Result | fem_reference.Result | radial.Result


class Line(NamedTuple):
    """The line through the axis on which profiles are shown.

    places      (n,) [length]
    label       axis label of the places
    components  names of the vector components along and across the line
    """

    places: Field
    label: str
    components: tuple[str, str]


class Surface(Protocol):
    """Points that carry the fields of a result. A scalar field has the shape of `weights`."""

    @property
    def axes(self) -> Mapping[str, Field]:
        """Coordinates of each index of a scalar field, by name [length; angles radian]."""

    @property
    def positions(self) -> Field:
        """Coordinates x and y of the points, shape (2, …) [length]."""

    @property
    def weights(self) -> Field:
        """Quadrature weights of the points [length^2]."""

    @property
    def line(self) -> Line:
        """The line on which `along` evaluates fields."""

    @property
    def direction(self) -> tuple[float, float]:
        """Unit vector along the line."""

    def scalar(self, increment: Increment, name: str) -> NDArray[Any] | None:
        """Return a scalar field of an increment, or None if the increment has no such field."""

    def components(self, increment: Increment, name: str) -> Field | None:
        """Return the orthonormal components (n, …) of shear or slip that the solver computed.

        They have no round-off of a rotation. None if the increment has no such vector.
        """

    def vector(self, increment: Increment, name: str) -> Field | None:
        """Return the x and y components (2, …) of shear or slip, or None if there are none."""

    def along(self, field: Field) -> Field:
        """Evaluate a scalar field on the line (n,)."""

    def vector_along(self, vector: Field) -> Field:
        """Evaluate a vector field on the line: components (2, n) along and across it."""


@dataclass(frozen=True, eq=False)
class Cells:
    """Equal rectangles, index [i, j] = (x_i, y_j); the line is y = 0.

    x, y       centres (nx,), (ny,) [length]
    cell_area  [length^2]
    """

    x: Field
    y: Field
    cell_area: float

    @property
    def axes(self) -> Mapping[str, Field]:
        """Centres along x and y."""
        return {"x": self.x, "y": self.y}

    @property
    def positions(self) -> Field:
        """Centres (2, nx, ny) [length]."""
        return np.stack(np.meshgrid(self.x, self.y, indexing="ij"))

    @property
    def weights(self) -> Field:
        """The area of a cell (nx, ny) [length^2]."""
        return np.full((len(self.x), len(self.y)), self.cell_area)

    @property
    def line(self) -> Line:
        """All x at y = 0."""
        return Line(self.x, "x at y = 0", ("x", "y"))

    @property
    def direction(self) -> tuple[float, float]:
        """Unit vector along x."""
        return 1.0, 0.0

    def scalar(self, increment: Increment, name: str) -> NDArray[Any] | None:
        """Return the field of the increment without change."""
        field: NDArray[Any] | None = getattr(increment, name, None)
        return field

    components = vector = scalar

    def along(self, field: Field) -> Field:
        """Evaluate a field (…, nx, ny) on y = 0.

        If ny is even, this is the mean of the two central rows. Its error is h^2/8 times the second
        derivative along y, with the cell width h.
        """
        ny = field.shape[-1]
        return np.asarray((field[..., (ny - 1) // 2] + field[..., ny // 2]) / 2)

    vector_along = along


@dataclass(frozen=True, eq=False)
class Rings:
    """Rings around the z axis, fields linear in between; index [ring] or [ring, angle].

    Without angles, the points lie on the ray along the load. With angles, the points cover either
    a half circle including both ends, and represent their mirror images as well, or the full
    circle at equal spacing from 0.

    radii      ascending (rings,) [length]
    angles     from the direction of the tangential load (angles,) [radian]; None if the fields
               depend on the radius alone
    direction  unit vector of the tangential load
    polar      whether all vectors have constant radial and circumferential components on each ring
    """

    radii: Field
    angles: Field | None
    direction: tuple[float, float]
    polar: bool

    @property
    def whole(self) -> bool:
        """Return True if the angles cover a full circle."""
        return self.angles is not None and bool(self.angles[-1] > 1.25 * np.pi)

    @property
    def axes(self) -> Mapping[str, Field]:
        """Radii, and the angles if there are any."""
        return {"radii": self.radii} | ({} if self.angles is None else {"angles": self.angles})

    @property
    def positions(self) -> Field:
        """Coordinates x and y, shape (2, rings) or (2, rings, angles) [length]."""
        if self.angles is None:
            return self._turned(np.stack([self.radii, np.zeros_like(self.radii)]))
        around = np.stack([np.cos(self.angles), np.sin(self.angles)])
        return self._turned(self.radii[:, None] * around[:, None])

    @property
    def weights(self) -> Field:
        """Quadrature weights 2π∫ψ r dr times the angular share of each point [length^2].

        The hat function ψ of the first ring is constant towards the axis.
        """
        inner, outer = self.radii[:-1], self.radii[1:]
        area = np.zeros_like(self.radii)
        area[0] = self.radii[0] ** 2 / 2
        area[:-1] += (outer - inner) * (2 * inner + outer) / 6
        area[1:] += (outer - inner) * (inner + 2 * outer) / 6
        if self.angles is None:
            return 2 * np.pi * area
        if self.whole:
            return np.outer(area, np.full(len(self.angles), 2 * np.pi / len(self.angles)))
        ends = [0.0, *(self.angles[1:] + self.angles[:-1]) / 2, np.pi]
        return 2 * np.diff(ends) * area[:, None]

    @property
    def line(self) -> Line:
        """The radius; for fields with angles, the diameter along the load."""
        along_x = self.direction == (1.0, 0.0)
        load = ("x", "y") if along_x else (r"\parallel", r"\perp")
        if self.angles is None:
            return Line(self.radii, "radius r", ("r", "θ") if self.polar else load)
        places = np.concatenate([-self.radii[::-1], self.radii])
        label = "x at y = 0" if along_x else "distance from the axis along the load"
        return Line(places, label, load)

    def scalar(self, increment: Increment, name: str) -> NDArray[Any] | None:
        """Return the field, repeated at every angle if the surface has angles."""
        return self._everywhere(getattr(increment, name, None))

    def components(self, increment: Increment, name: str) -> Field | None:
        """Return the radial, circumferential and along-load components (3, …).

        A result has either the first two or the last; missing components are zero.
        """
        parts = [
            self._everywhere(getattr(increment, f"{name}_{component}"))
            for component in ("radial", "circumferential", "along_load")
        ]
        given = [part for part in parts if part is not None]
        if not given:
            return None
        return np.stack([np.zeros_like(given[0]) if part is None else part for part in parts])

    def vector(self, increment: Increment, name: str) -> Field | None:
        """Return the x and y components, transformed from those of `components`."""
        components = self.components(increment, name)
        if components is None:
            return None
        outward, around, ahead = components
        angles = np.zeros_like(self.radii) if self.angles is None else self.angles
        cos, sin = np.cos(angles), np.where(angles == np.pi, 0.0, np.sin(angles))
        return self._turned(
            np.stack([outward * cos - around * sin + ahead, outward * sin + around * cos])
        )

    def on_both_sides(self) -> Rings:
        """Return the surface with angles; without angles, add those of the two rays of the line."""
        return self if self.angles is not None else replace(self, angles=np.array([0.0, np.pi]))

    def along(self, field: Field) -> Field:
        """Evaluate a field on the line, from the ray at angle π to the ray at angle 0."""
        if self.angles is None:
            return field
        behind = len(self.angles) // 2 if self.whole else -1
        return np.concatenate([field[..., ::-1, behind], field[..., :, 0]], axis=-1)

    def vector_along(self, vector: Field) -> Field:
        """Evaluate a vector on the line: components along and across the load."""
        return self.along(self._turned(vector, -1))

    def _everywhere(self, field: NDArray[Any] | None) -> NDArray[Any] | None:
        if field is None or self.angles is None or field.ndim > 1:
            return field
        return np.broadcast_to(field[:, None], (len(self.radii), len(self.angles)))

    def _turned(self, vector: Field, sense: int = 1) -> Field:
        """Rotate from axes along and across the load to x and y; with sense −1, rotate back."""
        (x, y), (along, across) = self.direction, vector
        y *= sense
        return np.stack([along * x - across * y, along * y + across * x])


def surface_on(axes: Mapping[str, Field], direction: tuple[float, float]) -> Surface:
    """Return the surface with the given axes.

    direction  unit vector of angle 0; used for rings
    """
    if "radii" in axes:
        return Rings(axes["radii"], axes.get("angles"), direction, polar=False)
    x, y = axes["x"], axes["y"]
    return Cells(x, y, float((x[-1] - x[0]) * (y[-1] - y[0])) / ((len(x) - 1) * (len(y) - 1)))


def surface_of(result: Result) -> Surface:
    """Return the surface of the fields of a result."""
    if hasattr(result, "grid"):
        return Cells(result.grid.x, result.grid.y, result.grid.cell_area)
    increments = result.increments
    angles = next((i.angles for i in increments if i.angles is not None), None)
    polar = all(i.shear_along_load is None and i.slip_along_load is None for i in increments)
    return Rings(increments[0].radii, angles, result.plan.direction, polar)
