"""Interface of influence coefficients, and their combination for two bodies in contact."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field


class InfluenceCoefficients(Protocol):
    """Displacement at the offset (i dx, j dy), i, j >= 0, by unit traction on the cell at the
    origin.

    The first letter of a name is the displacement, the second the traction [length^3/force]. Each
    array has shape (nx, ny) and is computed on first use. Other quadrants follow by parity: zz, xx,
    yy are even in x and y; xy is odd in x and y; zx is odd in x, even in y; zy is even in x, odd in
    y. Reciprocity yields xz = -zx, yz = -zy and yx = xy.
    """

    @property
    def zz(self) -> Field:
        """Normal displacement u_z by a unit pressure on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """

    @property
    def xx(self) -> Field:
        """Tangential displacement u_x by a unit shear q_x on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """

    @property
    def yy(self) -> Field:
        """Tangential displacement u_y by a unit shear q_y on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """

    @property
    def xy(self) -> Field:
        """Tangential displacement u_x by a unit shear q_y on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """

    @property
    def zx(self) -> Field:
        """Normal displacement u_z by a unit shear q_x on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """

    @property
    def zy(self) -> Field:
        """Normal displacement u_z by a unit shear q_y on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """


@dataclass(frozen=True)
class Composite:
    """Influence coefficients of the relative displacement of two bodies under opposite tractions.

    The upper body is a lower body mirrored in the contact plane: its normal-tangential terms change
    sign, F = F1 + J F2 J with J = diag(1, 1, -1). Tractions are those on the lower body.

    lower, upper  coefficients of the deformable bodies, at most one each
    along, down   tangential and normal displacement by the springs of a test rig, equal at all
                  offsets [length^3/force]
    """

    lower: tuple[InfluenceCoefficients, ...]
    upper: tuple[InfluenceCoefficients, ...]
    along: float = 0.0
    down: float = 0.0

    def _added(self, component: str) -> Field:
        return _total(self.lower + self.upper, component)

    def _mirrored(self, component: str) -> Field:
        if not self.upper:
            return _total(self.lower, component)
        if not self.lower:
            return -_total(self.upper, component)
        return _total(self.lower, component) - _total(self.upper, component)

    @cached_property
    def zz(self) -> Field:
        """Normal displacement u_z by a unit pressure on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """
        return self._added("zz") + self.down

    @cached_property
    def xx(self) -> Field:
        """Tangential displacement u_x by a unit shear q_x on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """
        return self._added("xx") + self.along

    @cached_property
    def yy(self) -> Field:
        """Tangential displacement u_y by a unit shear q_y on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """
        return self._added("yy") + self.along

    @cached_property
    def xy(self) -> Field:
        """Tangential displacement u_x by a unit shear q_y on one cell, at all cell offsets (nx,
        ny).

        The unit is [length^3/force].
        """
        return self._added("xy")

    @cached_property
    def zx(self) -> Field:
        """Normal displacement u_z by a unit shear q_x on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """
        return self._mirrored("zx")

    @cached_property
    def zy(self) -> Field:
        """Normal displacement u_z by a unit shear q_y on one cell, at all cell offsets (nx, ny).

        The unit is [length^3/force].
        """
        return self._mirrored("zy")


def _total(bodies: tuple[InfluenceCoefficients, ...], component: str) -> Field:
    values = [getattr(body, component) for body in bodies]
    return np.sum(values, axis=0) if len(values) > 1 else np.asarray(values[0])
