"""States of the contact surface from results on cells, for the evaluation of the laws of contact.

A state contains tractions, gap, slip and loads of one increment, in a form that is common to all
solvers.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from contact_scene.array_types import Field
from contact_scene.friction import FRICTIONLESS
from semi_analytical import Increment, Result
from verification.observed.contact_state import (
    BISECTED,
    CORRECTED,
    TINY,
    UNDEFINED,
    Balance,
    ContactState,
)
from verification.observed.ring_errors import is_corrected

# Accepted energy error of the edge correction over (h/a)²: ten times that of a point contact.
EDGES = 0.125
# Factor on the change of the edge correction if the edge of the stick zone is not fitted. The shear
# then follows the corrected pressure in the cells along the edge, about 1/10 of the contact, and
# the tangential force has the error of these cells.
BORDER = 10.0
# Tolerance of the inner solves of the edge correction, over its change.
INNER = 0.1


def states_on_cells(result: Result) -> list[ContactState]:
    """Collect the state of the contact surface at the end of each increment of a result on cells.

    With the edge correction, complementarity and the balance of the tangential force hold only to
    the last change of the correction. Slip and energies are those before the correction.
    """
    undeformed = result.scene.indenter.initial_gap(*result.grid.coordinates())
    before_touch = _motion_before_touch(result.increments[0], undeformed)
    states, before, grown, defined = list[ContactState](), None, False, True
    for now in result.increments:
        state = _state_on_cells(now, before, result, undeformed, before_touch)
        if now.shear is not None:
            defined &= now.dissipated_energy is not None
            grown |= bool(
                now.halvings
                if before is None
                else np.any((now.pressure > 0) & (before.pressure == 0))
            )
        skipped = BISECTED if now.halvings else CORRECTED if is_corrected(now) else ""
        if not defined:
            state = replace(state, passed=None)
            skipped = UNDEFINED
        edges = is_corrected(now) or (before is not None and is_corrected(before))
        side = max(result.grid.spacing) / now.contact_radius if now.contact_radius else 1.0
        states.append(
            replace(
                state,
                coarse=max(1.0, EDGES * side**2 / result.tolerance) if edges else 1.0,
                unseen=skipped if now.shear is not None else "",
                open="" if skipped == CORRECTED else skipped,
                told=grown,
            )
        )
        before = now
    return states


def _state_on_cells(
    now: Increment, before: Increment | None, result: Result, undeformed: Field, before_touch: Field
) -> ContactState:
    (x, y), grid, p = result.grid.coordinates(), result.grid, now.pressure
    friction = (result.scene.friction or FRICTIONLESS).on_grid(grid.cells, grid.spacing)
    nothing = np.zeros((2, *p.shape))
    q = nothing if now.shear is None else now.shear
    slip = nothing if now.slip is None else now.slip
    shift = (0.0, 0.0) if now.tangential_shift is None else now.tangential_shift
    tilt = (0.0, 0.0) if now.tilt is None else now.tilt
    xx, yy = (0.0, 0.0) if now.bulk_strain is None else now.bulk_strain
    area, limit = grid.cell_area, friction.limit(p)
    # Conjugate to force, tangential forces, moments, torque and strains of the lower body.
    arms = (p, q[0], q[1], p * y, p * x, q[1] * x - q[0] * y, q[0] * x, q[1] * y)
    forces = area * np.array([*map(np.sum, arms), np.sum(q[0] * y + q[1] * x)])
    approach = now.approach
    assert approach is not None  # a line contact has a reference length
    motions = [approach, *shift, *tilt, now.twist or 0.0, -xx, -yy, -(now.bulk_shear or 0.0)]
    # A tilted indenter may be in contact although its axis is higher than at first contact.
    lowered = (approach + tilt[0] * y + tilt[1] * x)[p > 0]
    change = now.edge_change or 0.0

    def balance(carried: Field, due: object, most: Field, times: float) -> Balance:
        eased = result.tolerance / max(result.tolerance, times * change)
        return Balance(carried, due, float(np.sum(most)) * area, eased)

    arm, balances = np.hypot(x, y), [balance(forces[0], now.normal_force, p, 0.0)]
    if now.moment is not None:
        balances.append(balance(forces[3:5], now.moment, p * arm, 0.0))
    if now.shear is not None and np.any(limit):
        fitted = now.edge_report is None or now.edge_report.stick is not None
        force = now.tangential_force
        balances.append(balance(forces[1:3], force, limit, INNER if fitted else BORDER))
        if now.torque is not None:
            balances.append(balance(forces[5], now.torque, limit * arm, 0.0))
    return ContactState(
        now,
        np.full_like(p, area),
        undeformed,
        p,
        now.gap,
        q,
        limit,
        slip,
        slip + before_touch,
        forces,
        np.array(motions),
        float(np.max(np.abs(lowered), initial=abs(approach))),
        tuple(balances),
        tuple(_stated_differences(before, now, area)),
        eased=result.tolerance / max(result.tolerance, change),
    )


def _stated_differences(before: Increment | None, now: Increment, area: float) -> list[float]:
    """Compare the dissipated energy and the slip distance of an increment with sums over its fields
    [1].

    Returns the relative difference of the dissipated energy, and the largest difference between the
    growth of the accumulated slip distance and the change of the slip. The list is empty if a field
    is missing.

    before  preceding increment; None for the first
    now     increment
    area    area of a cell [length²]
    """
    lost, way, slip = now.dissipated_energy, now.slip_distance, now.slip
    if lost is None or way is None or slip is None or now.dissipation is None:
        return []
    longest = max(float(np.max(way)), TINY)
    if before is not None and before.slip_distance is not None and before.slip is not None:
        way, slip = way - before.slip_distance, slip - before.slip
    shorter = (np.hypot(*slip) - way) / longest  # the distance is never below |change of the slip|
    off = abs(float(np.sum(now.dissipation)) * area - lost) / max(lost, TINY)
    return [off, float(np.max(shorter if now.halvings else np.abs(shorter)))]


def _motion_before_touch(first: Increment, undeformed: Field) -> Field:
    """Compute the relative motion of particles in the first increment before they come into
    contact.

    Slip counts from first contact, while the stored energy needs the whole relative motion of the
    surfaces. At cells with an initial gap, slip is (p/p₀)² of the whole motion, because p² grows
    with the motion of the contact edge (p₀: largest pressure).

    first       first increment
    undeformed  gap before any load (nx, ny) [length]

    Returns an array of the shape (2, nx, ny) [length].
    """
    if first.slip is None:
        return np.zeros((2, *undeformed.shape))
    p = first.pressure
    touching = np.where((p > 0) & (undeformed > 0), (p / np.max(p)) ** 2, 1.0)
    return np.asarray(first.slip * (1 / touching - 1))
