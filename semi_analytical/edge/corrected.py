"""A state whose tractions have their edges inside the cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]


@dataclass(frozen=True)
class Corrected:
    """What a state would be with its edges inside the cells; fields on the whole window.

    pressure       (nx, ny) its mean over each cell, also over those that the contact reaches into
                   from outside their centre [force/length^2]
    gap            (nx, ny) at the centres of the cells [length]
    approach       of the bodies [length]
    contact_cells  area of the contact in cells
    change         of the pressure in the last round, Σ|Δp|/Σp
    """

    pressure: Field
    gap: Field
    approach: float
    contact_cells: float
    change: float
