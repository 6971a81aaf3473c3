"""One load increment: the pressure problem, then the shear problem at that pressure."""

from dataclasses import dataclass, replace

import numpy as np

from semi_analytical.model import ContactModel
from semi_analytical.pressing import NormalTarget, Pressing, press
from semi_analytical.shearing import TangentialTarget
from semi_analytical.stick_slip import Sheared, slip_and_stick, untouched


@dataclass(frozen=True)
class State:
    """Everything that the next increment needs of this one.

    target        the normal load that was reached
    normal_force  Σp times the cell area [force]
    pressing      pressure, normal displacement and approach
    sheared       the tangential part; None where no shear arises
    """

    target: NormalTarget
    normal_force: float
    pressing: Pressing
    sheared: Sheared | None


def solve_increment(
    model: ContactModel,
    before: State | None,
    normal: NormalTarget,
    tangential: TangentialTarget | None,
    tolerance: float,
) -> State:
    """The state at the end of an increment; `tangential` is None where no shear arises.

    raises  NotConverged, GrossSliding, ContactAtWindowEdge
    """
    if before is not None and before.target == normal:
        pressing = replace(before.pressing, iterations=0)
    else:
        pressing = press(model, normal, tolerance)
    normal_force = float(np.sum(pressing.pressure)) * model.grid.cell_area
    if tangential is None:
        return State(normal, normal_force, pressing, None)
    last = before.sheared if before is not None else None
    sheared = slip_and_stick(
        model,
        pressing.pressure,
        last or untouched(model.grid.cells),
        tangential,
        tolerance,
    )
    return State(normal, normal_force, pressing, sheared)
