"""`summary.json`: scalars at the end of every load step, with equal names for all solvers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import groupby, repeat
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.directory.file_names import FIELDS, SUMMARY
from contact_results.files.stored_values import fields_digest
from contact_results.result_report import ResultReport
from contact_scene.quantities.field_metadata import Kind
from contact_scene.quantities.increment import SCALARS, columns
from contact_scene.quantities.stated_error import StatedError
from contact_scene.quantities.summary import (
    EffectSummary,
    Residuals,
    RunSummary,
    StepSummary,
    dump_summary,
)

if TYPE_CHECKING:
    from contact_results.cycles import FrettingCycle
    from contact_results.surface import Increment


def write_summary(
    summary: RunSummary, directory: Path, warnings: tuple[str, ...], *, line: bool
) -> None:
    """Write `summary.json`, which contains the SHA-256 of the file of fields in the directory.

    The file of fields must exist already. Equal results give equal bytes.

    summary    summary of the result
    directory  directory of the run
    warnings   warnings about the result, which replace those of the summary
    line       True for a line contact
    """
    digest = fields_digest(directory / FIELDS)
    told = summary.model_copy(update={"fields_digest": digest, "warnings": warnings})
    (directory / SUMMARY).write_text(dump_summary(told, line=line), encoding="utf-8")


def summary_of(report: ResultReport) -> RunSummary:
    """Create the summary of a result of any solver; quantities that the solver lacks are None.

    The summary has no warnings.
    """
    result, errors = report.result, report.errors
    stated = zip(errors.steps, errors.shear, strict=True) if errors else repeat((None, None))
    closed = {cycle.cycle.end: cycle for cycle in report.cycles}
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
            _step_summary(list(within), closed.get(step), *of_step)
            for (step, within), of_step in zip(
                groupby(increments, lambda increment: increment.step), stated, strict=False
            )
        ),
        coarse_solves=errors.coarse_solves if errors else None,
        accuracy=report.accuracy,
    )


def _step_summary(
    within: Sequence[Increment],
    cycle: FrettingCycle | None,
    errors: Mapping[str, StatedError] | None,
    shear_error: float | None,
) -> StepSummary:
    end = within[-1]
    residuals: dict[str, Any] = {
        name: None if value is None else float(value) for name, value in vars(end.residuals).items()
    }
    return StepSummary(
        **{
            name: _step_value(SCALARS[name].kind, values)
            for name, values in columns(within, SCALARS).items()
        },
        **(cycle.numbers if cycle else {}),
        residuals=Residuals(**residuals),
        status=end.status,
        errors=None if errors is None else dict(errors),
        shear_error=shear_error,
    )


def _step_value(kind: Kind, values: Sequence[Any]) -> Any:
    """Return the value of a scalar for a load step from its values at the increments.

    kind    determines the result: the largest value for Kind.LARGEST, else the last value
    values  value at each increment of the load step; None if an increment has no value
    """
    known = [value for value in values if value is not None]
    if kind is Kind.LARGEST:
        return float(np.max(known)) if known else None
    end = values[-1]
    if end is None:
        return None
    return tuple(map(float, end)) if kind is Kind.VECTOR else float(end)
