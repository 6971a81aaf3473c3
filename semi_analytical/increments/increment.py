"""One load increment of uncoupled bodies: the normal problem, then the tangential problem."""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene import LoadRamp
from contact_scene.array_types import Field
from contact_scene.quantities.residuals import Residuals
from contact_solver.admissible_shear import magnitude
from contact_solver.conjugate_gradients import Point
from semi_analytical.edge.corrected import Corrected, EdgeReport
from semi_analytical.increments.energy import (
    NOTHING_YET,
    Energy,
)
from semi_analytical.increments.free_motion import growth_without_slip
from semi_analytical.increments.increment_history import (
    PreviousIncrement,
    further_fields,
    further_motion,
)
from semi_analytical.increments.normal_solve import NormalState, press
from semi_analytical.increments.normal_target import NormalTarget, Pair
from semi_analytical.increments.stick_slip import slip_and_stick
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import (
    TangentialState,
    untouched_state,
)
from semi_analytical.model import ContactModel


@dataclass(frozen=True)
class State:
    """Converged state of contact at the end of an increment, from which the next increment starts.

    target        prescribed normal load
    normal_force  normal force: Σp times the cell area [force]
    pressing      solution of the normal problem
    sheared       solution of the tangential problem; None without shear
    moment        moment (Σp y, Σp x) times the cell area [force length]; None without tilt
    energy        energies since the start of the history, added by the load stepping
    rounds        iterations of the coupled problem; 0 without coupling
    corrected     edge-corrected state, which later increments do not use; None where the correction
                  was not requested or not possible
    edge_report   outcome of the edge correction; None where it was not attempted
    behind        data of the previous increment for the predictor
    load          prescribed tangential load; None without shear
    """

    target: NormalTarget
    normal_force: float
    pressing: NormalState
    sheared: TangentialState | None
    moment: Pair | None = None
    energy: Energy = NOTHING_YET
    rounds: int = 0
    corrected: Corrected | None = None
    edge_report: EdgeReport | None = None
    behind: PreviousIncrement | None = None
    load: TangentialTarget | None = None

    def seen(self) -> PreviousIncrement | None:
        """Return the data of this state that the predictor of the next increments extrapolates.

        None is returned without shear, or if the tangential shift is undefined.
        """
        pressing, sheared = self.pressing, self.sheared
        if sheared is None or sheared.shift is None:
            return None
        return PreviousIncrement(
            target=self.target,
            pressure=pressing.pressure,
            shear=sheared.shear,
            displacement=sheared.displacement,
            force=sheared.force,
            shift=sheared.shift,
            torque=sheared.torque,
            twist=sheared.twist,
        )

    @property
    def iterations(self) -> int:
        """Sum of the iterations of the normal and the tangential solver in this increment."""
        return self.pressing.iterations + (self.sheared.iterations if self.sheared else 0)


def moment_of(model: ContactModel, pressure: Field) -> Pair:
    """Compute the moment (M_x, M_y) of a pressure about the origin [force length].

    The moment is (Σp y, Σp x) times the cell area.

    pressure  p (nx, ny) [force/length^2]
    """
    M_x, M_y = np.sum(pressure * model.arms, axis=(1, 2)) * model.grid.cell_area
    return float(M_x), float(M_y)


def reached_moment(model: ContactModel, target: NormalTarget, pressure: Field) -> Pair | None:
    """Return the moment (M_x, M_y) on the indenter at the end of an increment [force length].

    The result is the prescribed moment, or else the moment of the pressure. None is returned if the
    indenter does not tilt.

    target    prescribed normal load, with moment or tilt
    pressure  p (nx, ny) [force/length^2]
    """
    if target.moment is None and target.tilt is None:
        return None
    return target.moment or moment_of(model, pressure)


def residuals_of(model: ContactModel, state: State) -> Residuals:
    """Collect the residuals of a solved state: contact conditions, friction law and equilibrium.

    All residuals are dimensionless. The load stepping compares them with the tolerance.

    model  contact model
    state  state at the end of an increment
    """
    pressing, force = state.pressing, state.target.force
    pressed = Residuals(
        pressing.complementarity,
        pressing.penetration,
        None if force is None else abs(state.normal_force - force) / force,
        moment_equilibrium=_moment_equilibrium(model, state),
    )
    return pressed if state.sheared is None else pressed.with_shear(state.sheared.residuals)


def _moment_equilibrium(model: ContactModel, state: State) -> float | None:
    """Compute |Σp (y, x) Δ - M| / Σp r Δ for a prescribed moment M,
    with the distance r of a cell from the origin and its area Δ; None without M."""
    moment, p = state.target.moment, state.pressing.pressure
    if moment is None:
        return None
    missing = np.subtract(moment_of(model, p), moment)
    return float(np.hypot(*missing) / (np.sum(p * magnitude(model.arms)) * model.grid.cell_area))


def solve_increment(
    model: ContactModel,
    before: State | None,
    normal: NormalTarget,
    tangential: TangentialTarget | None,
    tolerance: float,
) -> State:
    """Solve one increment of uncoupled bodies: the normal problem, then the tangential problem.

    The normal problem determines the pressure, the tangential problem the shear at this pressure.
    The normal problem is not solved again if its load is unchanged.

    model       contact model
    before      state at the start of the increment; None before first contact
    normal      prescribed normal load
    tangential  prescribed tangential load; None without shear
    tolerance   residual tolerance of both problems
    raises      NotConverged, GrossSliding, ContactAtWindowEdge, ContactNotResolved
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
    seen = before.seen() if before is not None else None
    ahead = behind = None
    if before is not None and seen is not None and seen.target == normal:
        further = further_fields(seen, before.behind, tangential)
        motion = further_motion(seen, before.behind, tangential)
        ahead, behind = (Point(further.shear, further.displacement), motion), seen
    last = last or untouched_state(model.grid.cells)
    free = None
    if last.shift is not None and not (before is not None and before.target == normal):
        start = before.pressing if before is not None else None
        growth = growth_without_slip(model, last, tangential, start, pressing)
        if growth is not None:
            point, shift, free = growth
            ahead = point, tangential.rigid_motion(shift, last.twist)
    sheared = slip_and_stick(model, pressing.pressure, last, tangential, tolerance, ahead, free)
    return State(normal, normal_force, pressing, sheared, moment, behind=behind)


def normal_target(
    ramp: LoadRamp, start: State | None, fraction: float, tilts: bool
) -> NormalTarget:
    """Return the normal load that a load step prescribes at the end of an increment.

    The prescribed force or approach changes linearly along the load step (ramp).

    ramp      controls of the load step
    start     state at the start of the load step; None before first contact
    fraction  completed fraction of the ramp at the end of the increment, 0 to 1
    tilts     True to include the prescribed tilt or moment
    """
    reached = (0.0, 0.0) if start is None else (start.normal_force, start.pressing.approach)
    force, approach = ramp.normal.prescribed(fraction, reached)
    if not tilts:
        return NormalTarget(force, approach)
    turned: tuple[Pair, Pair] = ((0.0, 0.0), (0.0, 0.0))
    if start is not None:
        turned = start.moment or turned[0], start.pressing.tilt or turned[1]
    return NormalTarget(force, approach, *ramp.tilting.prescribed(fraction, turned))


def tangential_target(
    ramp: LoadRamp, start: State | None, fraction: float, twists: bool
) -> TangentialTarget:
    """Return the tangential load that a load step prescribes at the end of an increment.

    The prescribed force or shift changes linearly along the load step (ramp). Bulk strain is
    included.

    ramp      controls of the load step
    start     state at the start of the load step; None before first contact
    fraction  completed fraction of the ramp at the end of the increment, 0 to 1
    twists    True to include the prescribed twist or torque
    """
    sheared = start.sheared if start is not None else None
    reached: tuple[Pair, Pair | None] = ((0.0, 0.0), (0.0, 0.0))
    if sheared is not None:
        reached = (
            _float_pair(sheared.force),
            None if sheared.shift is None else _float_pair(sheared.shift),
        )
    force, shift = ramp.tangential.prescribed(fraction, reached)
    torque = twist = None
    if twists:
        turned = (sheared.torque or 0.0, sheared.twist or 0.0) if sheared else (0.0, 0.0)
        torque, twist = ramp.twisting.prescribed(fraction, turned)
    return TangentialTarget(
        None if force is None else np.array(force),
        None if shift is None else np.array(shift),
        torque,
        twist,
        ramp.strain(fraction),
    )


def _float_pair(vector: np.ndarray) -> Pair:
    x, y = map(float, vector)
    return x, y
