"""`summary.json`: the state at the end of every loading step, by the names of all solvers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby, repeat
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.directory.file_names import FIELDS, SUMMARY
from contact_results.files.stored_values import fields_digest
from contact_results.result_warnings import warnings_of
from contact_scene.quantities.field_metadata import Kind
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.stated_error import (
    AccuracyReached,
    StatedError,
    StatedErrors,
)
from contact_scene.quantities.summary import (
    EffectSummary,
    Residuals,
    RunSummary,
    StepSummary,
    dump_summary,
)

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle
    from contact_results.surface import Increment, Result


def write_summary(
    result: Result,
    cycles: Sequence[FrettingCycle],
    directory: Path,
    errors: StatedErrors | None = None,
    accuracy: AccuracyReached | None = None,
) -> None:
    """Write the summary with the digest of the file of fields; equal results give equal bytes."""
    summary = summary_of(result, cycles, errors, accuracy)
    digest = fields_digest(directory / FIELDS)
    text = dump_summary(summary.model_copy(update={"fields_digest": digest}))
    (directory / SUMMARY).write_text(text, encoding="utf-8")


def summary_of(
    result: Result,
    cycles: Sequence[FrettingCycle],
    errors: StatedErrors | None = None,
    accuracy: AccuracyReached | None = None,
) -> RunSummary:
    """Return the summary of a result of any solver; quantities that it lacks are None."""
    stated = errors.steps if errors else repeat(None)
    closed = {cycle.cycle.end: cycle for cycle in cycles}
    grid = getattr(result, "grid", None)
    increments: Sequence[Increment] = result.increments
    return RunSummary(
        title=result.scene.title,
        solver=result.solver,
        tolerance=result.tolerance,
        cells=grid and grid.cells,
        window=grid and grid.window,
        effects=tuple(EffectSummary(name=e.name, on=e.on, why=e.why) for e in result.plan.effects),
        steps=tuple(
            _step_summary(list(within), closed.get(step), of_step)
            for (step, within), of_step in zip(
                groupby(increments, lambda increment: increment.step), stated, strict=False
            )
        ),
        warnings=warnings_of(result),
        coarse_solves=errors.coarse_solves if errors else None,
        accuracy=accuracy,
    )


def _step_summary(
    within: Sequence[Increment],
    cycle: FrettingCycle | None,
    errors: Mapping[str, StatedError] | None,
) -> StepSummary:
    """Return the summary of the increments of a load step.

    cycle   the load cycle that the step closes; None if it closes none
    errors  stated errors at the end of the step
    """
    end = within[-1]
    residuals: dict[str, Any] = {
        name: None if value is None else float(value) for name, value in vars(end.residuals).items()
    }
    return StepSummary(
        **{
            name: _aggregate(mark.kind, [getattr(increment, name) for increment in within])
            for name, mark in SCALARS.items()
        },
        **(cycle.numbers if cycle else {}),
        residuals=Residuals(**residuals),
        status=end.status,
        errors=None if errors is None else dict(errors),
    )


def _aggregate(kind: Kind, values: Sequence[Any]) -> Any:
    """Return the largest of the values or the last one, depending on the kind."""
    known = [value for value in values if value is not None]
    if kind is Kind.LARGEST:
        return float(np.max(known)) if known else None
    end = values[-1]
    if end is None:
        return None
    return tuple(map(float, end)) if kind is Kind.VECTOR else float(end)
