"""Fields on rings seen from above, on equal cells: what a map draws of them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import map_coordinates

from contact_results.surface import Rings

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result

Field = NDArray[np.float64]

ACROSS = 121  # cells; odd, so that the axis is the centre of one
MARGIN = 1.3  # of the largest radius in contact


@dataclass(frozen=True, eq=False)
class RingsAbove:
    """Values of rings at the centres of cells, linear between rings and angles.

    x, y  centres (n,) [length]
    """

    rings: Rings
    x: Field
    y: Field

    @classmethod
    def around_contact(cls, result: Result, rings: Rings) -> RingsAbove:
        """Cells over the largest contact of any step."""
        touched = [_any_angle(rings.scalar(step, "in_contact")) for step in result.steps]
        reach = MARGIN * float(rings.radii[np.any(touched, axis=0)].max())
        centres = np.linspace(-reach, reach, ACROSS)
        return cls(rings, centres, centres)

    def scalar(self, step: Increment, name: str) -> NDArray[Any] | None:
        """A scalar field (nx, ny); None where the increment has none."""
        field = self.rings.scalar(step, name)
        if field is None:
            return None
        sampled = self._sampled(field.astype(float))
        return sampled > 0.5 if field.dtype == bool else sampled

    def vector(self, step: Increment, name: str) -> Field | None:
        """The x and y components (2, nx, ny) of shear or slip; None where there is none."""
        components = self.rings.components(step, name)
        if components is None:
            return None
        outward, around, ahead = map(self._sampled, components)
        _, angle = self._polar()
        if self.rings.angles is not None and not self.rings.whole:
            around = np.sign(angle) * around
        cos, sin = np.cos(angle), np.sin(angle)
        along, across = outward * cos - around * sin + ahead, outward * sin + around * cos
        x, y = self.rings.direction
        return np.stack([x * along - y * across, y * along + x * across])

    def _polar(self) -> tuple[Field, Field]:
        """Radius, and angle from the load in (-π, π], of every cell (nx, ny)."""
        x, y = np.meshgrid(self.x, self.y, indexing="ij")
        cos, sin = self.rings.direction
        return np.hypot(x, y), np.arctan2(cos * y - sin * x, cos * x + sin * y)

    def _sampled(self, field: Field) -> Field:
        radius, angle = self._polar()
        at = [np.interp(radius, self.rings.radii, np.arange(len(self.rings.radii)))]
        if field.ndim > 1:
            angles = self.rings.angles
            assert angles is not None
            if self.rings.whole:
                # The first ray closes the circle.
                field = np.concatenate([field, field[:, :1]], axis=1)
                angle, angles = angle % (2 * np.pi), np.append(angles, 2 * np.pi)
            at.append(np.interp(np.abs(angle), angles, np.arange(len(angles))))
        return np.asarray(map_coordinates(field, at, order=1))


def _any_angle(field: NDArray[Any] | None) -> NDArray[np.bool_]:
    assert field is not None
    return np.asarray(field.any(axis=tuple(range(1, field.ndim))))
