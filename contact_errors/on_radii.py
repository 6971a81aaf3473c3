"""Errors of a radial result, from one with twice as many orders and points."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from contact_errors.estimate import UNKNOWN, Numbers, differences, stated, unsolved
from contact_errors.prescribed import prescribed
from contact_errors.rules import rules_for
from contact_errors.values import Values, charged_by_increments, scale, values_of
from contact_scene.solver_errors import SolverError
from contact_scene.stated_error import EXACT, Companion, Part, StatedError, StatedErrors
from radial import Increment, Result, solve

# Both levels are at the end of what double precision gives: errors are as large as their
# difference, or as what residuals and round-off leave.
TIMES = 2.0
ROUND_OFF = 1e-13
TWICE = 2


def stated_errors(
    result: Result, progress: Callable[[Increment], None] | None = None
) -> StatedErrors:
    """Errors of all numbers at the ends of all steps; solves the companion."""
    fine = values_of(result, ())
    made = Companion(differs="twice the orders and points", increments=result.plan.increments)
    try:
        finer = solve(result.scene, result.fineness, progress, result.plan, fineness=TWICE)
    except SolverError as error:
        made = made.model_copy(update={"refused": str(error)})
        changes: Sequence[Values | None] = [None] * len(fine)
    else:
        spent = sum(increment.iterations for increment in finer.increments)
        made = made.model_copy(update={"iterations": spent})
        changes = differences(fine, values_of(finer, ()))
    charged = charged_by_increments(result, ())
    steps = zip(result.steps, result.scene.load_path(), fine, changes, charged, strict=True)
    finite = rules_for(result.scene.indenter, cusp=False).keys()
    return StatedErrors(
        tuple(
            {
                name: EXACT
                if name in prescribed(ramp)
                else UNKNOWN
                if changed is None or name not in finite
                else _stated(name, step.worst_residual, values, changed[name], open_.get(name))
                for name in values
            }
            for step, ramp, values, changed, open_ in steps
        ),
        (made,),
    )


def _stated(
    name: str, residual: float, values: Values, changed: Numbers, by_increments: float | None
) -> StatedError:
    size = np.maximum(np.abs(values[name]), scale(name, values))
    parts: dict[Part, Numbers] = {
        "quadrature": TIMES * changed + ROUND_OFF * size,
        "tolerance": unsolved(residual, np.abs(values[name]), scale(name, values)),
    }
    if by_increments is not None:
        parts["increments"] = np.atleast_1d(by_increments)
    return stated(parts, converged=True)
