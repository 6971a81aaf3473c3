"""One load increment: the pressure problem, then the shear problem at that pressure."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from semi_analytical.energy import NOTHING_YET, Energy
from semi_analytical.model import ContactModel
from semi_analytical.pressing import NormalTarget, Pair, Pressing, press
from semi_analytical.sheared import Sheared, untouched
from semi_analytical.shearing import TangentialTarget
from semi_analytical.stick_slip import slip_and_stick

Field = NDArray[np.float64]


@dataclass(frozen=True)
class State:
    """Everything that the next increment needs of this one.

    target        the normal load that was reached
    normal_force  Σp times the cell area [force]
    pressing      pressure, normal displacement and approach
    sheared       the tangential part; None where no shear arises
    moment        (Σp y, Σp x) times the cell area [force length]; None where nothing tilts
    energy        since the start of the history; the march over the increments keeps the account
    rounds        of alternation between pressure and shear that it took; 0 without
    """

    target: NormalTarget
    normal_force: float
    pressing: Pressing
    sheared: Sheared | None
    moment: Pair | None = None
    energy: Energy = NOTHING_YET
    rounds: int = 0


def moment_of(model: ContactModel, pressure: Field) -> Pair:
    """(Σp y, Σp x) times the cell area [force length]."""
    M_x, M_y = np.sum(pressure * model.arms, axis=(1, 2)) * model.grid.cell_area
    return float(M_x), float(M_y)


def reached_moment(model: ContactModel, target: NormalTarget, pressure: Field) -> Pair | None:
    """The moment as it is given, or as the pressure has it; None where nothing tilts."""
    if target.tilting is None:
        return None
    return target.tilting.moment or moment_of(model, pressure)


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
    moment = reached_moment(model, normal, pressing.pressure)
    if tangential is None:
        return State(normal, normal_force, pressing, None, moment)
    last = before.sheared if before is not None else None
    sheared = slip_and_stick(
        model,
        pressing.pressure,
        last or untouched(model.grid.cells),
        tangential,
        tolerance,
    )
    return State(normal, normal_force, pressing, sheared, moment)
