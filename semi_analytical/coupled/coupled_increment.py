"""One load increment of bodies whose normal and tangential problems are coupled."""

from dataclasses import dataclass, replace

import numpy as np

from contact_scene.array_types import Field, Mask, Vector, VectorField
from contact_scene.quantities.residuals import worst
from contact_scene.solver_errors import NotConverged, motion_undefined
from contact_solver.coupled_problem import CoupledProblem, CoupledSolution
from contact_solver.globalisation import solve_together
from contact_solver.residuals import complementarity, penetration
from contact_solver.shear import ShearSolution
from semi_analytical.increments.full_slip import (
    force_reaches_limit,
    gross_slip_state,
    loads_reach_limit,
)
from semi_analytical.increments.increment import (
    State,
    reached_moment,
)
from semi_analytical.increments.increment_history import further_fields, further_motion
from semi_analytical.increments.normal_solve import (
    MARGIN,
    NormalState,
    refuse_contact_at_edge,
    refuse_unresolved_contact,
    rough_initial_guess,
)
from semi_analytical.increments.normal_target import NormalTarget
from semi_analytical.increments.stick_slip import (
    end_state,
    frictionless_state,
    shear_residuals,
)
from semi_analytical.increments.tangential_solve import (
    TangentialTarget,
)
from semi_analytical.increments.tangential_state import (
    TangentialState,
    rigid,
    surface_target,
    untouched_state,
)
from semi_analytical.model import ContactModel
from semi_analytical.operator.box import (
    Box,
    box_around,
)
from semi_analytical.operator.domain import ReducedDomain
from semi_analytical.operator.points import (
    InverseOnCells,
    fields_of,
    map_of_points,
    points_of,
    shear_inverse_in,
)

MAX_ATTEMPTS = 4
# Patches along the shorter side of a box: more make Newton's method stall, fewer cost iterations.
PATCHES = 40
# Margin of the box over the width of the contact; a tangential load step moves the edge by less.
RELATIVE_MARGIN = 1 / 32


def solve_coupled_increment(
    model: ContactModel,
    before: State | None,
    normal: NormalTarget,
    tangential: TangentialTarget | None,
    tolerance: float,
) -> State:
    """Solve one increment of bodies whose normal and tangential problems are coupled.

    The increment is solved in a box of cells around the contact. The residuals are then computed on
    the whole domain with new convolutions.

    model               contact model
    before              state at the start of the increment; None before first contact
    normal, tangential  prescribed loads at the end of the increment
    tolerance           limit of all dimensionless residuals
    raises              NotConverged, GrossSliding, ContactAtWindowEdge, ContactNotResolved
    """
    assert tangential is not None
    refuse_unresolved_contact(model, normal)
    last = before.sheared if before is not None and before.sheared is not None else None
    last = last or untouched_state(model.grid.cells)
    slides = False
    if tangential.force is not None and tangential.torque is None and normal.force is not None:
        carried = model.friction.largest_tangential_force(normal.force)
        slides = carried is not None and force_reaches_limit(tangential.force, carried)
    if last.shift is None:
        if not slides:
            raise motion_undefined()
        last = replace(last, shift=np.zeros(2))  # has no effect on gross slip
    start, shear, iterations = _initial_guess(model, before, last, normal, tangential)
    box = _box_with_margin((start > 0) | (last.shear[0] != 0), model.domain)
    aim, residual = tolerance, np.inf
    motion = tangential.rigid_motion(last.shift, last.twist)
    if before is not None and (seen := before.seen()):
        motion = further_motion(seen, before.behind, tangential)
    for _ in range(MAX_ATTEMPTS):
        problem = coupled_problem(model, box, last, normal, tangential)
        inside = (..., *box.slices)
        solution = solve_together(
            problem,
            points_of(start[box.slices]),
            points_of(shear[inside]),
            tangential.scaled(model, motion),
            0.8 * aim,
        )
        iterations += solution.iterations
        trial = _Trial(model, last, normal, tangential, box, solution, iterations)
        state, g = trial.whole_state()
        assert state.sheared is not None
        residual = worst(
            state.pressing.complementarity,
            state.pressing.penetration,
            state.sheared.residuals.worst,
        )
        if residual <= tolerance:
            refuse_contact_at_edge(state.pressing.pressure, model)
            return state if before is None else replace(state, behind=before.seen())
        start, shear = state.sheared.pressure, state.sheared.shear
        overlap_outside = (g < 0) & ~box.mask(model.grid.cells)
        if np.any(overlap_outside):
            box = _box_with_margin((start > 0) | overlap_outside, model.domain)
        else:
            aim *= 0.1
    raise NotConverged("the coupled increment", iterations, residual, tolerance)


def _box_with_margin(cells: Mask, domain: ReducedDomain) -> Box:
    """Return the smallest box around cells, with a margin into which the contact may grow."""
    nx, ny = (int(np.count_nonzero(np.any(cells, axis=axis))) for axis in (1, 0))
    widest = max(domain.window((nx, ny)))
    return box_around(cells, max(MARGIN, round(RELATIVE_MARGIN * widest)), domain)


def _initial_guess(
    model: ContactModel,
    before: State | None,
    last: TangentialState,
    normal: NormalTarget,
    tangential: TangentialTarget,
) -> tuple[Field, VectorField, int]:
    """Return guesses of pressure and shear, and iterations spent: extrapolated at constant
    normal load, otherwise a rough frictionless pressure and the shear of the previous increment."""
    if before is not None and (seen := before.seen()) and seen.target == normal:
        further = further_fields(seen, before.behind, tangential)
        return further.pressure, further.shear, 0
    start, iterations = rough_initial_guess(model, normal)
    return start, last.shear, iterations


def coupled_problem(
    model: ContactModel,
    box: Box,
    last: TangentialState,
    normal: NormalTarget,
    tangential: TangentialTarget,
    free: VectorField | None = None,
) -> CoupledProblem:
    """Assemble operators, loads and friction law of a coupled increment in a box of cells.

    model               contact model
    box                 box of cells in which the increment is solved
    last                tangential state at the start of the increment
    normal, tangential  prescribed loads at the end of the increment
    free                free motion of cells before their contact (2, nx, ny) [length]; None without
    """
    shape, operator = box.shape, model.operator(box.shape)
    target = surface_target(model, last, tangential, free)

    def limit(p: Vector) -> Vector:
        return points_of(model.friction_limit(p.reshape(shape), box.first))

    def slope(p: Vector) -> Vector:
        return points_of(model.friction_slope(p.reshape(shape), box.first))

    precondition = map_of_points(operator.precondition, shape)
    return CoupledProblem(
        normal=map_of_points(operator.normal, shape),
        tangential=map_of_points(operator.tangential, shape),
        normal_by_shear=map_of_points(operator.normal_by_shear, shape),
        shear_by_pressure=map_of_points(operator.tangential_by_pressure, shape),
        inverse_on=lambda contact: precondition,
        inverse_in=shear_inverse_in(operator, shape, model.self_compliance),
        together=map_of_points(operator.together, shape),
        inverse=InverseOnCells(operator.inverse, model.self_compliance, shape),
        gap=points_of(normal.gap(model)[box.slices]),
        friction_limit=limit,
        friction_slope=slope,
        target=points_of(target[(..., *box.slices)]),
        closing=normal.motions(model, box),
        shifting=tangential.motions(model, box),
        self_compliance=model.self_compliance,
        patch=max(1.0, min(model.domain.window(shape)) / PATCHES),
        images=model.domain.images,
    )


@dataclass(frozen=True)
class _Trial:
    """Solution of an increment in a box of cells, as a candidate for the state of the whole domain.

    The residuals of the candidate are evaluated on the whole domain. The candidate is accepted if
    they meet the tolerance.

    model               contact model
    last                tangential state at the start of the increment
    normal, tangential  prescribed loads at the end of the increment
    box                 cells on which the increment was solved
    solution            solution in the box
    iterations          iterations of all attempts
    """

    model: ContactModel
    last: TangentialState
    normal: NormalTarget
    tangential: TangentialTarget
    box: Box
    solution: CoupledSolution
    iterations: int

    @property
    def _motion(self) -> Vector:
        """Shift of the indenter (2,) [length], or shift and twist (3,) under a torque."""
        return self.tangential.unscaled(self.model, self.solution.motion)

    def whole_state(self) -> tuple[State, Field]:
        """Build the contact state on the whole domain from the solution in a box of cells.

        Tractions are zero outside the box. Displacements, slip and residuals are computed for all
        cells. Return the state, and its gap (nx, ny) [length].
        """
        model, solution, cells = self.model, self.solution, self.model.grid.cells
        shape = self.box.shape
        p = self.box.embed(solution.pressure.reshape(shape), cells)
        q = self.box.embed(solution.shear.reshape(2, *shape), cells)
        u = model.operator(cells).together(np.concatenate([q, p[None]]))
        u_t, u_z = u[:2], u[2]
        gap = self.normal.gap(model)
        pressing = self.normal.problem(model, Box.whole(cells))
        g = gap + u_z - fields_of(pressing.closure(solution.closing), cells)
        overlap = pressing.overlap(solution.closing)
        approach, tilt = self.normal.reached(model, solution.closing)
        pressed = NormalState(
            pressure=p,
            displacement=u_z,
            approach=approach,
            complementarity=complementarity(p, g, overlap),
            penetration=penetration(g, overlap),
            iterations=self.iterations,
            tilt=tilt,
        )
        normal_force = float(np.sum(p)) * model.grid.cell_area
        moment = reached_moment(model, self.normal, p)
        sheared = self._tangential_state(p, q, u_t)
        rounds = self.solution.outer_iterations
        return State(self.normal, normal_force, pressed, sheared, moment, rounds=rounds), g

    def _tangential_state(self, p: Field, q: VectorField, u_t: VectorField) -> TangentialState:
        """Build the tangential state on the whole domain from the solution in a box of cells.

        The state contains slip, stick zone, dissipation and residuals at the end of the increment.

        p    pressure (nx, ny) [force/length^2]
        q    shear (2, nx, ny) [force/length^2]
        u_t  tangential surface displacement by pressure and shear (2, nx, ny) [length]
        """
        model, solution, cells = self.model, self.solution, self.model.grid.cells
        bound = model.friction_limit(p)
        if solution.at_limit:
            return self._gross_slip(p, bound, u_t)
        # In full stick without tangential load the displacements by pressure and shear cancel, and
        # u_t is no scale for slip. The scale is then the displacement by the shear alone, or the
        # maximum of |u_t| (contact in a single cell).
        moved = u_t
        if not np.any(solution.in_slip):
            moved = np.maximum(np.abs(model.operator(cells).tangential(q)), np.max(np.abs(u_t)))
        in_slip = solution.in_slip.reshape(self.box.shape)
        shearing = ShearSolution(
            shear=q,
            displacement=moved,
            motion=self._motion,
            in_slip=self.box.embed(in_slip.astype(np.float64), cells) > 0,
            residual=0.0,
            iterations=0,
        )
        target = surface_target(model, self.last, self.tangential)
        passed = rigid(model, self._motion) + target - u_t
        residuals = shear_residuals(model, shearing, bound, passed, self.tangential, self.last)
        after = end_state(model, p, bound, self.last, self.tangential, shearing, passed, residuals)
        return replace(after, displacement=u_t)

    def _gross_slip(self, p: Field, bound: Field, u_t: VectorField) -> TangentialState:
        """Return the state at the friction limit `bound` of the pressure p, or without
        friction at u_t. Raise GrossSliding if a prescribed force or torque exceeds the limit."""
        model, last, load = self.model, self.last, self.tangential
        loads_reach_limit(model, bound, load)
        if np.any(bound):
            return replace(gross_slip_state(model, p, last, load), displacement=u_t)
        return frictionless_state(model, p, u_t, last, load, self._motion)
