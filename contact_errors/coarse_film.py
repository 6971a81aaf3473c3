"""What elements leave open below a film that is thin for them.

A stiff film presses most at its rim, on a seam that is as wide as the film bends: elements wider
than that carry what it carries on one ring or spread it, whichever the mesh brings about, and two
meshes may do so alike. What slips there is a seam, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from contact_errors.values import LOST, LOST_IN_CYCLE
from contact_scene import Scene
from fem_reference import Increment

Numbers = NDArray[np.float64]

LEAST_LAYER = 2.0  # elements over the thickness: with fewer a film is thin
# A film so many times as stiff as what it lies on bends over that.
BENDS = 3.0
# Of the largest pressure over the elements of the contact radius: what a mesh whose rim carries no
# peak leaves in it, .027 on 8 to 64 elements (E1/E2 = 100, h = .01 a).
BESIDE_RIM = 0.03
# Of the energy lost over the elements of the slip annulus: .9 to 1.6 below films of E1/E2 = 10 and
# 100, h = .01 and .03 a, with µ = 1, on 8 to 32 elements and rings of the same increments.
OF_SLIP = 1.6
LEAST_ANNULUS = 0.5


@dataclass(frozen=True)
class CoarseFilm:
    """A state on so many elements over the thinnest layer.

    layer       infinite without one
    per_length  elements over a length
    stiff       whether a layer bends over what is below it and presses most at its rim
    rubbed      whether friction acts back on the pressure
    """

    layer: float
    per_length: float
    stiff: bool
    rubbed: bool

    @classmethod
    def of(cls, scene: Scene, per_length: float, rubbed: bool) -> CoarseFilm:
        """That of a scene."""
        stiff = any(
            upper.young_modulus > BENDS * lower.young_modulus
            for body in (scene.body, scene.indenter)
            for upper, lower in pairwise(body.elastic_materials)
        )
        thinnest = min(scene.body.thinnest, scene.indenter.thinnest)
        return cls(per_length * thinnest, per_length, stiff, rubbed)

    @property
    def is_thin(self) -> bool:
        """Whether the elements are coarse against it."""
        return self.layer < LEAST_LAYER

    def hides(self, name: str) -> bool:
        """Whether a number hangs on what elements do not see of the film."""
        if not self.is_thin:
            return False
        return name in (LOST, LOST_IN_CYCLE) or (name == "peak_pressure" and self.stiff)

    def left(self, name: str, end: Increment, largest: Numbers) -> Numbers | None:
        """Error of a number that the film hides; None where nothing bounds it: rings that friction
        loads in turn may miss most of what the rim of a stiff film carries, and those that see no
        slip nearly all of what is lost."""
        if name != "peak_pressure":
            stick = 0.0 if end.stick_radius is None else end.stick_radius
            annulus = self.per_length * (end.contact_radius - stick)
            return None if annulus < LEAST_ANNULUS else OF_SLIP / annulus * largest
        if self.rubbed:
            return None
        beside = BESIDE_RIM / (self.per_length * end.contact_radius) * largest
        return np.maximum(beside, self._on_rim(end))

    def _on_rim(self, end: Increment) -> float:
        """Pressure at the rim beyond the largest inside, which elements cannot tell from a film
        that stands on its rim [pressure]."""
        inside = end.radii < end.contact_radius - LEAST_LAYER / self.per_length
        if not np.any(inside):
            return 0.0
        return end.peak_pressure - float(np.max(end.pressure[inside]))
