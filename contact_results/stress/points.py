"""Displacement and stress at points of a body, whoever computed them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.stress.invariants import principal_stresses, von_mises
from contact_scene.array_types import Field

Indices = NDArray[np.int64]

FIELDS = ("x", "y", "depth", "material", "displacement", "stress", "at_edge")
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
# Names and meanings.
MEASURES = {
    "von_mises": "equivalent stress of von Mises",
    "max_principal": "largest principal stress, tension positive",
    "max_shear": "half the difference of the extreme principal stresses",
    "interface_shear": "shear stress on an interface, |(xz, yz)|",
    "interface_tensile_stress": "stress zz normal to an interface, tension positive",
}
ON_INTERFACES = frozenset({"interface_shear", "interface_tensile_stress"})


@dataclass(frozen=True, eq=False)
class StressPoints:
    """Fields at points of any arrangement (…), z into the body; at an interface there is a point
    on each side.

    x, y, depth   (…) [length]
    material      (…) 0 for the outermost layer
    displacement  u_x, u_y, u_z (3, …) [length]
    stress        tension positive (6, …) [force/length^2]: xx, yy, zz, yz, xz, xy
    cells         kind and corners of the cells between the points; None where there are none
    at_edge       whether a point is on the edge of what was computed (…)
    """

    x: Field
    y: Field
    depth: Field
    material: Indices
    displacement: Field
    stress: Field
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
        of = self.components
        across = np.hypot(of["xz"], of["yz"])
        values = (self.von_mises, first, (first - last) / 2, across, of["zz"])
        return dict(zip(MEASURES, values, strict=True))

    @property
    def components(self) -> Mapping[str, Field]:
        """The stress (…) by the names of its components."""
        return dict(zip(COMPONENTS, self.stress, strict=True))

    def turned(self, direction: tuple[float, float]) -> StressPoints:
        """The same seen from axes in which x points along a direction."""
        if direction == (1.0, 0.0):
            return self
        c, s = direction
        (u, v, w), (xx, yy, zz, yz, xz, xy) = self.displacement, self.stress
        mean, half = (xx + yy) / 2, (xx - yy) / 2 * (c * c - s * s) - 2 * c * s * xy
        shear = c * s * (xx - yy) + (c * c - s * s) * xy
        stress = [mean + half, mean - half, zz, s * xz + c * yz, c * xz - s * yz, shear]
        return replace(
            self,
            x=c * self.x - s * self.y,
            y=s * self.x + c * self.y,
            displacement=np.stack([c * u - s * v, s * u + c * v, w]),
            stress=np.stack(stress),
        )

    @staticmethod
    def joined(parts: Sequence[StressPoints]) -> StressPoints:
        """Join points along their last index, without cells."""

        def together(name: str) -> Any:
            return np.concatenate([getattr(part, name) for part in parts], axis=-1)

        return StressPoints(**{name: together(name) for name in FIELDS})

    def columns(self, which: slice) -> StressPoints:
        """Select along the last index, without cells."""
        return StressPoints(**{name: getattr(self, name)[..., which] for name in FIELDS})

    def with_cells(self) -> StressPoints:
        """Add the cells between adjacent levels of one material: quadrilaterals of a section
        (levels, n), hexahedra of a volume (levels, nx, ny)."""
        index: Any = np.arange(self.x.size).reshape(self.x.shape)
        index = index[..., 0] if index.shape[2:] == (1,) else index
        layer = self.material.reshape(len(index), -1)[:, 0]
        above = np.flatnonzero(layer[:-1] == layer[1:])
        less, more = slice(None, -1), slice(1, None)
        around: list[tuple[slice, ...]]
        kind, around = "quad", [(less,), (more,)]
        if index.ndim == 3:
            kind, around = "hexahedron", [(less, less), (more, less), (more, more), (less, more)]
        below = around if index.ndim == 3 else around[::-1]
        corners = [index[above][:, *at] for at in around]
        corners += [index[above + 1][:, *at] for at in below]
        return replace(self, cells=(kind, np.stack(corners, axis=-1).reshape(-1, len(corners))))

    def with_largest(self) -> StressPoints:
        """The points (n,) that have the largest values of the measures, without cells."""
        return self.chosen(np.array([np.argmax(values) for values in self.measures.values()]))

    def near(self, reach: float) -> StressPoints:
        """The cells that have a corner within a distance to the sides and in depth."""
        assert self.cells is not None
        kind, cells = self.cells
        inside = np.maximum(np.abs(self.x), self.depth) <= reach
        kept, corners = np.unique(cells[inside[cells].any(axis=1)], return_inverse=True)
        return replace(self.chosen(kept), cells=(kind, corners.reshape(-1, cells.shape[1])))

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
            self.at_edge.ravel()[which],
        )

    @property
    def in_a_row(self) -> StressPoints:
        """All points (n,), without cells."""
        return self.chosen(np.arange(self.x.size))

    def on_side(self, depth: float, material: int) -> NDArray[np.bool_]:
        """Which points lie on one side of an interface (…)."""
        near = np.abs(self.depth - depth) <= 1e-9 * depth
        return np.asarray(near & (self.material == material))


@dataclass(frozen=True, eq=False)
class FittedEdge:
    """The edge of the contact at the surface, as it was fitted between the cells.

    points  on it (n,)
    apart   difference of the largest principal stress there by another fit [force/length²]
    determined
            whether the stress there is determined; if not, it is a candidate for the largest
    """

    points: StressPoints
    apart: float
    determined: bool = True


@dataclass(frozen=True, eq=False)
class StressField:
    """Stress in a body below a contact.

    points   that may have the largest values: on cells those of each level, else all
    edge     of the contact, where it could be fitted
    section  the plane y = 0 near the contact, with cells
    axis     down the z axis
    volume   all points with their cells; None where not asked for
    label    what x is in the section
    shown    how far a figure reaches to the sides and in depth [length]
    how      how it was computed, for the record
    direction  unit vector, in the scene, of x in the section
    """

    points: StressPoints
    edge: FittedEdge | None
    section: StressPoints
    axis: StressPoints
    volume: StressPoints | None
    label: str
    shown: tuple[float, float]
    how: Mapping[str, object]
    direction: tuple[float, float] = (1.0, 0.0)
