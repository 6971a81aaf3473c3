"""Errors of a radial result, from one with twice as many orders and points; with friction, from one
with half the rings and half the increments. A contact at points has two beside it: with half the
rings and angles, and with half the increments, too; what they change may be of opposite signs.
Where its loads turn so may what the steps change, and each has a companion of its own.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from contact_errors.by_step import ByStep
from contact_errors.estimate import UNKNOWN, Numbers, differences, stated, unsolved
from contact_errors.prescribed import prescribed
from contact_errors.rules import rules_for
from contact_errors.values import Values, charged_by_increments, scale, values_of
from contact_results.cycles import fretting_cycles
from contact_scene.solver_errors import SolverError
from contact_scene.stated_error import EXACT, Companion, Part, StatedError, StatedErrors
from radial import Increment, Result, solve
from radial.circle import Circle
from radial.plan import Plan

# Without friction both levels are at the end of what double precision gives: errors are as large as
# their difference, or as what residuals and round-off leave. With friction they fall at least as
# the inverse of the increments: the run's are at most as large as the difference.
TIMES = 2.0
ROUND_OFF = 1e-13
TWICE, HALF = 2, 0.5
# Of a contact at points: by half the increments, where what is left falls with an order above .74
# (Roache 1998); by half the rings and angles, where it does with 1.
BY_PATH = 1.5
BY_RINGS = 1.0
# Of what increments say themselves that they leave open of an energy: .002 to .3 of it is true, and
# the difference of two histories tells which. As on cells (`rules.ENERGY`).
CHARGE = 0.1
# Of the contact radius: as well as rings tell a front, and half increments where it stands at
# their end.
FRONT = 1e-3
# Rings of such a contact follow neither: its front is known to a quarter of one.
OF_RING, EDGE = 0.25, 2e-3
CUSP = 2.0  # of its pressure on the axis, which falls more slowly with the rings
_QUADRATURE: Part = "quadrature"
_INCREMENTS: Part = "increments"


def stated_errors(
    result: Result, progress: Callable[[Increment], None] | None = None
) -> StatedErrors:
    """Errors of all numbers at the ends of all steps; solves the companions."""
    cycles, plan = fretting_cycles(result), result.plan
    fine = values_of(result, cycles)
    beside: list[_Companion] = []
    changes: Sequence[Values | None] = [None] * len(fine)

    def solved(differs: str, other: Plan, fineness: float = HALF) -> Sequence[Values] | None:
        beside.append(_Companion(result, differs, other, fineness, progress))
        return beside[-1].values

    if plan.circle is Circle.WHOLE:
        changes = _turning(fine, plan, solved) or changes
    else:
        found = [solved(*way) for way in _ways(plan)]
        changes = _changes(fine, found) or changes
    charged = charged_by_increments(result, cycles)
    part = _INCREMENTS if plan.coupled or plan.circle else _QUADRATURE
    steps = zip(result.steps, result.scene.load_path(), fine, changes, charged, strict=True)
    finite = rules_for(result.scene.indenter, cusp=plan.coupled).keys()
    return StatedErrors(
        tuple(
            {
                name: EXACT
                if name in prescribed(ramp)
                else UNKNOWN
                if changed is None or name not in finite or name not in changed
                else _stated(
                    name,
                    part,
                    step.worst_residual,
                    values,
                    changed[name],
                    open_.get(name),
                    rings=plan.rings if plan.circle else None,
                )
                for name in values
            }
            for step, ramp, values, changed, open_ in steps
        ),
        tuple(one.made for one in beside),
    )


def _ways(plan: Plan) -> Sequence[tuple[str, Plan, float]]:
    """In what each companion differs, its plan and its fineness."""
    fewer = replace(plan, increments=_recut(plan.increments))
    if plan.circle is Circle.ONE:
        return ("half the rings", plan, HALF), ("half the rings and increments", fewer, HALF)
    if plan.circle:
        return (
            ("half the rings and angles", plan, HALF),
            ("half the rings, angles and increments", fewer, HALF),
        )
    if plan.coupled:
        return (("half the rings and increments", fewer, HALF),)
    return (("twice the orders and points", plan, float(TWICE)),)


class _Companion:
    """A solve beside that of a result.

    made    what is told of it
    values  its numbers; None where it has no answer
    """

    def __init__(
        self, result: Result, differs: str, plan: Plan, fineness: float,
        progress: Callable[[Increment], None] | None,
    ) -> None:  # fmt: skip
        self.values: Sequence[Values] | None = None
        self.made = Companion(differs=differs, increments=plan.increments)
        try:
            found = solve(result.scene, result.fineness, progress, plan, fineness=fineness)
        except SolverError as error:
            self.made = self.made.model_copy(update={"refused": str(error)})
        else:
            spent = sum(increment.iterations for increment in found.increments)
            self.made = self.made.model_copy(update={"iterations": spent})
            self.values = values_of(found, fretting_cycles(found))


def _turning(
    fine: Sequence[Values], plan: Plan, solved: Callable[[str, Plan], Sequence[Values] | None]
) -> Sequence[Values] | None:
    """By half the rings and angles, and by other increments of each step; None where one of these
    companions gave no result."""

    def otherwise_cut(counts: Sequence[int]) -> Sequence[Values] | None:
        return solved(
            "half the rings and angles, other increments", replace(plan, increments=tuple(counts))
        )

    by_step = ByStep(plan.increments, (True,) * len(plan.increments))
    coarse = solved("half the rings and angles", plan)
    other = None if coarse is None else otherwise_cut(by_step.recut_from(0))
    if coarse is None or other is None:
        return None
    path = replace(by_step, companions=(coarse, other), solved=otherwise_cut).by_squares
    return None if path is None else _together(differences(fine, coarse), path)


def _changes(
    fine: Sequence[Values], beside: Sequence[Sequence[Values] | None]
) -> Sequence[Values] | None:
    """By companions, times what they are worth; None where one gave no result."""
    known = [values for values in beside if values is not None]
    if len(known) < len(beside):
        return None
    if len(known) == 1:
        return [_times(TIMES, change) for change in differences(fine, known[0])]
    return _together(differences(fine, known[0]), differences(known[0], known[1]))


def _together(rings: Sequence[Values], path: Sequence[Values]) -> Sequence[Values]:
    """By rings and by increments, times what they are worth."""
    return [
        {
            name: BY_RINGS * by_rings[name] + BY_PATH * by_path[name]
            for name in by_rings
            if name in by_path
        }
        for by_rings, by_path in zip(rings, path, strict=True)
    ]


def _times(factor: float, values: Values) -> Values:
    return {name: factor * value for name, value in values.items()}


def _recut(increments: tuple[int, ...]) -> tuple[int, ...]:
    """Half as many, as far as that goes: what the solver puts between them is halved as well."""
    return tuple(max(count // 2, 1) for count in increments)


def _stated(
    name: str, part: Part, residual: float, values: Values, changed: Numbers,
    by_increments: float | None, *, rings: int | None,
) -> StatedError:  # fmt: skip
    """changed  by companions, times what they are worth
    rings    over a contact at points; None of others
    """
    size = np.maximum(np.abs(values[name]), scale(name, values))
    front: Numbers | float = 0.0
    if part == _INCREMENTS:
        front = _of_front(name, values, OF_RING / rings if rings else FRONT)
    if rings:
        of_edge = {"contact_radius": 1, "contact_area": 2}.get(name, 0)
        front = front + EDGE * of_edge * values[name]
        changed = changed * (CUSP if name == "peak_pressure" else 1.0)
    parts: dict[Part, Numbers] = {
        part: front + changed + ROUND_OFF * size,
        "tolerance": unsolved(residual, np.abs(values[name]), scale(name, values)),
    }
    if by_increments is not None:
        told = np.atleast_1d(by_increments)
        of_path = parts.get("increments", 0.0)
        parts["increments"] = of_path + (CHARGE if part == _INCREMENTS else 1.0) * told
    return stated(parts, converged=True)


def _of_front(name: str, values: Values, share: float) -> Numbers | float:
    """By what rings leave a radius of the stick, and the area within, uncertain.

    share  of the contact radius
    """
    uncertain = share * values["contact_radius"]
    if name == "stick_area":
        return np.asarray(2 * np.pi * values["stick_radius"] * uncertain + np.pi * uncertain**2)
    return uncertain if name == "stick_radius" else 0.0
