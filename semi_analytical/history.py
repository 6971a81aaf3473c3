"""Load stepping of the semi-analytical solver: increments, energies, edge correction."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from contact_scene import LoadRamp
from contact_scene.array_types import Field
from contact_scene.checks.line_contact import lacks_reference
from contact_scene.quantities.per_length import OF_REFERENCE
from contact_scene.quantities.summary import ContactStatus
from contact_scene.rig import add_contact_displacements
from contact_scene.stepping.checkpoint import (
    Checkpoint,
    ResumePoint,
)
from contact_scene.stepping.load_stepping import (
    ConvergedIncrement,
    resumable_increments,
)
from semi_analytical.edge.contact_area import covered_cells
from semi_analytical.edge.corrected import Corrected, EdgeReport
from semi_analytical.fields import Increment
from semi_analytical.increments.energy import NOTHING_YET, pressed_work
from semi_analytical.increments.energy_balance import add_energies
from semi_analytical.increments.increment import (
    State,
    normal_target,
    reached_moment,
    residuals_of,
    solve_increment,
    tangential_target,
)
from semi_analytical.increments.normal_target import (
    NormalTarget,
    plane,
)
from semi_analytical.increments.tangential_solve import TangentialTarget
from semi_analytical.increments.tangential_state import (
    TangentialState,
    untouched_state,
)
from semi_analytical.model import ContactModel
from semi_analytical.plan import Coupling, Plan

Advance = Callable[
    [ContactModel, State | None, NormalTarget, TangentialTarget | None, float], State
]


class Correct(Protocol):
    """Interface of the edge correction of pressure and shear in a solved contact state.

    The correction accounts for contact edges inside cells. A call returns the corrected state, or a
    report of the reason why a correction is impossible. `EdgeCorrection` implements the interface.
    """

    def __call__(
        self, last: State | None, state: State, *, path_known: bool, tolerance: float
    ) -> Corrected | EdgeReport: ...


# Convolutions above which an increment that does not converge is not bisected. In the stability map
# (µ = 5, modulus ratios of film and base from 1/1000 to 1000) the most expensive increment that
# converges takes 5 700.
MAX_CONVOLUTIONS = 30_000


def solve_history(
    model: ContactModel, plan: Plan, tolerance: float, since: Checkpoint | None = None
) -> Iterator[tuple[Increment, ResumePoint[State]]]:
    """Solve the load history of a contact model; yield the converged increments.

    Each increment is accompanied by a state from which the solution can be resumed later.

    model, plan  contact model, and physical effects to compute
    tolerance    limit of all dimensionless residuals
    since        checkpoint from which to resume; None to start at the beginning
    raises       NotConverged and GrossSliding, with the last converged increment as `last_state`
    """
    solver = _Solver(model, plan, _increment_solver(plan), _edge_correction(model, plan), tolerance)
    return resumable_increments(model.scene, plan.increments, solver, since)


def _increment_solver(plan: Plan) -> Advance:
    """Return the solver of one increment for the coupling;
    a solver that is not required is not imported."""
    if plan.coupling is Coupling.NONE:
        return solve_increment
    from semi_analytical.coupled.coupled_increment import solve_coupled_increment

    return solve_coupled_increment


def _edge_correction(model: ContactModel, plan: Plan) -> Correct | None:
    if plan.edge == "off":
        return None
    from semi_analytical.edge_correction.correction import EdgeCorrection

    return EdgeCorrection(model, coupled=plan.couples)


@dataclass(frozen=True)
class _Solver:
    """Solver of single increments of a contact model, as called by the load stepping.

    The cost of an increment is counted in convolutions.

    model      contact model of the scene on a grid
    plan       physical effects to compute, such as friction and coupling
    increment  function that solves one increment
    correct    edge correction (contact edges inside cells); None without one
    tolerance  limit of all dimensionless residuals
    """

    model: ContactModel
    plan: Plan
    increment: Advance
    correct: Correct | None
    tolerance: float

    @property
    def most_spent(self) -> float:
        """Work above which an increment that does not converge is given up.

        The work is a number of convolutions. Below this limit, load stepping bisects such an
        increment.
        """
        return MAX_CONVOLUTIONS

    def spent(self) -> float:
        """Return the work since the start of the solution: the number of convolutions.

        Load stepping compares the work of an increment with its limit.
        """
        return self.model.convolutions.count

    def advance(
        self, ramp: LoadRamp, start: State | None, before: State | None, fraction: float
    ) -> State:
        """Solve for the contact state at a fraction of a load ramp, with its energies.

        The edge correction is added if the plan requires it for this increment.

        ramp      controls of the load step
        start     state at the start of the load step; None before first contact
        before    state of the previous increment; None before first contact
        fraction  completed fraction of the ramp at the end of the increment, 0 to 1
        """
        normal = normal_target(ramp, start, fraction, self.plan.tilt)
        tangential = None
        if self.plan.shear:
            tangential = tangential_target(ramp, start, fraction, self.plan.torsion)
        after = self.increment(self.model, before, normal, tangential, self.tolerance)
        residuals_of(self.model, after).require(self.tolerance, "the increment", after.iterations)
        matters = self.plan.path[ramp.step - 1].path_matters
        after = add_energies(self.model, before, after, path_matters=matters)
        after = replace(after, load=tangential)
        if self.correct is None or (self.plan.edge == "last" and fraction < 1):
            return after
        stepwise = self.plan.edge == "last" and not self.plan.couples
        last = start if stepwise else before
        edges = self.correct(
            last,
            after,
            path_known=last is before or not matters,
            tolerance=self.tolerance,
        )
        if isinstance(edges, EdgeReport):
            return replace(after, edge_report=edges)
        stick: float | None = 0.0
        if not self.plan.couples and after.sheared is not None:
            if edges.sheared is not None:
                stick = edges.sheared.radius_left
            elif np.any(after.sheared.in_stick):
                stick = None
        return replace(after, corrected=edges, edge_report=replace(edges.report, stick=stick))

    def undeformed_gap(self, last: Increment, tilt: Any) -> Field:
        """Compute the gap of the undeformed surfaces on the full window at a tilt [length].

        The approach is 0. Load stepping uses the gap for separated bodies.

        last  last increment; not used
        tilt  tilt of the indenter (φ_x, φ_y); None without tilt
        """
        closure = 0.0 if tilt is None else plane(self.model, tilt)
        return self.model.domain.extend(self.model.gap - closure)

    def report(self, reached: ConvergedIncrement[State], last: Increment | None) -> Increment:
        """Convert a converged state to an increment of the results.

        The increment contains changes since the last increment, such as the slip and the number of
        convolutions.

        reached  converged state with its place in the load history
        last     preceding increment of the results; None for the first
        """
        before, after = reached.before, reached.state
        held = before is not None and before.target == after.target
        spreads = self.plan.coupling is not Coupling.NONE or not held
        ends = reached.place.index == reached.place.increments_in_step
        fits = self.plan.areas == "all" or ends or after.corrected is not None
        increment = _reported_increment(self.model, last, reached, spreads=spreads, fits=fits)
        if self.plan.stiffness and ends:
            from semi_analytical.stiffness import contact_stiffness

            found: dict[str, Any] = contact_stiffness(self.model, before, after, reached.place.step)
            increment = replace(increment, **found)
        scene = self.model.scene
        if lacks_reference(scene.indenter, scene.body):
            unknown: dict[str, Any] = dict.fromkeys(OF_REFERENCE)
            return replace(increment, **unknown)
        return add_contact_displacements(increment, scene.rig)


def _reported_increment(
    model: ContactModel,
    last: Increment | None,
    reached: ConvergedIncrement[State],
    *,
    spreads: bool,
    fits: bool,
) -> Increment:
    """Convert a converged state to an increment of the results, with all fields on the full window.

    Changes and cost are those since the last increment.

    model    contact model
    last     preceding increment of the results; None for the first
    reached  converged state with its place in the load history
    spreads  True if the stick zone may have grown; determines the power laws of the shear that are
             fitted at the border of the stick zone
    fits     False to count whole cells as the areas of contact and stick zone
    """
    state, extend, before = reached.state, model.domain.extend_fields, reached.before
    pressing, sheared = extend(state.pressing), extend(state.sheared) if state.sheared else None
    p, cell = pressing.pressure, model.window.cell_area
    gap = model.gap + state.pressing.displacement - state.pressing.closure(model)
    force, tilt = state.target.force, pressing.tilt
    pressed = Increment(
        **vars(reached.place),
        pressure=p,
        gap=model.domain.extend(gap),
        normal_force=state.normal_force if force is None else force,
        approach=pressing.approach,
        moment=None if state.moment is None else np.array(state.moment),
        tilt=None if tilt is None else np.array(tilt),
        contact_area=(_contact_cells(model, state) if fits else np.count_nonzero(p)) * cell,
        peak_pressure=float(np.max(p)),
        elastic_energy=state.energy.elastic,
        input_work=state.energy.stored_and_dissipated,
        unresolved_work=state.energy.left_open,
        energy_imbalance=state.energy.imbalance(before.energy if before else NOTHING_YET),
        residuals=residuals_of(model, state),
        iterations=state.iterations,
        halvings=reached.halvings,
        rounds=state.rounds,
        convolutions=int(np.ceil(reached.spent)),
        edge_report=state.edge_report,
    )
    if state.corrected is not None:
        pressed = _apply_edge_correction(pressed, state, state.corrected, model)
    if sheared is None:
        return pressed
    stuck = float(np.count_nonzero(sheared.in_stick))
    if fits:
        stuck, sheared, pressed = _stick_zone(
            model, p, sheared, state.corrected, pressed, spreads=spreads
        )
    steps = model.scene.loading[: reached.place.step]
    controls = [step for step in steps if step.tangential_force or step.tangential_shift]
    shifted = controls and controls[-1].tangential_shift is not None
    grown = sheared.free is not None and state.corrected and state.corrected.sheared
    if state.corrected and shifted and (grown or not np.any(sheared.in_stick)):
        # Without slip, and without stick zone, shear and force follow the corrected pressure.
        sheared = replace(sheared, force=np.sum(sheared.shear, axis=(1, 2)) * cell)
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
        # Independent fits of both areas may differ by their errors.
        stick_area=pressed.contact_area
        if sheared.status is ContactStatus.FULL_STICK and fits
        else min(stuck * cell, pressed.contact_area),
        dissipated_energy=sheared.dissipated_energy,
        dissipation_uncertainty=state.energy.uncertain,
    )
    return _add_slip(increment, last, sheared)


def _contact_cells(model: ContactModel, state: State) -> float:
    """Compute the contact area of a state in cells of the window, with subcell accuracy.

    A contact of all cells inside the rim of an indenter has the area of the rim.

    model  contact model
    state  converged state, with the edge-corrected state if there is one
    """
    if state.corrected is not None:
        return state.corrected.contact_cells
    p, domain, rim = state.pressing.pressure, model.domain, model.scene.indenter.rim
    if rim is not None and np.array_equal(p > 0, np.isfinite(model.gap)):
        area = 2 * rim if model.window.of_strips else np.pi * rim**2
        return float(area / model.window.cell_area)
    return domain.images * covered_cells(p, p > 0, domain)


def _apply_edge_correction(
    increment: Increment, state: State, corrected: Corrected, model: ContactModel
) -> Increment:
    """Replace pressure, gap, approach and energy of an increment by the edge-corrected values.

    The part of the shear in the elastic energy and the dissipation are not corrected.

    increment  increment of the results before the correction
    state      converged state, before the correction
    corrected  edge-corrected state, with contact edges inside cells
    model      contact model
    """
    p, tilt, cell, target = corrected.pressure, corrected.tilt, model.window.cell_area, state.target
    moment = reached_moment(model, target, p)
    closure = replace(state.pressing, approach=corrected.approach, tilt=tilt).closure(model)
    displacement = np.where(np.isfinite(model.gap), closure - model.gap, 0.0)
    gained = (
        0.5
        * cell
        * (
            pressed_work(p, model.domain.extend(displacement))
            - float(
                np.sum(model.domain.extend(state.pressing.pressure * state.pressing.displacement))
            )
        )
    )
    work, open_work = increment.input_work, increment.unresolved_work
    return replace(
        increment,
        pressure=p,
        gap=corrected.gap,
        normal_force=float(np.sum(p)) * cell if target.force is None else target.force,
        approach=corrected.approach,
        moment=None if moment is None else np.array(moment),
        tilt=None if tilt is None else np.array(tilt),
        peak_pressure=corrected.peak,
        edge_change=corrected.change,
        elastic_energy=state.energy.elastic + gained,
        input_work=None if work is None else work + gained,
        unresolved_work=None if open_work is None else open_work - gained,
    )


def _stick_zone(
    model: ContactModel,
    p: Field,
    sheared: TangentialState,
    corrected: Corrected | None,
    increment: Increment,
    *,
    spreads: bool,
) -> tuple[float, TangentialState, Increment]:
    """Compute the stick area of a state as a number of cells, with subcell accuracy.

    Return the area, the tangential state with edge-corrected shear, and the increment. Force, shift
    and their work are not corrected.

    p          pressure of the cells without edge correction (nx, ny)
    sheared    tangential state on the full window
    corrected  edge-corrected state; None without one
    increment  increment of the results
    spreads    True if the stick zone may have grown; determines the power laws of the shear that
               are fitted at the border of the stick zone
    """
    border = corrected.sheared if corrected else None
    if corrected is not None and border is not None:
        sheared = replace(sheared, shear=border.shear, in_stick=border.stick)
        change = max(corrected.change, border.change)
        return border.stick_cells, sheared, replace(increment, edge_change=change)
    from semi_analytical.edge_correction.stick_area import stick_area

    limit = model.friction.limit(p)
    stuck = stick_area(sheared.shear, limit, sheared.in_stick, spreads=spreads, domain=model.domain)
    if corrected is None or corrected.shear is None:
        return stuck, sheared, increment
    stick = sheared.in_stick & (corrected.pressure > 0)
    return stuck, replace(sheared, shear=corrected.shear, in_stick=stick), increment


def _add_slip(increment: Increment, last: Increment | None, sheared: TangentialState) -> Increment:
    """Return an increment of the results with slip, slip distance and dissipation of its state.

    The increment is returned unchanged if the tangential shift is undefined.

    increment  increment of the results, without slip
    last       preceding increment of the results, with slip and dissipation at the start
    sheared    tangential state at the end of the increment
    """
    if sheared.dissipated_energy is None:
        return increment
    nothing = untouched_state(sheared.in_stick.shape)
    slip = last.slip if last else None
    dissipation = last.dissipation if last else None
    traced = replace(
        increment,
        slip_before=nothing.slip if slip is None else slip,
        slip_distance=sheared.slip_distance,
        dissipation=sheared.dissipation,
        dissipation_before=nothing.dissipation if dissipation is None else dissipation,
    )
    lost, slipped = traced.dissipation_increment, traced.slip_increment
    return replace(
        traced,
        largest_dissipation_increment=None if lost is None else float(np.max(lost)),
        largest_slip_increment=None if slipped is None else float(np.max(np.hypot(*slipped))),
    )
