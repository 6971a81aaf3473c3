"""Contacts of the paper's ball that others have computed: a row of a reference, over Hertz's."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from verification.problems.paper_scene import HERTZ

Field = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class TabulatedContact:
    """Numbers of a contact, and profiles at a few radii.

    row  of the reference: numbers relative to Hertz's contact of the substrate
    """

    row: Mapping[str, Any]

    @property
    def contact_radius(self) -> float:
        """[length]."""
        return float(self.row["a_over_aH"]) * HERTZ.contact_radius

    @property
    def approach(self) -> float:
        """[length]."""
        return float(self.row["delta_over_deltaH"]) * HERTZ.approach

    @property
    def friction(self) -> float:
        """µ."""
        return float(self.row["mu"])

    @property
    def radii(self) -> Field:
        """Distances from the axis at which profiles are given [length]."""
        return np.array(self.row["r_over_a"]) * self.contact_radius

    def pressure(self, r: Field) -> Field:
        """At the radii of the row, and linear between [force/length²]."""
        return np.interp(r, self.radii, np.array(self.row["p_over_pH"]) * HERTZ.peak_pressure)

    def shear(self, r: Field) -> Field:
        """Outward, at the radii of the row, and linear between [force/length²]."""
        limit = self.friction * HERTZ.peak_pressure
        return np.interp(r, self.radii, np.array(self.row["q_over_mu_pH"]) * limit)

    def size_of_shear(self, r: Field) -> Field:
        """Of either sign [force/length²]."""
        return np.abs(self.shear(r))
