"""A state whose tractions have their edges inside the cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from semi_analytical.edge.displacement import Within
from semi_analytical.edge.rim import AlongEdge

Field = NDArray[np.float64]


@dataclass(frozen=True)
class CorrectedShear:
    """The tangential part; fields on the whole window.

    shear         (2, nx, ny) its mean over each cell [force/length^2]
    within        what it is within the cells, along x and y
    slip          (2, nx, ny) its direction where cells slip, and there nearest to where they stick
    displacement  (2, nx, ny) u_t at the centres of the cells [length]
    shift         (2,) of the indenter [length]; None at the friction limit under force control
    stick         (nx, ny) cells whose centre sticks
    stick_cells   area of the stick zone in cells
    change        of the shear in the last round, Σ|Δq|/Σµp
    """

    shear: Field
    within: tuple[Within, Within]
    slip: Field
    displacement: Field
    shift: Field | None
    stick: NDArray[np.bool_]
    stick_cells: float
    change: float


@dataclass(frozen=True)
class Corrected:
    """What a state would be with its edges inside the cells; fields on the whole window.

    pressure       (nx, ny) its mean over each cell, also over those that the contact reaches into
                   from outside their centre [force/length^2]
    peak           the largest pressure at a point [force/length^2]
    gap            (nx, ny) at the centres of the cells [length]
    approach       of the bodies [length]
    contact_cells  area of the contact in cells
    change         of the pressure in the last round, Σ|Δp|/Σp
    edge           what the pressure is in the cells along that of the contact
    tilt           of the indenter (x, y); None where nothing tilts
    sheared        the tangential part; None where no shear arises
    """

    pressure: Field
    peak: float
    gap: Field
    approach: float
    contact_cells: float
    change: float
    edge: AlongEdge
    tilt: tuple[float, float] | None = None
    sheared: CorrectedShear | None = None
