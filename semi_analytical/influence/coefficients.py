"""Protocol of influence coefficients, and their sum over two bodies."""

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field


class InfluenceCoefficients(Protocol):
    """Displacement at offset (i dx, j dy), i, j >= 0, by unit traction on the cell at the origin.

    The first letter of a name is the displacement, the second the traction [length^3/force]. Each
    array has shape (nx, ny) and is computed on first use. Other quadrants follow by parity: zz, xx,
    yy are even in x and y; xy is odd in x and y; zx is odd in x, even in y; zy is even in x, odd in
    y. Reciprocity yields xz = -zx, yz = -zy and yx = xy.
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
    """Relative displacement of two bodies under equal and opposite tractions.

    The upper body is a lower body mirrored in the contact plane: its normal-tangential terms change
    sign, F = F1 + J F2 J with J = diag(1, 1, -1). Tractions are those on the lower body.

    lower, upper  coefficients of the deformable bodies, at most one each
    along, down   displacement by the springs of a rig, equal at all offsets [length^3/force]
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
