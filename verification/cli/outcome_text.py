"""The key results of a run in the units of a person."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from semi_analytical import Increment, Result
from verification.cli.grid_text import grid_text
from verification.run_output.engineering_units import engineering_unit

FIRST, LAST = 10, 10  # of a long history, the steps that are shown
NEGLIGIBLE = 1e-9  # of the largest value of a vector: round-off, shown as nothing

Values = list[float | None]


def solved_with(result: Result, seconds: float) -> Iterator[tuple[str, str]]:
    """How fine and how well it was solved."""
    yield "grid", grid_text(result.grid)
    worst = max(increment.residuals.worst for increment in result.increments)
    yield "tolerance", f"{result.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def outcome_columns(result: Result) -> dict[str, list[str]]:
    """Headings and texts, one per loading step; effects that are off have no column.

    Of a long history the beginning and the end, with an ellipsis between them.
    """
    steps, gap = _shown(result.steps)
    columns = {"step": [str(step.step) for step in steps]}
    for name, unit, digits, values in _quantities(steps):
        scale = engineering_unit(max((abs(v) for v in values if v is not None), default=0.0), unit)
        texts = ["–" if v is None else f"{v / scale.size:.{digits}g}" for v in values]
        columns[f"{name}\n{scale.name}"] = texts
    if gap is not None:
        for texts in columns.values():
            texts.insert(gap, "…")
    return columns


def _shown(steps: Sequence[Increment]) -> tuple[list[Increment], int | None]:
    """The steps to show, and where some are left out."""
    if len(steps) <= FIRST + LAST + 1:
        return list(steps), None
    return [*steps[:FIRST], *steps[-LAST:]], FIRST


def _quantities(steps: list[Increment]) -> Iterator[tuple[str, str, int, Values]]:
    """Name, unit, digits and values of every quantity that the steps have."""
    yield "normal\nforce", "N", 5, [step.normal_force for step in steps]
    yield "approach\n", "m", 5, [step.approach for step in steps]
    yield from _components("tang.\nforce", "N", [step.tangential_force for step in steps])
    yield from _components("tang.\nshift", "m", [step.tangential_shift for step in steps])
    yield "peak\npressure", "Pa", 5, [step.peak_pressure for step in steps]
    yield "contact\nradius", "m", 4, [step.contact_radius for step in steps]
    if any(step.stick_radius is not None for step in steps):
        yield "stick\nradius", "m", 4, [step.stick_radius for step in steps]
        yield "energy\nlost", "J", 4, [step.dissipated_energy for step in steps]


def _components(
    name: str, unit: str, vectors: list[NDArray[np.float64] | None]
) -> Iterator[tuple[str, str, int, Values]]:
    """The x component, and the y component where there is one, without their round-off."""
    largest = max((float(np.max(np.abs(v))) for v in vectors if v is not None), default=None)
    if largest is None:
        return
    for k, axis in enumerate("xy"):
        values = [None if v is None else _cut(float(v[k]), NEGLIGIBLE * largest) for v in vectors]
        if axis == "x" or any(values):
            yield f"{name} {axis}", unit, 4, values


def _cut(value: float, negligible: float) -> float:
    return value if abs(value) > negligible else 0.0
