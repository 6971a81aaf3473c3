"""Displacement and stress at the points of a section."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from contact_scene.array_types import Field
from fem_reference.elasticity.motion import Motion

Indices = NDArray[np.int64]

AS_SINE = (3, 5)
"""Components of the stress that go as sin n theta: tz and rt."""

SAME_DEPTH = 1e-9


@dataclass(frozen=True, eq=False)
class Amplitude:
    """Fields of one motion: cos n theta, but u_theta and the stresses tz, rt sin n theta; those of
    torsion do not depend on theta.

    displacement  u_r, u_theta, u_z (3, n) [length]
    stress        rr, tt, zz, tz, rz, rt (6, n), tension positive [force/length^2]
    """

    motion: Motion
    displacement: Field
    stress: Field


@dataclass(frozen=True, eq=False)
class SectionField:
    """Fields of one body over its section, z into it; at an interface one point for each material.

    points    r and z (2, n) [length]
    material  (n,) 0 for the outermost layer
    cells     (e, 9) points of an element: corners, midsides, middle
    parts     contributions whose sum is the field
    """

    points: Field
    material: Indices
    cells: Indices
    parts: tuple[Amplitude, ...]

    def displacement(self, theta: float = 0.0) -> Field:
        """u_r, u_theta, u_z (3, n) on the half plane at an angle from the load [length]."""
        return self._sum([part.displacement for part in self.parts], (1,), theta)

    def stress(self, theta: float = 0.0) -> Field:
        """Return the stress rr, tt, zz, tz, rz, rt (6, n), positive in tension [force/length^2]."""
        return self._sum([part.stress for part in self.parts], AS_SINE, theta)

    @cached_property
    def axis(self) -> Indices:
        """Points on the axis, downwards; those of an interface with the upper material first."""
        return self._sorted(self.points[0] == 0.0, self.points[1])

    def side(self, depth: float, material: int) -> Indices:
        """Return indices of points at the depth of an interface in a material, in the order of
        r."""
        on_it = np.isclose(self.points[1], depth, rtol=SAME_DEPTH, atol=0.0)
        return self._sorted(on_it & (self.material == material), self.points[0])

    def _sorted(self, chosen: NDArray[np.bool_], along: Field) -> Indices:
        found = np.flatnonzero(chosen)
        return found[np.lexsort((self.material[found], along[found]))]

    def _sum(self, fields: list[Field], as_sine: tuple[int, ...], theta: float) -> Field:
        total = np.zeros_like(fields[0])
        for part, field in zip(self.parts, fields, strict=True):
            n = part.motion.harmonic
            factor = np.full(len(field), np.cos(n * theta))
            if n > 0:
                factor[list(as_sine)] = np.sin(n * theta)
            total += factor[:, None] * field
        return total
