"""Errors of a radial result, from one with twice as many orders and points; with friction, from one
with half the rings and half the increments, of a pushed contact half the angles, too."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from contact_errors.estimate import UNKNOWN, Numbers, differences, stated, unsolved
from contact_errors.prescribed import prescribed
from contact_errors.rules import rules_for
from contact_errors.values import Values, charged_by_increments, scale, values_of
from contact_results.cycles import fretting_cycles
from contact_scene.solver_errors import SolverError
from contact_scene.stated_error import EXACT, Companion, Part, StatedError, StatedErrors
from radial import Increment, Result, solve
from radial.plan import RINGS

# Without friction both levels are at the end of what double precision gives: errors are as large as
# their difference, or as what residuals and round-off leave. With friction they fall at least as
# the inverse of the increments: the run's are at most as large as the difference.
TIMES = 2.0
ROUND_OFF = 1e-13
TWICE, HALF = 2, 0.5
# Of the contact radius: as well as rings tell a front, and half increments where it stands at
# their end.
FRONT = 1e-3
# Rings of a pushed contact follow neither: its front is known to a quarter of one.
OF_RING, EDGE = 0.25, 2e-3
CUSP = 2.0  # of a pushed contact's pressure on the axis, which falls more slowly with the rings
_QUADRATURE: Part = "quadrature"
_INCREMENTS: Part = "increments"


def stated_errors(
    result: Result, progress: Callable[[Increment], None] | None = None
) -> StatedErrors:
    """Errors of all numbers at the ends of all steps; solves the companion."""
    cycles = fretting_cycles(result)
    fine = values_of(result, cycles)
    plan, fineness = result.plan, float(TWICE)
    differs, part = "twice the orders and points", _QUADRATURE
    if plan.coupled or plan.pushed:
        plan, fineness = replace(plan, increments=_recut(plan.increments)), HALF
        differs, part = "half the rings and increments", _INCREMENTS
    made = Companion(differs=differs, increments=plan.increments)
    try:
        finer = solve(result.scene, result.fineness, progress, plan, fineness=fineness)
    except SolverError as error:
        made = made.model_copy(update={"refused": str(error)})
        changes: Sequence[Values | None] = [None] * len(fine)
    else:
        spent = sum(increment.iterations for increment in finer.increments)
        made = made.model_copy(update={"iterations": spent})
        changes = differences(fine, values_of(finer, fretting_cycles(finer)))
    charged = charged_by_increments(result, cycles)
    steps = zip(result.steps, result.scene.load_path(), fine, changes, charged, strict=True)
    finite = rules_for(result.scene.indenter, cusp=plan.coupled).keys()
    return StatedErrors(
        tuple(
            {
                name: EXACT
                if name in prescribed(ramp)
                else UNKNOWN
                if changed is None or name not in finite
                else _stated(
                    name,
                    part,
                    step.worst_residual,
                    values,
                    changed[name],
                    open_.get(name),
                    pushed=plan.pushed,
                )
                for name in values
            }
            for step, ramp, values, changed, open_ in steps
        ),
        (made,),
    )


def _recut(increments: tuple[int, ...]) -> tuple[int, ...]:
    """Half as many, as far as that goes: what the solver puts between them is halved as well."""
    return tuple(max(count // 2, 1) for count in increments)


def _stated(
    name: str, part: Part, residual: float, values: Values, changed: Numbers,
    by_increments: float | None, *, pushed: bool,
) -> StatedError:  # fmt: skip
    size = np.maximum(np.abs(values[name]), scale(name, values))
    front: Numbers | float = 0.0
    if part == _INCREMENTS:
        front = _of_front(name, values, OF_RING / RINGS if pushed else FRONT)
    if pushed:
        of_edge = {"contact_radius": 1, "contact_area": 2}.get(name, 0)
        front = front + EDGE * of_edge * values[name]
        changed = changed * (CUSP if name == "peak_pressure" else 1.0)
    parts: dict[Part, Numbers] = {
        part: front + TIMES * changed + ROUND_OFF * size,
        "tolerance": unsolved(residual, np.abs(values[name]), scale(name, values)),
    }
    if by_increments is not None:
        parts["increments"] = parts.get("increments", 0.0) + np.atleast_1d(by_increments)
    return stated(parts, converged=True)


def _of_front(name: str, values: Values, share: float) -> Numbers | float:
    """By what rings leave a radius of the stick, and the area within, uncertain.

    share  of the contact radius
    """
    uncertain = share * values["contact_radius"]
    if name == "stick_area":
        return np.asarray(2 * np.pi * values["stick_radius"] * uncertain + np.pi * uncertain**2)
    return uncertain if name == "stick_radius" else 0.0
