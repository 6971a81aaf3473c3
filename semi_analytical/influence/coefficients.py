"""Interface of influence coefficients, and their combination for two bodies in contact."""

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from contact_scene.array_types import Field

# Parity along x and y of each component: 1 even, -1 odd. A component names displacement and
# traction: "zx" is the normal displacement by a unit shear q_x, "xy" the displacement u_x by q_y.
PARITY = {
    "zz": (1, 1),
    "xx": (1, 1),
    "yy": (1, 1),
    "xy": (-1, -1),
    "zx": (-1, 1),
    "zy": (1, -1),
}


class InfluenceCoefficients(Protocol):
    """Displacement of a surface cell centre by a unit traction on one cell, for all cell offsets.

    The offsets (i dx, j dy), i, j >= 0, point from the loaded cell to the displaced cell. Other
    offsets follow from PARITY. By Maxwell-Betti reciprocity u_x by unit pressure is minus u_z by
    unit q_x.
    """

    def __getitem__(self, component: str) -> Field:
        """Return one component of the influence coefficients at all cell offsets (nx, ny)
        [length^3/force].

        component  displacement and traction, e.g. "zx" for the normal displacement by the shear q_x
        """


@dataclass(frozen=True)
class Composite:
    """Influence coefficients of the relative displacement of two bodies under opposite tractions.

    lower, upper  influence coefficients of each body; empty for a rigid body
    along, down   rigid tangential and normal displacement of all cells by a unit traction on one
                  cell, due to the springs of a test rig [length^3/force]
    """

    lower: tuple[InfluenceCoefficients, ...]
    upper: tuple[InfluenceCoefficients, ...]
    along: float = 0.0
    down: float = 0.0
    _known: dict[str, Field] = field(default_factory=dict, init=False, repr=False, compare=False)

    def __getitem__(self, component: str) -> Field:
        """Return one component of the influence coefficients of two bodies at all cell offsets (nx,
        ny).

        The coefficients are relative displacements per unit traction on one cell [length^3/force].
        They are stored after the first call.

        component  displacement and traction, e.g. "zx" for the normal displacement by the shear q_x
        """
        if component not in self._known:
            self._known[component] = self._combined(component)
        return self._known[component]

    def _combined(self, component: str) -> Field:
        """Add the coefficients (nx, ny) of both bodies and of the springs.
        The coupling of the upper body has the opposite sign, because its z axis points upwards."""
        sign = -1.0 if component in ("zx", "zy") else 1.0
        bodies = [body[component] for body in self.lower]
        bodies += [sign * body[component] for body in self.upper]
        spring = {"zz": self.down, "xx": self.along, "yy": self.along}.get(component, 0.0)
        return np.asarray(np.sum(bodies, axis=0) + spring)
