"""A traction that only a table has: values at radii, linear between them, zero outside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

INTERVALS = 200  # of each part between two kinks


@dataclass(frozen=True, eq=False)
class RoundTable:
    """It stands for a `HalfEllipsoids` where no series of half-ellipsoids does.

    radii   from 0 to the edge [length]
    values  there [force/length²]
    """

    radii: Field
    values: Field

    def at(self, x: Field, y: Field) -> Field:
        """At positions [length]."""
        return np.interp(np.hypot(x, y), self.radii, self.values, right=0.0)

    @property
    def total(self) -> float:
        """Its integral over the surface [force]."""
        return self._integral(1)

    @property
    def spread(self) -> float:
        """The same, times the square of the distance from the axis [force*length²]."""
        return self._integral(3)

    @property
    def torque(self) -> float:
        """The same, times the distance: of a traction around the axis [force*length]."""
        return self._integral(2)

    def _integral(self, power: int) -> float:
        """2π ∫ q r^power dr by three points of Gauss, exact for a line times r³."""
        nodes, weights = np.polynomial.legendre.leggauss(3)
        width, middle = np.diff(self.radii), 0.5 * (self.radii[1:] + self.radii[:-1])
        r = middle[:, None] + 0.5 * width[:, None] * nodes
        q = np.interp(r, self.radii, self.values)
        return float(np.pi * np.sum(width[:, None] * weights * q * r**power))

    @property
    def semi_axes(self) -> tuple[float, float]:
        """The largest radius, twice [length]."""
        return float(self.radii[-1]), float(self.radii[-1])

    def document(self) -> dict[str, Any]:
        """As it is written for others."""
        return {"radii": self.radii.tolist(), "values": self.values.tolist()}


def tabulated(traction: Callable[[Field], Field], *kinks: float) -> RoundTable:
    """From a function of the radius, close where it is steep.

    kinks  radii where it or its slope jumps, the last is the edge [length]
    """
    crowded = 0.5 * (1 - np.cos(np.pi * np.arange(INTERVALS + 1) / INTERVALS))  # at both ends
    parts, start = [np.zeros(1)], 0.0
    for end in kinks:
        parts.append((start + (end - start) * crowded)[1:])
        start = end
    radii = np.concatenate(parts)
    return RoundTable(radii, traction(radii))
