"""One load increment in which pressure moves the surfaces sideways, and shear opens no gap.

The approximation of Goodman (1962): the pressure is that without friction, so one pass does it,
pressure first. It is good where Dundurs' beta is small, and it has a closed form for indentation.
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
    """The state at the end of an increment: its pressure, then the shear on surfaces that this
    pressure has moved.

    raises  NotConverged, GrossSliding, ContactAtWindowEdge, ContactNotResolved
    """
    assert tangential is not None
    pressed = solve_increment(model, before, normal, None, tolerance)
    last = before.sheared if before is not None and before.sheared is not None else None
    last = last or untouched(model.grid.cells)
    p = pressed.pressing.pressure
    u_by_p = model.operator(p.shape).tangential_by_pressure(p)
    # The shear problem knows displacement by shear alone: what pressure adds now, the state
    # before has less of.
    moved = replace(last, displacement=last.displacement - u_by_p)
    sheared = slip_and_stick(model, p, moved, tangential, tolerance)
    return replace(pressed, sheared=replace(sheared, displacement=sheared.displacement + u_by_p))
