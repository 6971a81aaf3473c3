"""March through a load history: state, increment, state."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene import ControlKind, LoadRamp, NormalControl, TangentialControl
from semi_analytical.contact_area import stuck_cells
from semi_analytical.errors import GrossSliding, NotConverged, SolverError
from semi_analytical.fields import Increment
from semi_analytical.increment import State, solve_increment
from semi_analytical.model import ContactModel
from semi_analytical.plan import Plan
from semi_analytical.pressing import NormalTarget
from semi_analytical.residuals import Residuals
from semi_analytical.shearing import TangentialTarget

Vector = NDArray[np.float64]
Advance = Callable[
    [ContactModel, State | None, NormalTarget, TangentialTarget | None, float], State
]

MOST_HALVINGS = 4


def march(model: ContactModel, plan: Plan, tolerance: float) -> Iterator[Increment]:
    """Increments of the scene's load path, one after the other.

    raises  NotConverged and GrossSliding, with the last converged State as `last_state`
    """
    advance = _advance(plan)
    state: State | None = None
    for ramp, count in zip(model.scene.load_path(), plan.increments, strict=True):
        path = _Path(model, ramp, state, plan.shear, advance, tolerance)
        begin = 0.0
        for index, end in enumerate(_fractions(model, ramp, count), start=1):
            counted = model.convolutions.count
            try:
                state, halvings = path.reach(state, begin, end, MOST_HALVINGS)
            except SolverError as error:
                error.where = f"step {ramp.step}, increment {index} of {count}"
                raise
            increment = _increment(model, state, ramp.step, index, count)
            yield replace(
                increment,
                halvings=halvings,
                convolutions=int(np.ceil(model.convolutions.count - counted)),
            )
            begin = end


def _advance(plan: Plan) -> Advance:
    """How one increment is solved: the coupled solver is not even imported where it is not
    needed."""
    if not plan.coupling:
        return solve_increment
    from semi_analytical.coupled_increment import solve_coupled_increment

    return solve_coupled_increment


@dataclass(frozen=True)
class _Path:
    """The loads along one ramp, from the state at its start."""

    model: ContactModel
    ramp: LoadRamp
    start: State | None
    shear: bool
    advance: Advance
    tolerance: float

    def reach(
        self, state: State | None, begin: float, end: float, halvings_left: int
    ) -> tuple[State, int]:
        """The state at fraction `end`, in two halves where one increment does not converge, and
        the number of halvings that took."""
        try:
            normal = _normal_at(self.ramp.normal, self.start, end)
            tangential = None
            if self.shear:
                tangential = _tangential_at(self.ramp.tangential, self.start, end)
            return self.advance(self.model, state, normal, tangential, self.tolerance), 0
        except NotConverged as error:
            if halvings_left == 0:
                error.last_state = state
                raise
        except SolverError as error:
            error.last_state = state
            raise
        middle = 0.5 * (begin + end)
        state, first = self.reach(state, begin, middle, halvings_left - 1)
        state, second = self.reach(state, middle, end, halvings_left - 1)
        return state, 1 + first + second


def _fractions(model: ContactModel, ramp: LoadRamp, count: int) -> list[float]:
    """Where in the ramp the increments end: uniform in contact radius while the normal load
    grows from zero, uniform in load otherwise."""
    exponent = None
    if ramp.normal.start == 0:
        indenter = model.scene.indenter
        by_force = ramp.normal.kind is ControlKind.FORCE
        exponent = indenter.load_exponent if by_force else indenter.approach_exponent
    return [(k / count) ** (exponent or 1) for k in range(1, count + 1)]


def _normal_at(control: NormalControl, start: State | None, fraction: float) -> NormalTarget:
    begin = control.start
    if control.kind is ControlKind.FORCE:
        if begin is None:
            assert start is not None
            begin = start.normal_force
        return NormalTarget(force=_ramp(begin, control.end, fraction))
    if begin is None:
        assert start is not None
        begin = start.pressing.approach
    return NormalTarget(approach=_ramp(begin, control.end, fraction))


def _ramp(begin: float, end: float, fraction: float) -> float:
    """Exactly `end` at the end and wherever nothing changes, so that equal loads are equal."""
    return end if fraction == 1 or begin == end else begin + (end - begin) * fraction


def _tangential_at(
    control: TangentialControl, start: State | None, fraction: float
) -> TangentialTarget:
    by_force = control.kind is ControlKind.FORCE
    begin = None if control.start is None else np.array(control.start)
    if begin is None:
        # Taking over from the other control: ramp from where that one has led.
        sheared = start.sheared if start is not None else None
        reached = None if sheared is None else sheared.force if by_force else sheared.shift
        if sheared is not None and reached is None:
            raise GrossSliding(
                "the step before reached the friction limit under force control, where the shift "
                "is undefined; end that step below the limit"
            )
        begin = np.zeros(2) if reached is None else reached
    end = np.array(control.end)
    value = np.array([_ramp(b, e, fraction) for b, e in zip(begin, end, strict=True)])
    return TangentialTarget(force=value) if by_force else TangentialTarget(shift=value)


def _increment(model: ContactModel, state: State, step: int, index: int, count: int) -> Increment:
    """The state as it is reported."""
    pressing, sheared, cell = state.pressing, state.sheared, model.grid.cell_area
    p = pressing.pressure
    force = state.target.force
    residuals = Residuals(
        pressing.complementarity,
        pressing.penetration,
        None if force is None else abs(state.normal_force - force) / force,
    )
    pressed = Increment(
        step=step,
        index=index,
        increments_in_step=count,
        pressure=p,
        gap=model.gap + pressing.displacement - pressing.approach,
        normal_force=state.normal_force if force is None else force,
        approach=pressing.approach,
        contact_area=pressing.covered_cells * cell,
        peak_pressure=float(np.max(p)),
        residuals=residuals,
        iterations=pressing.iterations,
        convolutions=0,
    )
    if sheared is None:
        return pressed
    bound = model.friction_coefficient * p
    stuck = stuck_cells(sheared.shear, bound, sheared.in_stick) * cell
    return replace(
        pressed,
        residuals=replace(residuals, **vars(sheared.residuals)),
        iterations=pressing.iterations + sheared.iterations,
        status=sheared.status,
        shear=sheared.shear,
        slip=sheared.slip,
        in_stick=sheared.in_stick,
        tangential_force=sheared.force,
        tangential_shift=sheared.shift,
        # Both areas are fitted on their own; where all sticks they may cross by their errors.
        stick_area=min(stuck, pressed.contact_area),
        dissipated_energy=sheared.dissipated_energy,
    )
