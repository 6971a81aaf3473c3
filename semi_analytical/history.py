"""March through a load history: state, increment, state."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from contact_scene import ControlKind, LoadRamp
from contact_scene.solver_errors import NotConverged, SolverError
from contact_scene.standing import Mark
from semi_analytical.balance import balanced
from semi_analytical.contact_area import stuck_cells
from semi_analytical.energy import NOTHING_YET
from semi_analytical.fields import Increment
from semi_analytical.increment import State, residuals_of, solve_increment
from semi_analytical.load_targets import normal_target, tangential_target
from semi_analytical.model import ContactModel
from semi_analytical.plan import Coupling, Plan
from semi_analytical.pressing import NormalTarget
from semi_analytical.sheared import Sheared, untouched
from semi_analytical.shearing import TangentialTarget

Vector = NDArray[np.float64]
VectorField = NDArray[np.float64]
Advance = Callable[
    [ContactModel, State | None, NormalTarget, TangentialTarget | None, float], State
]

MOST_HALVINGS = 4
# An increment that has taken more without converging is not cut any further. The last attempt that
# fails before the halves converge is over after at most 17 200 in the stability map.
MOST_CONVOLUTIONS = 30_000


def march(model: ContactModel, plan: Plan, tolerance: float) -> Iterator[Increment]:
    """Increments of the scene's load path, one after the other; raises what `marked` raises."""
    return (increment for increment, _ in marked(model, plan, tolerance))


def marked(
    model: ContactModel, plan: Plan, tolerance: float, since: Mark[State] | None = None
) -> Iterator[tuple[Increment, Mark[State]]]:
    """Increments of the scene's load path, each with the mark from which the march can go on.

    since   a mark of the same march, to begin after it
    raises  NotConverged and GrossSliding, with the last converged State as `last_state`
    """
    advance = _advance(plan)
    state = since.state if since else None
    done = 0
    for ramp, count in zip(model.scene.load_path(), plan.increments, strict=True):
        behind = since.within(done, count) if since else 0
        start = since.start if since and 0 < behind < count else state
        path = _Path(model, ramp, start, plan, advance, tolerance)
        fractions = [0.0, *_fractions(model, ramp, count)]
        done += behind
        begin = fractions[behind]
        for index, end in enumerate(fractions[behind + 1 :], start=behind + 1):
            counted, before = model.convolutions.count, state
            try:
                until = counted + MOST_CONVOLUTIONS
                state, halvings = path.reach(state, begin, end, MOST_HALVINGS, until)
            except SolverError as error:
                error.where = f"step {ramp.step}, increment {index} of {count}"
                raise
            increment = _increment(model, before, state, ramp.step, index, count)
            increment = replace(
                increment,
                halvings=halvings,
                rounds=state.rounds,
                convolutions=int(np.ceil(model.convolutions.count - counted)),
            )
            begin, done = end, done + 1
            yield increment, Mark(done, state, start)


def _advance(plan: Plan) -> Advance:
    """How one increment is solved: a solver that is not needed is not even imported."""
    if plan.coupling is Coupling.NONE:
        return solve_increment
    if plan.coupling is Coupling.ONE_WAY:
        from semi_analytical.one_way_increment import solve_one_way_increment

        return solve_one_way_increment
    from semi_analytical.coupled_increment import solve_coupled_increment

    return solve_coupled_increment


@dataclass(frozen=True)
class _Path:
    """The loads along one ramp, from the state at its start."""

    model: ContactModel
    ramp: LoadRamp
    start: State | None
    plan: Plan
    advance: Advance
    tolerance: float

    def reach(
        self, state: State | None, begin: float, end: float, halvings_left: int, until: float
    ) -> tuple[State, int]:
        """The state at fraction `end`, in two halves where one increment does not converge, and
        the number of halvings that took; none after a count `until` of convolutions."""
        try:
            normal = normal_target(self.ramp, self.start, end, self.plan.tilt)
            tangential = None
            if self.plan.shear:
                tangential = tangential_target(self.ramp, self.start, end, self.plan.torsion)
            after = self.advance(self.model, state, normal, tangential, self.tolerance)
            residuals = residuals_of(self.model, after)
            residuals.require(self.tolerance, "the increment", after.iterations)
            return balanced(self.model, state, after), 0
        except NotConverged as error:
            if halvings_left == 0 or self.model.convolutions.count > until:
                error.last_state = state
                raise
        except SolverError as error:
            error.last_state = state
            raise
        middle = 0.5 * (begin + end)
        state, first = self.reach(state, begin, middle, halvings_left - 1, until)
        state, second = self.reach(state, middle, end, halvings_left - 1, until)
        return state, 1 + first + second


def _fractions(model: ContactModel, ramp: LoadRamp, count: int) -> list[float]:
    """Where in the ramp the increments end: uniform in contact radius while the normal load
    grows from zero, uniform in load otherwise."""
    exponent = None
    if ramp.normal.start == 0:
        exponent = model.scene.indenter.gap_exponent
        if exponent is not None and ramp.normal.kind is ControlKind.FORCE:
            exponent += 1
    return [(k / count) ** (exponent or 1) for k in range(1, count + 1)]


def _increment(
    model: ContactModel, before: State | None, state: State, step: int, index: int, count: int
) -> Increment:
    """The state as it is reported, with what the increment from the state before has changed."""
    pressing, sheared, cell = state.pressing, state.sheared, model.grid.cell_area
    p = pressing.pressure
    force, tilt = state.target.force, pressing.tilt
    pressed = Increment(
        step=step,
        index=index,
        increments_in_step=count,
        pressure=p,
        gap=model.gap + pressing.displacement - pressing.closure(model),
        normal_force=state.normal_force if force is None else force,
        approach=pressing.approach,
        moment=None if state.moment is None else np.array(state.moment),
        tilt=None if tilt is None else np.array(tilt),
        contact_area=pressing.covered_cells * cell,
        peak_pressure=float(np.max(p)),
        elastic_energy=state.energy.elastic,
        input_work=state.energy.input_work,
        unresolved_work=state.energy.unresolved,
        energy_imbalance=state.energy.imbalance(before.energy if before else NOTHING_YET),
        residuals=residuals_of(model, state),
        iterations=state.iterations,
        convolutions=0,
    )
    if sheared is None:
        return pressed
    bound = model.friction_coefficient * p
    stuck = stuck_cells(sheared.shear, bound, sheared.in_stick) * cell
    increment = replace(
        pressed,
        status=sheared.status if model.scene.friction else pressed.status,
        shear=sheared.shear,
        slip=sheared.slip,
        in_stick=sheared.in_stick,
        tangential_force=sheared.force,
        tangential_shift=sheared.shift,
        torque=sheared.torque,
        twist=sheared.twist,
        # Both areas are fitted on their own; where all sticks they may cross by their errors.
        stick_area=min(stuck, pressed.contact_area),
        dissipated_energy=sheared.dissipated_energy,
    )
    return _traced(increment, before, sheared)


def _traced(increment: Increment, before: State | None, sheared: Sheared) -> Increment:
    """With what slip leaves on the surface and had left there before the increment; nothing where
    the motion is undefined."""
    if sheared.dissipated_energy is None:
        return increment
    last = before.sheared if before is not None else None
    last = last or untouched(sheared.in_stick.shape)
    traced = replace(
        increment,
        slip_before=last.slip,
        slip_distance=sheared.slip_distance,
        dissipation=sheared.dissipation,
        dissipation_before=last.dissipation,
    )
    lost, slipped = traced.dissipation_increment, traced.slip_increment
    return replace(
        traced,
        largest_dissipation_increment=None if lost is None else float(np.max(lost)),
        largest_slip_increment=None if slipped is None else float(np.max(np.hypot(*slipped))),
    )
