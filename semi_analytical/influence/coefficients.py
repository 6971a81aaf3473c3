"""What influence coefficients are, and the sum of two bodies'."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field


class InfluenceCoefficients(Protocol):
    """Displacement at offset (i dx, j dy), i, j >= 0, by unit traction on the cell at the origin.

    First letter: displacement; second: traction [length^3/force]. Each has shape (nx, ny) and is
    computed when first asked for. Other quadrants follow by parity: zz, xx, yy are even in x and
    y, xy is odd in both, zx is odd in x and even in y, zy the reverse; by reciprocity xz = -zx,
    yz = -zy and yx = xy.
    """

    @property
    def zz(self) -> Field:
        """u_z by pressure."""

    @property
    def xx(self) -> Field:
        """u_x by q_x."""

    @property
    def yy(self) -> Field:
        """u_y by q_y."""

    @property
    def xy(self) -> Field:
        """u_x by q_y."""

    @property
    def zx(self) -> Field:
        """u_z by q_x."""

    @property
    def zy(self) -> Field:
        """u_z by q_y."""


@dataclass(frozen=True)
class Composite:
    """Relative displacement of bodies under equal and opposite tractions on the lower one.

    The upper body is the mirror image of a lower one in the contact plane: its normal-tangential
    terms change sign, all others add (F = F1 + J F2 J, J = diag(1, 1, -1)).

    lower, upper  the deformable bodies below and above the contact plane, at most one each
    along, down   displacement by a rig's springs, the same at all offsets [length^3/force]
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
        """u_z by pressure."""
        return self._added("zz") + self.down

    @cached_property
    def xx(self) -> Field:
        """u_x by q_x."""
        return self._added("xx") + self.along

    @cached_property
    def yy(self) -> Field:
        """u_y by q_y."""
        return self._added("yy") + self.along

    @cached_property
    def xy(self) -> Field:
        """u_x by q_y."""
        return self._added("xy")

    @cached_property
    def zx(self) -> Field:
        """u_z by q_x."""
        return self._mirrored("zx")

    @cached_property
    def zy(self) -> Field:
        """u_z by q_y."""
        return self._mirrored("zy")


def _total(bodies: tuple[InfluenceCoefficients, ...], component: str) -> Field:
    values = [getattr(body, component) for body in bodies]
    return np.sum(values, axis=0) if len(values) > 1 else np.asarray(values[0])
