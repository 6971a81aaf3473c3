"""The error of a value on every level of its case, so that solvers can be compared at equal
fineness."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from verification.judging.case import Case, Quantity
from verification.judging.outcome import RefinedErrors
from verification.judging.run import AnyRun, RadiiRun, Run, SectionRun

LEAST = 4  # levels: from fewer nothing is known of their scatter


def refined_errors(
    quantity: Quantity, case: Case, results: Mapping[str, Any]
) -> RefinedErrors | None:
    """Relative errors of the quantity on all runs of the same problem that differ in fineness
    alone; None for fewer than LEAST levels, and where an error is no number."""
    reference = quantity.reference.value
    if reference == 0 or quantity.unit == "":
        return None
    judged = case.run(quantity.run)
    runs = [run for run in followed_on(quantity, case) if run.label in results]
    if len({run.spacing for run in runs}) < LEAST:
        return None
    sides = [run.spacing / _radius(judged, results[judged.label]) for run in runs]
    errors = [abs(quantity.measure(results[run.label]) / reference - 1) for run in runs]
    if not all(map(math.isfinite, errors)):
        return None
    levels = sorted(zip(sides, errors, strict=True), key=lambda level: -level[0])
    return RefinedErrors(
        per_radius=tuple(1 / side for side, _ in levels), errors=tuple(error for _, error in levels)
    )


def followed_on(quantity: Quantity, case: Case) -> tuple[AnyRun, ...]:
    """Runs that differ in fineness alone, of the problem that the quantity is judged on; on cells
    those without edge correction, if there are any: only their errors have an order."""
    judged = case.run(quantity.run)
    if isinstance(judged, Run):
        uncorrected = replace(judged, edge="off")
        found = tuple(run for run in case.runs if _differ_in_fineness(run, uncorrected))
        if found:
            return found
    return tuple(run for run in case.runs if _differ_in_fineness(run, judged))


def _differ_in_fineness(one: AnyRun, other: AnyRun) -> bool:
    """Whether nothing but cells, elements and where they fall tells two runs apart. Meshes that are
    not laid alike to the edge differ in `beyond`."""
    if isinstance(one, Run) and isinstance(other, Run):
        return replace(one, label=other.label, grid=other.grid) == other
    if isinstance(one, SectionRun) and isinstance(other, SectionRun):
        mesh, fineness = one.discretisation, ("elements_per_radius", "contact_radius")
        same = mesh.model_copy(
            update={name: getattr(other.discretisation, name) for name in fineness}
        )
        return replace(one, label=other.label, discretisation=same) == other
    if isinstance(one, RadiiRun) and isinstance(other, RadiiRun):
        return replace(one, label=other.label, fineness=other.fineness) == other
    return False


def _radius(run: AnyRun, result: Any) -> float:
    """What a run's spacing is divided by to be a part of the contact radius."""
    if not isinstance(run, Run):
        return 1.0
    return max(float(increment.contact_radius) for increment in result.increments)
