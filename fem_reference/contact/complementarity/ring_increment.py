"""One increment of the complementarity method: pressure, then shear, or both in turn."""

from dataclasses import replace
from math import pi

import numpy as np
from numpy.typing import NDArray

from contact_scene.residuals import Residuals
from contact_scene.solver_errors import motion_undefined
from fem_reference.contact.complementarity.contact_problem import ContactProblem, Sideways
from fem_reference.contact.complementarity.pressing import Pressed, press
from fem_reference.contact.complementarity.ring_state import Slid, State, untouched
from fem_reference.contact.complementarity.slipping import at_limit, slid, slip_residuals
from fem_reference.contact.complementarity.sweeps import alternate
from fem_reference.contact.complementarity.together import Coupled
from fem_reference.contact.complementarity.tresca import shear
from fem_reference.contact.first_touch import touching_share
from fem_reference.contact.friction_limit import reaches_limit
from fem_reference.contact.one_component import target_of
from fem_reference.contact.ring_edge import contact_edge
from fem_reference.contact.zone_edge import refuse_contact_at_edge
from fem_reference.loads import Loads, NormalTarget
from fem_reference.residuals import complementarity, penetration

Field = NDArray[np.float64]

# The alternation stops at this part of the tolerance, so that the residuals meet it.
ENOUGH = 0.01


def advance(problem: ContactProblem, before: State | None, loads: Loads, tolerance: float) -> State:
    """The state at the end of an increment.

    raises  NotConverged, GrossSliding, ContactAtZoneEdge
    """
    sideways = problem.sideways
    if sideways is not None and sideways.by_pressure is not None:
        state = _coupled(problem, sideways, before, loads, tolerance)
    else:
        state = _uncoupled(problem, before, loads)
    refuse_contact_at_edge(problem.open_end and state.pressure[-1] > 0, problem.radii[-1])
    state.residuals.require(tolerance, "the increment", state.steps)
    return state


def _uncoupled(problem: ContactProblem, before: State | None, loads: Loads) -> State:
    """Pressure, then shear at that pressure."""
    if before is not None and before.loads.normal == loads.normal:
        pressed = Pressed(before.pressure, before.approach, before.contact, 0)
    else:
        guess = np.zeros(len(problem.gap), np.int8) if before is None else before.contact
        pressed = press(problem.normal, problem.gap, problem.weights, loads.normal, guess)
    gap = problem.normal @ pressed.pressure + problem.gap - pressed.approach * problem.weights
    state = _pressed(problem, pressed, gap, loads)
    if problem.sideways is None:
        return state
    last = before.slid if before is not None and before.slid is not None else untouched(len(gap))
    share = _touching_share(problem, before, pressed.pressure)
    after, step, steps = _sheared(problem.sideways, pressed.pressure, last, share, loads)
    state = replace(state, steps=state.steps + steps)
    return _with_shear(state, problem.sideways, after, step)


def _sheared(
    sideways: Sideways, p: Field, last: Slid, share: Field, loads: Loads
) -> tuple[Slid, Field | None, int]:
    """The shear part under its load, the motion past each other unless undefined, and linear
    systems solved."""
    if last.motion is None:
        raise motion_undefined()
    target = target_of(loads)
    if reaches_limit(target.resultant, sideways.capacity(p)):
        return at_limit(sideways, p, target, last), None, 0
    solved = shear(sideways, sideways.friction.limit(p), target, last.offset, last.sides)
    after, step = slid(sideways, p, solved.shear, solved.motion, solved.sides, last, share)
    return after, step, solved.steps


def _coupled(
    problem: ContactProblem,
    sideways: Sideways,
    before: State | None,
    loads: Loads,
    tolerance: float,
) -> State:
    """Pressure and radial shear in equilibrium with each other."""
    assert sideways.by_pressure is not None
    rings = len(problem.gap)
    last = before.slid if before is not None and before.slid is not None else untouched(rings)
    contact = np.zeros(rings, np.int8) if before is None else before.contact
    start = Coupled(np.zeros(rings), 0.0, last.shear, contact, last.sides)
    solved = alternate(problem, loads.normal, last.offset, start, ENOUGH * tolerance)
    p, q = solved.pressure, solved.shear
    opened = problem.gap + sideways.by_pressure.T @ q
    gap = problem.normal @ p + opened - solved.approach * problem.weights
    pressed = Pressed(p, solved.approach, solved.contact, solved.steps)
    share = _touching_share(problem, before, p)
    after, step = slid(sideways, p, q, 0.0, solved.slipping, last, share)
    state = replace(_pressed(problem, pressed, gap, loads), sweeps=solved.sweeps)
    return _with_shear(state, sideways, after, step)


def _touching_share(problem: ContactProblem, before: State | None, p: Field) -> Field:
    """See `touching_share`; before first touch the gap is the undeformed one."""
    pressure, gap = np.zeros_like(p), problem.gap
    if before is not None:
        pressure, gap = before.pressure, before.gap
    edges = (contact_edge(problem.radii, pressed, problem.edge) for pressed in (pressure, p))
    return touching_share(problem.radii, (pressure == 0) & (gap > 0), p == 0, *edges)


def _with_shear(state: State, sideways: Sideways, after: Slid, step: Field | None) -> State:
    missed = slip_residuals(sideways, state.pressure, after, step, state.loads)
    return replace(state, slid=after, residuals=state.residuals.with_shear(missed))


def _pressed(problem: ContactProblem, pressed: Pressed, gap: Field, loads: Loads) -> State:
    p, weights = pressed.pressure, problem.weights
    carried = 2 * pi * float(np.sum(weights * p))
    return State(
        loads=loads,
        pressure=p,
        approach=pressed.approach,
        normal_force=carried if loads.normal.force is None else loads.normal.force,
        gap=gap,
        contact=pressed.sides,
        slid=None,
        residuals=Residuals(
            complementarity(p, gap, weights, pressed.approach),
            penetration(gap, weights, pressed.approach),
            _missing(loads.normal, carried),
        ),
        steps=pressed.steps,
        sweeps=1,
    )


def _missing(target: NormalTarget, carried: float) -> float | None:
    return None if target.force is None else abs(carried - target.force) / target.force
