"""Displacement and stress at the points of a section, as a sum over motions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field
from fem_reference.elasticity.motion import Motion

Indices = NDArray[np.int64]

AS_SINE = (3, 5)
"""Indices of the stress components that are ∝ sin n theta: tz and rt."""

SAME_DEPTH = 1e-9


@dataclass(frozen=True, eq=False)
class Amplitude:
    """Amplitudes of displacement and stress in one angular harmonic n, at the points of a section.

    The motion is the displacement field of the harmonic, such as that of normal loading or torsion.
    u_theta and the stresses tz and rt are ∝ sin n theta, all other components ∝ cos n theta. If the
    harmonic is turned by a quarter wave, they are ∝ -cos n theta and ∝ sin n theta. The fields of
    torsion do not depend on theta.

    motion        angular harmonic and displacement components
    displacement  u_r, u_theta, u_z (3, points) [length]
    stress        rr, tt, zz, tz, rz, rt (6, points), tension positive [force/length^2]
    turned        True for a harmonic turned by a quarter wave
    """

    motion: Motion
    displacement: Field
    stress: Field
    turned: bool = False


@dataclass(frozen=True, eq=False)
class SectionField:
    """Displacement and stress of one body at the points of its meridional section, z into the body.

    A node on an interface is represented by one point for each material.

    points    positions r and z (2, n) [length]
    material  index of the material of every point (n,), 0 for the outermost layer
    cells     type of the cells that represent the elements in files, and the points of every cell
    parts     contributions of the angular harmonics, whose sum is the field
    """

    points: Field
    material: Indices
    cells: tuple[str, Indices]
    parts: tuple[Amplitude, ...]

    def displacement(self, theta: float = 0.0) -> Field:
        """Compute the displacement u_r, u_theta, u_z below the surface at one angle [length].

        The result has the shape (3, n) for the n points of the meridional section.

        theta  angle from the direction of the tangential load [radian]
        """
        return self._sum_motions([part.displacement for part in self.parts], (1,), theta)

    def stress(self, theta: float = 0.0) -> Field:
        """Compute the stress rr, tt, zz, tz, rz, rt of a body below its surface at one angle.

        The result has the shape (6, n) for the n points of the meridional section [force/length^2].
        Tension is positive.

        theta  angle from the direction of the tangential load [radian]
        """
        return self._sum_motions([part.stress for part in self.parts], AS_SINE, theta)

    @cached_property
    def axis(self) -> Indices:
        """Indices of the points on the axis of the body, in the order of increasing depth.

        Used for the stress along the axis. At an interface the point of the upper material is the
        first.
        """
        return self._sort_points(self.points[0] == 0.0, self.points[1])

    def interface_points(self, depth: float, material: int) -> Indices:
        """Return the indices of the points on one side of an interface between two materials.

        Used for the stress along the interface, which may jump between the two sides. The indices
        are in the order of increasing radius.

        depth     depth of the interface [length]
        material  index of the material on the requested side, 0 for the outermost layer
        """
        on_it = np.isclose(self.points[1], depth, rtol=SAME_DEPTH, atol=0.0)
        return self._sort_points(on_it & (self.material == material), self.points[0])

    def _sort_points(self, chosen: NDArray[np.bool_], along: Field) -> Indices:
        """Return the indices of chosen points, sorted by a coordinate, then by material:
        a node on an interface has one point for each material."""
        found = np.flatnonzero(chosen)
        return found[np.lexsort((self.material[found], along[found]))]

    def _sum_motions(self, fields: list[Field], as_sine: tuple[int, ...], theta: float) -> Field:
        """Compute displacement or stress at the angle theta as a sum over the angular harmonics.

        Each harmonic n has the amplitudes of one motion, such as that of normal loading or torsion.

        fields   amplitudes of the field in every motion, such as the stress (6, n)
        as_sine  indices of the components that are ∝ sin n theta; all others are ∝ cos n theta,
                 except in harmonics that are turned by a quarter wave
        theta    angle from the direction of the load [radian]
        """
        total = np.zeros_like(fields[0])
        for part, field in zip(self.parts, fields, strict=True):
            n = part.motion.harmonic
            even, odd = np.cos(n * theta), np.sin(n * theta)
            if part.turned:
                even, odd = odd, -even
            factor = np.full(len(field), even)
            if n > 0:
                factor[list(as_sine)] = odd
            total += factor[:, None] * field
        return total
