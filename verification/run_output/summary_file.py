"""`summary.json`: the state at the end of every loading step."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contact_scene.summary import (
    EffectSummary,
    Residuals,
    RunSummary,
    StepSummary,
    dump_summary,
)
from semi_analytical import Increment, Result
from verification.run_output.file_names import SUMMARY

Pair = tuple[float, float]


def write_summary(result: Result, directory: Path) -> None:
    """Write the summary; equal results give equal bytes."""
    (directory / SUMMARY).write_text(dump_summary(summary_of(result)), encoding="utf-8")


def summary_of(result: Result) -> RunSummary:
    """The record that all solvers share."""
    counts = _counts(result.increments, len(result.steps))
    return RunSummary(
        title=result.scene.title,
        solver="semi_analytical",
        tolerance=result.tolerance,
        cells=result.grid.cells,
        window=result.grid.window,
        effects=tuple(EffectSummary(name=e.name, on=e.on, why=e.why) for e in result.plan.effects),
        steps=tuple(
            _step_summary(end, *count) for end, count in zip(result.steps, counts, strict=True)
        ),
    )


def _counts(increments: tuple[Increment, ...], steps: int) -> list[tuple[int, int]]:
    """Iterations and convolutions of every step, its increments taken together."""
    counts = [(0, 0)] * steps
    for increment in increments:
        iterations, convolutions = counts[increment.step - 1]
        counts[increment.step - 1] = (
            iterations + increment.iterations,
            convolutions + increment.convolutions,
        )
    return counts


def _step_summary(end: Increment, iterations: int, convolutions: int) -> StepSummary:
    return StepSummary(
        normal_force=float(end.normal_force),
        approach=float(end.approach),
        contact_area=float(end.contact_area),
        contact_radius=float(end.contact_radius),
        peak_pressure=float(end.peak_pressure),
        tangential_force=_pair(end.tangential_force),
        tangential_shift=_pair(end.tangential_shift),
        stick_area=_number(end.stick_area),
        stick_radius=_number(end.stick_radius),
        dissipated_energy=_number(end.dissipated_energy),
        residuals=Residuals.model_validate(
            {name: _number(getattr(end.residuals, name)) for name in Residuals.model_fields}
        ),
        iterations=iterations,
        convolutions=convolutions,
        status=end.status,
    )


def _number(value: float | None) -> float | None:
    return None if value is None else float(value)


def _pair(vector: NDArray[np.float64] | None) -> Pair | None:
    return None if vector is None else (float(vector[0]), float(vector[1]))
