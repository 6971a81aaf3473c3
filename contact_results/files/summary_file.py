"""`summary.json`: the state at the end of every loading step."""

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from contact_results.directory.file_names import SUMMARY
from contact_scene.linear_theory import beyond_linear_theory
from contact_scene.path_error import PathError
from contact_scene.summary import (
    EffectSummary,
    Residuals,
    RunSummary,
    StepSummary,
    dump_summary,
)
from semi_analytical import Increment, Result
from semi_analytical.fretting import FrettingCycle

Pair = tuple[float, float]


def write_summary(
    result: Result,
    cycles: Sequence[FrettingCycle],
    directory: Path,
    path_errors: tuple[PathError, ...] | None = None,
) -> None:
    """Write the summary; equal results give equal bytes."""
    text = dump_summary(summary_of(result, cycles, path_errors))
    (directory / SUMMARY).write_text(text, encoding="utf-8")


def summary_of(
    result: Result,
    cycles: Sequence[FrettingCycle],
    path_errors: tuple[PathError, ...] | None = None,
) -> RunSummary:
    """The record that all solvers share."""
    closed = {cycle.cycle.end: cycle for cycle in cycles}
    return RunSummary(
        title=result.scene.title,
        solver="semi_analytical",
        tolerance=result.tolerance,
        cells=result.grid.cells,
        window=result.grid.window,
        effects=tuple(EffectSummary(name=e.name, on=e.on, why=e.why) for e in result.plan.effects),
        steps=tuple(
            _step_summary(list(within), closed.get(step))
            for step, within in groupby(result.increments, lambda increment: increment.step)
        ),
        remarks=beyond_linear_theory(result.scene, result.steps),
        path_errors=path_errors,
    )


def _cycle_keys(cycle: FrettingCycle | None) -> dict[str, Any]:
    """The keys of a step that closes a cycle; none of them for others."""
    if cycle is None:
        return {}
    f2 = cycle.ruiz_f2
    return {
        "cycle_start": cycle.cycle.start,
        "energy_per_cycle": cycle.dissipated_energy,
        "slip_amplitude": float(np.max(cycle.slip_amplitude)),
        "ruiz_f1": float(np.max(cycle.ruiz_f1)),
        "ruiz_f2": None if f2 is None else float(np.max(f2)),
    }


def _step_summary(within: Sequence[Increment], cycle: FrettingCycle | None) -> StepSummary:
    """The state at the end of a step, the cost of its increments taken together.

    cycle  the one that the step closes
    """
    end = within[-1]
    imbalances = [i.energy_imbalance for i in within if i.energy_imbalance is not None]
    return StepSummary(
        normal_force=float(end.normal_force),
        approach=float(end.approach),
        contact_area=float(end.contact_area),
        contact_radius=float(end.contact_radius),
        peak_pressure=float(end.peak_pressure),
        tangential_force=_pair(end.tangential_force),
        tangential_shift=_pair(end.tangential_shift),
        torque=_number(end.torque),
        twist=_number(end.twist),
        moment=_pair(end.moment),
        tilt=_pair(end.tilt),
        stick_area=_number(end.stick_area),
        stick_radius=_number(end.stick_radius),
        dissipated_energy=_number(end.dissipated_energy),
        elastic_energy=float(end.elastic_energy),
        input_work=_number(end.input_work),
        unresolved_work=_number(end.unresolved_work),
        energy_imbalance=max(imbalances, default=None),
        **_cycle_keys(cycle),
        residuals=Residuals.model_validate(
            {name: _number(getattr(end.residuals, name)) for name in Residuals.model_fields}
        ),
        iterations=sum(i.iterations for i in within),
        convolutions=sum(i.convolutions for i in within),
        status=end.status,
    )


def _number(value: float | None) -> float | None:
    return None if value is None else float(value)


def _pair(vector: NDArray[np.float64] | None) -> Pair | None:
    return None if vector is None else (float(vector[0]), float(vector[1]))
