"""Pressure and radial shear that depend on each other: one after the other, until they agree.

Each sweep solves the pressure at the present shear and the shear at the new pressure
(Panagiotopoulos 1975), and the error shrinks by about max(β², µ|β|) with it. Where that is slow,
what touches and what slips is known before the tractions are, and these follow at once.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from contact_scene.solver_errors import NotConverged
from fem_reference.contact.complementarity.contact_problem import ContactProblem
from fem_reference.contact.complementarity.pressing import press
from fem_reference.contact.complementarity.together import Coupled, settle
from fem_reference.contact.complementarity.tresca import shear
from fem_reference.contact.one_component import SidewaysTarget
from fem_reference.loads import NormalTarget

Field = NDArray[np.float64]

MOST_SWEEPS = 96
# By now the sides are nearly settled where friction is weak, and sweeps are slow where it is not.
SETTLED = (6, 12, 24, 48, 96)


def alternate(
    problem: ContactProblem,
    target: NormalTarget,
    before: Field,
    start: Coupled,
    tolerance: float,
) -> Coupled:
    """The coupled increment.

    before  displacement of the surfaces past each other before the increment, over the hats
    start   a first shear and sides
    raises  NotConverged
    """
    sideways = problem.sideways
    assert sideways is not None
    assert sideways.by_pressure is not None
    q, contact, slipping = start.shear, start.contact, start.slipping
    steps = 0
    for sweep in range(1, MOST_SWEEPS + 1):
        opened = problem.gap + sideways.by_pressure.T @ q
        pressed = press(problem.normal, opened, problem.weights, target, contact)
        p, contact = pressed.pressure, pressed.sides
        free = before - sideways.by_pressure @ p
        bound = sideways.friction.limit(p)
        sheared = shear(sideways, bound, SidewaysTarget(), free, slipping)
        slipping = sheared.sides
        steps += pressed.steps + sheared.steps
        largest = float(np.max(np.abs(sheared.shear)))
        change = float(np.max(np.abs(sheared.shear - q)))
        q = sheared.shear
        if change <= tolerance * largest:
            return Coupled(p, pressed.approach, q, contact, slipping, steps, sweep)
        if sweep in SETTLED:
            settled = settle(problem, target, before, contact, slipping)
            if isinstance(settled, int):
                steps += settled
                continue
            return replace(settled, steps=steps + settled.steps, sweeps=sweep)
    residual = change / largest if largest > 0 else np.inf
    raise NotConverged("the coupled increment", steps, residual, tolerance)
