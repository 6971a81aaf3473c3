"""Edge correction of the pressure and shear of a solved contact state.

The pressure of all bodies is corrected. The shear is corrected with a stick border that cuts cells
for uncoupled bodies only. The load stepping in `semi_analytical.history` calls `EdgeCorrection`.
"""

from dataclasses import replace

import numpy as np

from contact_scene.array_types import Field, Vector
from contact_scene.rig import compliances
from semi_analytical.edge.corrected import Corrected, CorrectedShear, EdgeReport
from semi_analytical.edge.displacement import Within
from semi_analytical.edge.subcell_tractions import SubcellTractions
from semi_analytical.edge_correction.operators import EdgeOperators
from semi_analytical.edge_correction.pressure import NotFitted, edge_pressure
from semi_analytical.edge_correction.shear import (
    EdgeShearProblem,
    edge_shear,
    grown_shear,
    sliding_shear,
)
from semi_analytical.edge_correction.shear_at_edge import FollowingShear
from semi_analytical.increments.increment import State
from semi_analytical.increments.tangential_state import (
    TangentialState,
    bulk_strain_displacement,
    rigid,
)
from semi_analytical.model import ContactModel


class EdgeCorrection:
    """Edge correction of the solved states of a contact model; the states are not modified.

    The correction adds the variation of tractions within cells along the edges of contact and stick
    zone.

    model    contact model: scene, grid, operators and symmetry reduction
    coupled  True if the normal and the tangential problem of the two bodies are coupled
    """

    def __init__(self, model: ContactModel, *, coupled: bool) -> None:
        self._domain, self._coupled = model.domain, coupled
        # The direction of slip at the edge of coupled bodies is found on the window.
        self._operators = EdgeOperators(model.on_window if coupled else model)

    def __call__(
        self, last: State | None, state: State, *, path_known: bool, tolerance: float
    ) -> Corrected | EdgeReport:
        """Correct the pressure and the shear of a solved state, or report the cause of a failure.

        last        earlier state, needed for the stick border of uncoupled bodies and for the reuse
                    of a correction; None before the first contact
        state       solved state with tractions that are uniform in each cell
        path_known  True if a single increment leads from `last` to `state`, or if the load path
                    between the two states has no effect
        tolerance   residual tolerance of the tangential solves
        """
        extended = self._extend_state(state)
        try:
            corrected = self._correct_pressure(last, state, extended)
        except NotFitted as cause:
            return EdgeReport(str(cause))
        sheared = extended.sheared
        if self._coupled or sheared is None:
            return corrected
        unloaded = not np.any(sheared.shear)
        if not unloaded and self._operators.model.friction.uniform is None:
            # The coefficient may jump between cells, so that no fit of the shear is reliable.
            return corrected
        free = unloaded or not np.any(sheared.in_stick)
        before = self._extend_state(last) if last and path_known else None
        if free or _determines_border(before, state, sheared):
            shear = self._correct_shear(before, sheared, corrected, tolerance)
            return replace(corrected, sheared=shear)
        if sheared.free is not None and path_known:
            return replace(corrected, sheared=self._correct_growth(before, extended, corrected))
        return corrected

    def _extend_state(self, state: State) -> State:
        """Extend the fields of a state from the reduced domain to the full window."""
        extend, sheared = self._domain.extend_fields, state.sheared
        tangential = None if sheared is None else extend(sheared)
        return replace(state, pressing=extend(state.pressing), sheared=tangential)

    def _correct_pressure(self, last: State | None, state: State, extended: State) -> Corrected:
        """Correct the pressure of a solved state for a contact edge that cuts cells.

        The correction of the previous state is reused if the bodies are uncoupled and both states
        have equal normal loads and pressures.

        last      previous state; None before the first contact
        state     solved state on the reduced domain
        extended  `state` with its fields on the full window
        """
        sheared, law, follows = extended.sheared, self._operators.model.friction, None
        if sheared is not None:
            p = extended.pressing.pressure
            follows = FollowingShear.from_state(law, p, sheared.shear, sheared.in_stick)
        known = last.corrected if last and last.target == state.target else None
        same = last is not None and np.array_equal(last.pressing.pressure, state.pressing.pressure)
        if not self._coupled and known and same:
            shear = None if follows is None else follows(known.pressure)
            return replace(known, shear=shear, sheared=None)
        solved = extended if self._coupled else state
        return edge_pressure(self._operators, solved, follows, coupled=self._coupled)

    def _correct_shear(
        self,
        before: State | None,
        solved: TangentialState,
        corrected: Corrected,
        tolerance: float,
    ) -> CorrectedShear | None:
        """Correct the shear of a solved state for a stick border that cuts cells.

        The friction limit is that of the corrected pressure. None is returned if the border of the
        stick zone cannot be fitted.

        before     earlier state that determines the border of the stick zone; may be None without
                   shear and in gross slip
        solved     tangential part of the solved state on the full window
        corrected  correction of the pressure of the solved state
        tolerance  residual tolerance of the tangential solves
        """
        model, edge = self._operators.model, corrected.edge
        bound = model.friction.limit(corrected.pressure)
        if not np.any(solved.shear):
            sticks = bool(np.any(solved.in_stick))  # all cells, or none without friction
            return replace(
                CorrectedShear.zero(bound.shape),
                shift=solved.shift,
                stick=(corrected.pressure > 0) & sticks,
                stick_cells=corrected.contact_cells if sticks else 0.0,
            )
        limit = _within_cells(bound, model.friction.limit(edge.parts), edge)
        if not np.any(solved.in_stick):
            return sliding_shear(self._operators, bound, limit, solved)
        assert before is not None
        assert before.sheared is not None
        assert before.corrected is not None
        last = before.corrected.sheared
        assert last is not None
        assert last.shift is not None
        slips = (bound > 0) & ~solved.in_stick
        if not np.any(slips):
            return None
        reversed_load = np.sum(last.slip * solved.shear * slips) < 0
        problem = EdgeShearProblem(
            operators=self._operators,
            bound=bound,
            limit=limit,
            force=solved.force,
            target=last.displacement
            - rigid(model, last.shift)
            - bulk_strain_displacement(model.on_window, solved.strain, before.sheared.strain),
            before=(last.shear, last.within),
            reversed_slip=last.slip if reversed_load else None,
            tolerance=tolerance,
        )
        return edge_shear(problem, solved, before.sheared.shear)

    def _correct_growth(
        self, before: State | None, state: State, corrected: Corrected
    ) -> CorrectedShear | None:
        """Correct the shear of a contact that has grown without slip to the corrected pressure.

        None is returned if a cell slips or the earlier state has no corrected shear.

        before     state from which the contact has grown; None before first contact
        state      solved state on the full window
        corrected  correction of the pressure of the solved state
        """
        assert state.sheared is not None
        if not np.array_equal(state.sheared.in_stick, state.pressing.pressure > 0):
            return None
        p, cells = corrected.pressure, corrected.pressure.shape
        own, was = _within_cells(p, corrected.edge.parts, corrected.edge), Within.zero(cells)
        last: CorrectedShear | None = CorrectedShear.zero(cells)
        start = before.corrected if before else None
        if before:
            last = start.sheared if start else None
        if last is None or last.shift is None:
            return None
        springs = compliances(self._operators.model.scene.rig)
        (W_0, T_0, d_0, s_0), (W, T, d, s) = (_bodies(one, springs) for one in (before, state))
        change, approach = p, corrected.approach - springs[0] * W
        if start:
            was = _within_cells(start.pressure, start.edge.parts, start.edge)
            change, approach = p - start.pressure, approach - start.approach + springs[0] * W_0
        # The shift of the bodies grows in proportion to their approach.
        shift = last.shift + (s - s_0) * approach / (d - d_0) + springs[1] * (T - T_0)
        whole = np.ones(cells)
        grown = Within.combine(own.slopes - was.slopes, [(whole, own), (-whole, was)])
        last = replace(last, shift=shift, stick=p > 0, stick_cells=corrected.contact_cells)
        return grown_shear(self._operators, last, (T - T_0) / (W - W_0), change, grown)


def _bodies(
    state: State | None, springs: tuple[float, float]
) -> tuple[float, Vector, float, Vector]:
    """Return normal and tangential force, approach and shift of a state, without springs of a rig.

    state    solved state; None before first contact
    springs  compliances of the test rig, normal and tangential [length/force]
    """
    if state is None:
        return 0.0, np.zeros(2), 0.0, np.zeros(2)
    assert state.sheared is not None
    assert state.sheared.shift is not None
    W, T = state.normal_force, state.sheared.force
    return W, T, state.pressing.approach - springs[0] * W, state.sheared.shift - springs[1] * T


def _within_cells(means: Field, parts: Field, edge: SubcellTractions) -> Within:
    """Compute the variation of a traction within cells on the full window,
    from its cell means (nx, ny) and subcell values along the edge (n, PARTS, PARTS)."""
    domain = edge.domain
    within = Within.from_subcells(domain.restrict(means), edge.i, edge.j, parts, domain)
    return within.extend_to_window(domain)


def _determines_border(before: State | None, state: State, sheared: TangentialState) -> bool:
    """Return True if an earlier state determines the border of the stick zone:
    it needs a corrected shear, a known shift, and the same normal load or no shear."""
    last = before.corrected.sheared if before and before.corrected else None
    if before is None or last is None or last.shift is None or sheared.shift is None:
        return False
    # At different pressures the relation between the stick borders is unknown.
    return before.target == state.target or not np.any(last.shear)
