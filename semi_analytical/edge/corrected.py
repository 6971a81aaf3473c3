"""Results of the edge correction of a contact state: pressure, shear and their errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from contact_scene.array_types import Field, Mask
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.subcell_tractions import SubcellTractions


@dataclass(frozen=True)
class CorrectedShear:
    """Shear after the edge correction, with a border of the stick zone that cuts cells.

    All fields are on the full window.

    shear         mean of the shear over each cell (2, nx, ny) [force/length^2]
    within        variation within the cells, of the components x and y
    slip          direction of the shear in the slip zone, extended to the other cells (2, nx, ny)
    displacement  relative tangential displacement of the surfaces at the cell centres (2, nx, ny)
                  [length]
    shift         tangential shift of the indenter (2,) [length]; None at the friction limit in
                  force control
    stick         cells whose centre sticks (nx, ny)
    stick_cells   area of the stick zone in cells
    change        relative change of the shear in the last iteration, Σ|Δq|/Σµp
    radius_left   relative error of the stick radius due to the finite number of iterations
    """

    shear: Field
    within: tuple[Within, Within]
    slip: Field
    displacement: Field
    shift: Field | None
    stick: Mask
    stick_cells: float
    change: float = 0.0
    radius_left: float = 0.0

    @classmethod
    def zero(cls, cells: tuple[int, ...]) -> CorrectedShear:
        """Return the state without shear, shift and stick zone.

        cells  number of cells along x and y
        """
        nothing, constant = np.zeros((2, *cells)), Within.zero(cells)
        return cls(
            shear=nothing,
            within=(constant, constant),
            slip=nothing,
            displacement=nothing,
            shift=np.zeros(2),
            stick=np.zeros(cells, dtype=bool),
            stick_cells=0.0,
        )


@dataclass(frozen=True)
class EdgeReport:
    """Outcome of the edge correction of a state: cause of a failure, or errors of the iteration.

    All errors are relative and are caused by the finite number of iterations.

    cause     reason why the state is not corrected; None for a corrected state
    response  error of the approach, or of the normal force at a prescribed approach
    peak      error of the largest pressure
    radius    error of the contact radius
    stick     error of the stick radius; None if the stick border of uncoupled bodies remains
              uncorrected
    ridge     True if the largest pressure lies on a ridge, False if the pressure falls in all
              directions
    """

    cause: str | None = None
    response: float = 0.0
    peak: float = 0.0
    radius: float = 0.0
    stick: float | None = 0.0
    ridge: bool = False


@dataclass(frozen=True)
class Corrected:
    """Contact state after the edge correction, with a contact edge that cuts cells.

    All fields are on the full window.

    pressure       mean over each cell, also over partly covered cells whose centre is outside the
                   contact (nx, ny) [force/length^2]
    peak           largest pressure at a point [force/length^2]
    gap            gap at the cell centres (nx, ny) [length]
    approach       approach of the bodies [length]
    contact_cells  area of the contact in cells
    change         relative change of the pressure in the last iteration, Σ|Δp|/Σp
    edge           pressure in the subcells of the cells along the contact edge
    report         errors due to the finite number of iterations
    tilt           tilt of the indenter (x, y); None for an indenter that does not tilt
    shear          shear at the corrected pressure (2, nx, ny) [force/length^2]; None without
                   friction
    sheared        shear with a stick border that cuts cells; None for coupled bodies, without
                   shear, or if the border cannot be fitted
    """

    pressure: Field
    peak: float
    gap: Field
    approach: float
    contact_cells: float
    change: float
    edge: SubcellTractions
    report: EdgeReport
    tilt: tuple[float, float] | None = None
    shear: Field | None = None
    sheared: CorrectedShear | None = None
