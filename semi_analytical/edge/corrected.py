"""A state whose tractions have their edges inside the cells."""

from dataclasses import dataclass

from contact_scene.array_types import Field, Mask
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.subcell_tractions import SubcellTractions


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
    stick: Mask
    stick_cells: float
    change: float


@dataclass(frozen=True)
class EdgeReport:
    """Outcome of the edge correction of a state: relative changes in its last iteration.

    cause     for which the state could not be corrected; None where it is corrected
    response  of the approach, or of the normal force where the approach is prescribed
    peak      of the largest pressure
    radius    of the contact radius
    ridge     whether the peak lies on a ridge, not on a cap
    border    whether the stick border of uncoupled bodies is corrected, too, or there is none
    """

    cause: str | None = None
    response: float = 0.0
    peak: float = 0.0
    radius: float = 0.0
    ridge: bool = False
    border: bool = True


@dataclass(frozen=True)
class Corrected:
    """A state with its edges inside the cells; fields on the whole window.

    pressure       (nx, ny) its mean over each cell, also over those that the contact reaches into
                   from outside their centre [force/length^2]
    peak           the largest pressure at a point [force/length^2]
    gap            (nx, ny) at the centres of the cells [length]
    approach       of the bodies [length]
    contact_cells  area of the contact in cells
    change         of the pressure in the last iteration, Σ|Δp|/Σp
    edge           the pressure in the cells along the edge of the contact
    report         changes in the last iteration
    tilt           of the indenter (x, y); None where nothing tilts
    shear          (2, nx, ny) that follows the pressure [force/length^2]; None without friction
    sheared        the tangential part with the border of stick inside the cells; None where bodies
                   couple, without shear, or where that border is not fitted
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
