"""Displacement and stress at points of a body, whoever computed them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contact_results.stress.invariants import principal_stresses, von_mises

Field = NDArray[np.float64]
Indices = NDArray[np.int64]

# Names and meanings.
MEASURES = {
    "von_mises": "equivalent stress of von Mises",
    "max_principal": "largest principal stress, tension positive",
    "max_shear": "half the difference of the extreme principal stresses",
}


@dataclass(frozen=True, eq=False)
class StressPoints:
    """Fields at points of any arrangement (…), z into the body; at an interface there is a point
    on each side.

    x, y, depth   (…) [length]
    material      (…) 0 for the outermost layer
    displacement  u_x, u_y, u_z (3, …) [length]
    stress        tension positive (6, …) [force/length^2]: xx, yy, zz, yz, xz, xy
    cylindrical   whether the stress is rr, tt, zz, tz, rz, rt instead
    cells         kind and corners of the cells between the points; None where there are none
    at_edge       whether a point is on the edge of what was computed (…)
    """

    x: Field
    y: Field
    depth: Field
    material: Indices
    displacement: Field
    stress: Field
    cylindrical: bool
    at_edge: NDArray[np.bool_]
    cells: tuple[str, Indices] | None = None

    @cached_property
    def von_mises(self) -> Field:
        """Equivalent stress (…) [force/length^2]."""
        return von_mises(self.stress)

    @cached_property
    def principal(self) -> Field:
        """Principal stresses, largest first (3, …) [force/length^2]."""
        return principal_stresses(self.stress)

    @property
    def measures(self) -> Mapping[str, Field]:
        """What is looked for the largest of (…), by the names of `MEASURES`."""
        first, _, last = self.principal
        values = (self.von_mises, first, (first - last) / 2)
        return dict(zip(MEASURES, values, strict=True))

    @property
    def components(self) -> Mapping[str, Field]:
        """The stress (…) by the names of its components."""
        names = ("rr", "tt", "zz", "tz", "rz", "rt")
        names = names if self.cylindrical else ("xx", "yy", "zz", "yz", "xz", "xy")
        return dict(zip(names, self.stress, strict=True))

    @property
    def along_x(self) -> Mapping[str, Field]:
        """The stress (…) of points with y = 0 as xx, yy, zz, yz, xz, xy: r and x, θ and y point
        away from each other behind the axis."""
        behind = np.copysign(1.0, self.x) if self.cylindrical else 1.0  # the axis is ±0
        xx, yy, zz, yz, xz, xy = self.stress
        return {"xx": xx, "yy": yy, "zz": zz, "yz": behind * yz, "xz": behind * xz, "xy": xy}

    def chosen(self, points: NDArray[np.bool_] | Indices) -> StressPoints:
        """Some of the points (n,), without cells; counted in a row, whatever the arrangement."""
        which = points.ravel()
        return StressPoints(
            self.x.ravel()[which],
            self.y.ravel()[which],
            self.depth.ravel()[which],
            self.material.ravel()[which],
            self.displacement.reshape(3, -1)[:, which],
            self.stress.reshape(6, -1)[:, which],
            self.cylindrical,
            self.at_edge.ravel()[which],
        )

    def on_side(self, depth: float, material: int) -> NDArray[np.bool_]:
        """Which points lie on one side of an interface (…)."""
        near = np.abs(self.depth - depth) <= 1e-9 * depth
        return np.asarray(near & (self.material == material))


@dataclass(frozen=True, eq=False)
class FittedEdge:
    """The edge of the contact at the surface, as it was fitted between the cells.

    points  on it (n,)
    apart   difference of the largest principal stress there by another fit, over itself
    """

    points: StressPoints
    apart: float


@dataclass(frozen=True, eq=False)
class StressField:
    """Stress in a body below a contact.

    points   wherever it was computed
    edge     of the contact, where it could be fitted
    section  the plane y = 0, with cells
    axis     down the z axis
    volume   all points with their cells; None where not asked for
    label    what x is in the section
    letters  of the directions along it and across: x and y, or r and θ
    shown    how far a figure reaches to the sides and in depth [length]
    listed   how far a table reaches to the sides [length]
    how      how it was computed, for the record
    """

    points: StressPoints
    edge: FittedEdge | None
    section: StressPoints
    axis: StressPoints
    volume: StressPoints | None
    label: str
    letters: tuple[str, str]
    shown: tuple[float, float]
    listed: float
    how: Mapping[str, object]
