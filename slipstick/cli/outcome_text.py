"""The key results of a run in the units of a person."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from contact_results.difference import largest_difference
from contact_scene.engineering_units import engineering_unit
from contact_scene.increment import SCALARS, State, components, numbers
from contact_scene.path_error import DoubledQuantity, PathError
from contact_scene.reported import Kind

if TYPE_CHECKING:
    import semi_analytical
    from contact_results.surface import Result

FIRST, LAST = 10, 10  # of a long history, the steps that are shown
DIGITS = 5
NEGLIGIBLE = 1e-9  # of the largest value of a vector: round-off, shown as nothing

Values = list[float | None]
Shown = TypeVar("Shown")


def solved_in(result: Result, seconds: float) -> Iterator[tuple[str, str]]:
    """How well it was solved, and how long that took."""
    worst = np.max([increment.worst_residual for increment in result.increments])
    yield "tolerance", f"{result.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def saving(
    planned: semi_analytical.Result, forced: semi_analytical.Result
) -> Iterator[tuple[str, str]]:
    """What forcing all effects on has cost, and that it changed nothing."""
    few, many = (sum(i.convolutions for i in r.increments) for r in (planned, forced))
    yield "all effects", f"{many} convolutions; as planned {few}, a ratio of {many / few:.1f}"
    yield "difference", f"{largest_difference(planned, forced):.1e} of pressure and approach"


def outcome_columns(ends: Sequence[State]) -> dict[str, list[str]]:
    """Headings and texts, one per loading step; effects that are off have no column.

    Of a long history the beginning and the end, with an ellipsis between them.
    """
    numbered, gap = _shown(list(enumerate(ends, 1)))
    columns = {"step": [str(number) for number, _ in numbered]}
    for name, unit, values in _quantities([end for _, end in numbered]):
        known = [abs(v) for v in values if v is not None]
        scale = engineering_unit(float(np.max(known, initial=0.0)), unit)
        texts = ["–" if v is None else f"{v / scale.size:.{DIGITS}g}" for v in values]
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
    largest = np.max([abs(step[name].value) for step in found if name in step])
    if quantity is None or largest == 0 or quantity.error <= NEGLIGIBLE * largest:
        return "–"
    return f"{quantity.error / largest:.1e}"


def _shown(steps: Sequence[Shown]) -> tuple[list[Shown], int | None]:
    """The steps to show, and where some are left out."""
    if len(steps) <= FIRST + LAST + 1:
        return list(steps), None
    return [*steps[:FIRST], *steps[-LAST:]], FIRST


def _quantities(steps: Sequence[State]) -> Iterator[tuple[str, str, Values]]:
    """Name, unit and values of every key quantity that the steps have; the y component of a vector
    where there is one, without its round-off."""
    rows = [numbers(step) for step in steps]
    for name, mark in SCALARS.items():
        parts = components(name)
        found = [[row[part] for row in rows] for part in parts]
        known = [abs(value) for values in found for value in values if value is not None]
        if not mark.key or not known:
            continue
        first, _, rest = name.partition("_")
        for axis, values in zip(("x", "y"), found, strict=False):
            vector = mark.kind is Kind.VECTOR
            cut = [_cut(value, NEGLIGIBLE * np.max(known) if vector else 0.0) for value in values]
            if axis == "x" or any(cut):
                yield f"{first}\n{rest}{f' {axis}' if vector else ''}", mark.unit, cut


def _cut(value: float | None, negligible: float) -> float | None:
    return 0.0 if value is not None and abs(value) <= negligible else value
