"""Data structures for displacement and stress at points of a body, for all solvers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.largest import index_of_largest
from contact_results.stress.invariants import principal_stresses, von_mises
from contact_scene import Body
from contact_scene.array_types import Field

Indices = NDArray[np.int64]

FIELDS = ("x", "y", "depth", "material", "displacement", "stress", "at_edge")
COMPONENTS = ("xx", "yy", "zz", "yz", "xz", "xy")
# Measures of stress by name, with their meanings.
MEASURES = {
    "von_mises": "equivalent stress of von Mises",
    "max_principal": "largest principal stress, tension positive",
    "max_shear": "half the difference of the extreme principal stresses",
    "interface_shear": "shear stress on an interface, |(xz, yz)|",
    "interface_tensile_stress": "stress zz normal to an interface, tension positive",
}
ON_INTERFACES = frozenset({"interface_shear", "interface_tensile_stress"})


def layer_name(layer: int, layers: int) -> str:
    """Return the name of a material of a layered body, such as `layer 1` or `base`.

    layer   index of the layer, 0 for the outermost; the number of layers denotes the base
    layers  number of layers
    """
    return f"layer {layer + 1}" if layer < layers else "base"


@dataclass(frozen=True, eq=False)
class StressPoints:
    """Displacement and stress at points of a body; the points form an array of any shape (…).

    An interface has two points at each place, one on each side. z points into the body.

    x, y, depth   coordinates of the points (…) [length]
    material      index of the material (…), 0 for the outermost layer; the highest index is the
                  base
    displacement  components u_x, u_y, u_z (3, …) [length]
    stress        components xx, yy, zz, yz, xz, xy (6, …), positive if tensile [force/length^2]
    at_edge       True if a point is at the edge of the computed region (…)
    cells         cell type of meshio and corners (m, corners) of the cells between the points; None
                  without cells
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
        """Equivalent stress of von Mises at the points (…) [force/length^2]."""
        return von_mises(self.stress)

    @cached_property
    def principal(self) -> Field:
        """Principal stresses at the points, most tensile first (3, …) [force/length^2]."""
        return principal_stresses(self.stress)

    @property
    def measures(self) -> Mapping[str, Field]:
        """Stress measures at the points (…) [force/length^2], by the names of `MEASURES`.

        These are von Mises, largest principal and largest shear stress, and shear and tensile
        stress of an interface.
        """
        first, _, last = self.principal
        of = self.components
        across = np.hypot(of["xz"], of["yz"])
        values = (self.von_mises, first, (first - last) / 2, across, of["zz"])
        return dict(zip(MEASURES, values, strict=True))

    @property
    def components(self) -> Mapping[str, Field]:
        """Stress components at the points (…) [force/length^2], by name: xx, yy, zz, yz, xz, xy."""
        return dict(zip(COMPONENTS, self.stress, strict=True))

    def material_name(self, n: int, layers: int) -> str:
        """Return the name of the material at point n, such as `layer 1` or `base`.

        The name is "body" without layers.

        layers  number of layers of the body
        """
        return layer_name(int(self.material[n]), layers) if layers else "body"

    def rotate_to_scene(self, direction: tuple[float, float]) -> StressPoints:
        """Transform places, displacement and stress to the axes of the scene.

        direction  unit vector of the present x axis in the axes of the scene
        """
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
    def concatenate(parts: Sequence[StressPoints]) -> StressPoints:
        """Combine several arrays of stress points along their last index.

        Cells between the points are omitted.
        """

        def concatenated(name: str) -> Any:
            return np.concatenate([getattr(part, name) for part in parts], axis=-1)

        return StressPoints(**{name: concatenated(name) for name in FIELDS})

    def select_columns(self, which: slice) -> StressPoints:
        """Select stress points along their last index; cells between the points are omitted.

        which  slice of the last index
        """
        return StressPoints(**{name: getattr(self, name)[..., which] for name in FIELDS})

    def add_cells(self) -> StressPoints:
        """Add the cells between points at adjacent depths of the same material.

        The first index of the points is the depth. The cells are quadrilaterals for the points of a
        section (depths, n), and hexahedra for those of a volume (depths, nx, ny).
        """
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

    def select_largest(self) -> StressPoints:
        """Select the point at which each stress measure is largest.

        Returns one point per measure, as a flat array (measures,) without cells.
        """
        return self.select(np.array([index_of_largest(one) for one in self.measures.values()]))

    def near(self, reach: float) -> StressPoints:
        """Select the cells that have a corner near the contact, with the points of these cells.

        reach  distance to the sides and in depth within which this corner lies [length]
        """
        assert self.cells is not None
        kind, cells = self.cells
        inside = np.maximum(np.abs(self.x), self.depth) <= reach
        kept, corners = np.unique(cells[inside[cells].any(axis=1)], return_inverse=True)
        return replace(self.select(kept), cells=(kind, corners.reshape(-1, cells.shape[1])))

    def select(self, points: NDArray[np.bool_] | Indices) -> StressPoints:
        """Select stress points by flat index or by mask.

        Returns a flat array of points (n,) without cells.
        """
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
    def flattened(self) -> StressPoints:
        """The same stress points as a flat array (n,); cells between the points are omitted."""
        return self.select(np.arange(self.x.size))

    def is_on_side(self, depth: float, material: int) -> NDArray[np.bool_]:
        """Return a mask (…) of the points on one side of an interface.

        depth     depth of the interface [length]
        material  index of the material on this side
        """
        near = np.abs(self.depth - depth) <= 1e-9 * depth
        return np.asarray(near & (self.material == material))


@dataclass(frozen=True, eq=False)
class StressIncrement:
    """Stress at chosen points of a body at the end of one increment.

    step    load step, from 1
    index   increment within the load step, from 1; None if the history has the ends of load steps
            only
    points  stress at the n points
    errors  stated error of every stress component, one number per point (n,) [force/length^2]; not
            a number if unknown
    """

    step: int
    index: int | None
    points: StressPoints
    errors: Field


@dataclass(frozen=True, eq=False)
class FittedEdge:
    """Edge of the contact at the surface, fitted between the cell centres.

    points      stress points on the edge (n,)
    apart       difference of the largest principal stress on the edge between two fits
                [force/length²]
    determined  True if the fit determines the stress; the points are candidates for maxima in any
                case
    """

    points: StressPoints
    apart: float
    determined: bool = True


@dataclass(frozen=True, eq=False)
class StressField:
    """Stress in a body below a contact, at the points of a section and optionally of a volume.

    body       layers and base of this body
    points     points among which the largest stresses are searched: on cells, the points with the
               largest values at each depth; otherwise all points
    edge       fitted contact edge; None if there is none
    section    points and cells in the plane y = 0 near the contact, in axes with x along
               `direction`
    axis       points on the z axis, downward
    volume     all points with their cells; None if not requested
    label      axis label of x in the section
    shown      extent of figures to the sides and in depth [length]
    how        settings of the computation, for `stress.json`
    direction  unit vector, in the scene, of the x axis of the section
    """

    body: Body
    points: StressPoints
    edge: FittedEdge | None
    section: StressPoints
    axis: StressPoints
    volume: StressPoints | None
    label: str
    shown: tuple[float, float]
    how: Mapping[str, object]
    direction: tuple[float, float] = (1.0, 0.0)
