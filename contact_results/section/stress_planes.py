"""Stress in the plane of the load, and where it is largest."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from math import cos, pi

import numpy as np
from numpy.typing import NDArray

from contact_results.files.stress_extremes import layer_name
from contact_scene import Body, IsotropicMaterial
from fem_reference.stress import SectionField
from semi_analytical.stress.invariants import principal_stresses, von_mises

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class StressPlane:
    """Fields on the plane through the axis along the load: one half where the angle does not
    matter, else both, the one behind the axis at negative x.

    x, z          positions (n,) [length]
    material      (n,)
    cells         (e, 9)
    displacement  u_x, u_y, u_z (3, n) [length]
    stress        rr, tt, zz, tz, rz, rt (6, n) [force/length^2]
    """

    x: Field
    z: Field
    material: NDArray[np.int64]
    cells: NDArray[np.int64]
    displacement: Field
    stress: Field

    @classmethod
    def of(cls, field: SectionField) -> StressPlane:
        """The plane of a section's field."""
        halves = (0.0,) if field.is_axisymmetric else (0.0, pi)
        count = field.points.shape[1]
        moved = []
        for theta in halves:
            u_r, u_theta, u_z = field.displacement(theta)
            moved.append(np.stack([cos(theta) * u_r, cos(theta) * u_theta, u_z]))
        return cls(
            np.concatenate([cos(theta) * field.points[0] for theta in halves]),
            np.tile(field.points[1], len(halves)),
            np.tile(field.material, len(halves)),
            np.concatenate([field.cells + k * count for k in range(len(halves))]),
            np.concatenate(moved, axis=1),
            np.concatenate([field.stress(theta) for theta in halves], axis=1),
        )

    @cached_property
    def von_mises(self) -> Field:
        """Equivalent stress (n,)."""
        return von_mises(self.stress)

    @cached_property
    def principal(self) -> Field:
        """Principal stresses, largest first (3, n)."""
        return principal_stresses(self.stress)

    @property
    def measures(self) -> dict[str, Field]:
        """What is looked for the largest of (n,)."""
        first, _, last = self.principal
        return {
            "von_mises": self.von_mises,
            "max_principal": first,
            "max_shear": (first - last) / 2,
        }


@dataclass(frozen=True)
class Extreme:
    """Where in a region a measure is largest: a point of the mesh, nothing interpolated."""

    region: str
    measure: str
    value: float
    x: float
    depth: float


def extremes(plane: StressPlane, body: Body) -> tuple[Extreme, ...]:
    """Of every measure in the body, in every material and on every side of an interface."""
    found = []
    for region, inside in _regions(plane, body):
        for measure, values in plane.measures.items():
            k = int(np.argmax(np.where(inside, values, -np.inf)))
            x, z = float(plane.x[k]), float(plane.z[k])
            found.append(Extreme(region, measure, float(values[k]), x, z))
    return tuple(found)


def interface_sides(body: Body) -> list[tuple[int, str, float, int]]:
    """Number, side, depth and material of both sides of every interface; of a rigid base one."""
    depths = np.cumsum([layer.thickness for layer in body.layers])
    sides = []
    for k, depth in enumerate(depths.tolist()):
        sides.append((k + 1, "above", depth, k))
        if k + 1 < len(depths) or isinstance(body.material, IsotropicMaterial):
            sides.append((k + 1, "below", depth, k + 1))
    return sides


def _regions(plane: StressPlane, body: Body) -> Iterator[tuple[str, Mask]]:
    yield "body", np.ones(len(plane.x), dtype=bool)
    if not body.layers:
        return
    for material in np.unique(plane.material):
        name = layer_name(int(material), len(body.layers))
        yield name, plane.material == material
    for number, side, depth, material in interface_sides(body):
        yield f"interface {number} {side}", on_side(plane, depth, material)


def on_side(plane: StressPlane, depth: float, material: int) -> Mask:
    """Points of one side of an interface."""
    return np.asarray((np.abs(plane.z - depth) <= 1e-9 * depth) & (plane.material == material))
