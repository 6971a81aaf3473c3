"""Coarse solves of a radial result: other orders and points, fewer rings, other increments."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from contact_errors.coarse_solves import CoarseSolves
from contact_errors.error_formula import EDGE, SMOOTH, Comparison, Features, SolvedRun
from contact_scene.increment_error import with_error
from contact_scene.stated_error import Companion, StatedErrors
from contact_scene.summary import ContactStatus
from radial import Increment, Result, solve

Progress = Callable[[Increment], None]

# Of double precision, with what rotations of a few hundred rows lose.
PRECISION = 1e-13
LINEAR = 2.0  # values linear between rings resolve a feature like twice as many cells


def stated_errors(result: Result, progress: Progress | None = None) -> StatedErrors:
    """Estimate the errors of all numbers at the ends of all steps, by coarse solves."""
    coarse, plan = CoarseSolves(result), result.plan
    matters, steps = with_error(result.scene), result.steps

    def solved(part: float, others: tuple[int, ...]) -> Any:
        recut = ", other increments" if others != plan.increments else ""
        record = Companion(differs=f"{part:.2g} times the rings{recut}", increments=others)
        cut = replace(plan, increments=others)
        return coarse.solved(
            (part, others),
            lambda: solve(result.scene, result.fineness, progress, cut, fineness=part),
            record,
        )

    # Without friction the orders and points are doubled instead.
    counted = plan.coupled or plan.circle is not None
    parts = (1 / 2, 2 / 3) if counted else (2.0,)
    order = None if plan.circle else EDGE if counted else SMOOTH
    comparisons: list[Comparison] = []
    for part in parts:
        found = solved(part, plan.increments)
        comparisons += coarse.compared("quadrature", found, 1 / part, order)
    usable = [part for part in parts if solved(part, plan.increments) is not None]
    comparisons += coarse.by_increments(
        matters, lambda others: solved(usable[0], others) if usable else None
    )
    run = SolvedRun(
        scene=result.scene,
        values=coarse.values(result),
        tolerance=[max(step.worst_residual, PRECISION) for step in steps],
        features=_features(result),
        comparisons=comparisons,
        required={"quadrature": [True] * len(steps), "increments": matters},
        neglected={},
    )
    return StatedErrors(tuple(run.errors()), tuple(coarse.made))


def _features(result: Result) -> tuple[Features, ...]:
    """Resolution at the end of each step: the contact in widest rings, its zones in mean rings.

    Without friction no number depends on the rings.
    """
    indenter, plan, found = result.scene.indenter, result.plan, list[Features]()
    counted = plan.coupled or plan.circle is not None
    for end in result.steps:
        if end.contact_area == 0:
            found.append(found[-1])
            continue
        within = end.radii[end.radii <= end.contact_radius]
        widest = float(np.max(np.diff([0.0, *within, end.contact_radius])))
        side = end.contact_radius / (len(within) or 1)
        stick, annulus = None, None
        if counted and end.stick_radius is not None:
            stick = LINEAR * end.stick_radius / side
            if end.status is not ContactStatus.FULL_STICK:
                annulus = LINEAR * (end.contact_radius - end.stick_radius) / side
        found.append(
            Features(
                contact=LINEAR * end.contact_radius / widest if counted else np.inf,
                cell=side,
                stick=stick,
                annulus=annulus,
                fitted=not plan.circle,
                stick_fitted=not plan.circle,
                whole_rings=plan.circle is not None,
                sharp=indenter.rim is not None and counted,
                infinite=indenter.rim is not None or indenter.gap_exponent == 1,
                cusp=plan.coupled,
                slides=end.status is ContactStatus.GROSS_SLIDING,
            )
        )
    return tuple(found)
