"""One load increment under Goodman's approximation (1962): one-way coupling.

The pressure is that of the frictionless contact. The pressure displaces the surfaces tangentially,
but shear does not change the gap. The approximation is good for a small Dundurs constant β, and has
a closed form for indentation.
"""

from dataclasses import replace

from semi_analytical.increments.increment import (
    State,
    solve_increment,
)
from semi_analytical.increments.normal_solve import NormalTarget
from semi_analytical.increments.stick_slip import slip_and_stick
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import untouched
from semi_analytical.model import ContactModel


def solve_one_way_increment(
    model: ContactModel,
    before: State | None,
    normal: NormalTarget,
    tangential: TangentialTarget | None,
    tolerance: float,
) -> State:
    """Solve one increment with one-way coupling: the frictionless normal problem, then the
    tangential one.

    The tangential problem includes the tangential displacement caused by the pressure.

    before  state at the start of the increment; None before first touch
    raises  NotConverged, GrossSliding, ContactAtWindowEdge, ContactNotResolved
    """
    assert tangential is not None
    pressed = solve_increment(model, before, normal, None, tolerance)
    last = before.sheared if before is not None and before.sheared is not None else None
    last = last or untouched(model.grid.cells)
    p = pressed.pressing.pressure
    u_by_p = model.operator(p.shape).tangential_by_pressure(p)
    # The tangential problem includes the displacement by shear alone: that by the new pressure is
    # subtracted from the displacement of the previous state.
    moved = replace(last, displacement=last.displacement - u_by_p)
    sheared = slip_and_stick(model, p, moved, tangential, tolerance)
    return replace(pressed, sheared=replace(sheared, displacement=sheared.displacement + u_by_p))
