"""The key results of a run in the units of a person."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_results.difference import largest_difference
from contact_scene.engineering_units import engineering_unit
from contact_scene.path_error import DoubledQuantity, PathError
from semi_analytical import Result
from slipstick.cli.grid_text import grid_text

if TYPE_CHECKING:
    import fem_reference
    import semi_analytical

    AnyIncrement = semi_analytical.Increment | fem_reference.Increment

FIRST, LAST = 10, 10  # of a long history, the steps that are shown
NEGLIGIBLE = 1e-9  # of the largest value of a vector: round-off, shown as nothing

Values = list[float | None]
Shown = TypeVar("Shown")


def solved_with(result: Result, seconds: float) -> Iterator[tuple[str, str]]:
    """How fine and how well it was solved."""
    yield "grid", grid_text(result.grid)
    worst = max(increment.residuals.worst for increment in result.increments)
    yield "tolerance", f"{result.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def saving(planned: Result, forced: Result) -> Iterator[tuple[str, str]]:
    """What forcing all effects on has cost, and that it changed nothing."""
    few, many = (sum(i.convolutions for i in r.increments) for r in (planned, forced))
    yield "all effects", f"{many} convolutions; as planned {few}, a ratio of {many / few:.1f}"
    yield "difference", f"{largest_difference(planned, forced):.1e} of pressure and approach"


def outcome_columns(result: Result | fem_reference.Result) -> dict[str, list[str]]:
    """Headings and texts, one per loading step; effects that are off have no column.

    Of a long history the beginning and the end, with an ellipsis between them.
    """
    ends: Sequence[AnyIncrement] = result.steps
    steps, gap = _shown(ends)
    columns = {"step": [str(step.step) for step in steps]}
    for name, unit, digits, values in _quantities(steps):
        scale = engineering_unit(max((abs(v) for v in values if v is not None), default=0.0), unit)
        texts = ["–" if v is None else f"{v / scale.size:.{digits}g}" for v in values]
        columns[f"{name}\n{scale.name}"] = texts
    if gap is not None:
        for texts in columns.values():
            texts.insert(gap, "…")
    return columns


def path_error_columns(errors: Sequence[PathError]) -> dict[str, list[str]]:
    """Headings and texts, one per loading step: relative errors of fields and scalars."""
    errors, gap = _shown(errors)
    columns = {
        "step": [str(e.step) for e in errors],
        "incre-\nments": [str(e.increments) for e in errors],
        "pressure\nL1": [f"{e.pressure:.1e}" for e in errors],
    }
    if any(e.shear is not None for e in errors):
        columns["shear\nL1"] = ["–" if e.shear is None else f"{e.shear:.1e}" for e in errors]
    found = [{q.name: q for q in e.quantities} for e in errors]
    for name in dict.fromkeys(name for step in found for name in step):
        values = [_relative_error(step.get(name), name, found) for step in found]
        if any(value != "–" for value in values):
            columns["\n".join(name.split("_", 1))] = values
    if gap is not None:
        for texts in columns.values():
            texts.insert(gap, "…")
    return columns


def _relative_error(
    quantity: DoubledQuantity | None, name: str, found: Sequence[dict[str, DoubledQuantity]]
) -> str:
    """Relative to the largest value of the history; nothing for what is prescribed."""
    largest = max(abs(step[name].value) for step in found if name in step)
    if quantity is None or largest == 0 or quantity.error <= NEGLIGIBLE * largest:
        return "–"
    return f"{quantity.error / largest:.1e}"


def _shown(steps: Sequence[Shown]) -> tuple[list[Shown], int | None]:
    """The steps to show, and where some are left out."""
    if len(steps) <= FIRST + LAST + 1:
        return list(steps), None
    return [*steps[:FIRST], *steps[-LAST:]], FIRST


def _quantities(steps: list[AnyIncrement]) -> Iterator[tuple[str, str, int, Values]]:
    """Name, unit, digits and values of every quantity that the steps have."""
    yield "normal\nforce", "N", 5, [step.normal_force for step in steps]
    yield "approach\n", "m", 5, [step.approach for step in steps]
    yield from _components("tang.\nforce", "N", [step.tangential_force for step in steps])
    yield from _components("tang.\nshift", "m", [step.tangential_shift for step in steps])
    yield from _components("moment\n", "N m", [getattr(step, "moment", None) for step in steps])
    yield from _components("tilt\n", "rad", [getattr(step, "tilt", None) for step in steps])
    if any(step.torque is not None for step in steps):
        yield "torque\n", "N m", 4, [step.torque for step in steps]
        yield "twist\n", "rad", 4, [step.twist for step in steps]
    yield "peak\npressure", "Pa", 5, [step.peak_pressure for step in steps]
    yield "contact\nradius", "m", 4, [step.contact_radius for step in steps]
    if any(step.stick_radius is not None for step in steps):
        yield "stick\nradius", "m", 4, [step.stick_radius for step in steps]
        yield "energy\nlost", "J", 4, [step.dissipated_energy for step in steps]


def _components(
    name: str, unit: str, vectors: Sequence[Sequence[float] | NDArray[np.float64] | None]
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
