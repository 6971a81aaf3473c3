"""The key results of a run in the units of a person."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from contact_results.natural_sizes import ROUND_OFF, natural_size
from contact_results.number_text import Uncertainty, measured_like, number_text, uncertainty
from contact_results.quantities import largest_difference
from contact_scene.engineering_units import engineering_unit
from contact_scene.increment import SCALARS, State, components, numbers
from contact_scene.path_error import DoubledQuantity, PathError
from contact_scene.reported import Kind
from contact_scene.stated_error import StatedError, StatedErrors

if TYPE_CHECKING:
    import semi_analytical
    from contact_results.surface import Result
    from contact_scene.accuracy_reached import AccuracyReached

FIRST, LAST = 10, 10  # of a long history, the steps that are shown
NEGLIGIBLE = 1e-9  # of the largest value of a vector: round-off, shown as nothing

Errors = Mapping[str, StatedError]
Shown = TypeVar("Shown")


class _Column(NamedTuple):
    """Values of one number in all steps, with their errors."""

    heading: str
    like: str  # those alike share their unit
    unit: str
    entries: list[tuple[float | None, Uncertainty | None]]


def solved_in(result: Result, seconds: float) -> Iterator[tuple[str, str]]:
    """How well it was solved, and how long that took."""
    worst = np.max([increment.worst_residual for increment in result.increments])
    yield "tolerance", f"{result.tolerance:.3g} (largest residual {worst:.1e})"
    yield "increments", f"{len(result.increments)} in {seconds:.2f} s"


def how_stated(stated: StatedErrors, seconds: float | None) -> Iterator[tuple[str, str]]:
    """Where the errors come from; in how many seconds, if they were measured apart."""
    made = " and ".join(dict.fromkeys(companion.differs for companion in stated.companions))
    yield "errors", f"from {made}" + ("" if seconds is None else f", in {seconds:.2f} s")
    for companion in stated.companions:
        if companion.refused:
            yield "", f"no answer with {companion.differs}: {companion.refused}"


def how_accurate(accuracy: AccuracyReached) -> Iterator[tuple[str, str]]:
    """What was asked for, and what was reached."""
    for name, share in accuracy.asked.items():
        outcome = against(share, accuracy.reached[name])
        yield ("accuracy" if name == next(iter(accuracy.asked)) else ""), f"{name} {outcome}"
    for why in dict.fromkeys(accuracy.left_out.values()):
        names = ", ".join(name for name, said in accuracy.left_out.items() if said == why)
        yield "", f"{names} not bound: {why}"
    rounds = f"{accuracy.rounds} round{'s' if accuracy.rounds != 1 else ''}"
    yield "", f"met in {rounds}" if accuracy.met else f"not met in {rounds}: {accuracy.stopped}"


def against(asked: float, reached: float | None) -> str:
    """An error beside the one that was asked for."""
    found = "not converged" if reached is None else f"reached {100 * reached:.2g} %"
    return f"asked {100 * asked:.3g} %, {found}"


def saving(
    planned: semi_analytical.Result, forced: semi_analytical.Result
) -> Iterator[tuple[str, str]]:
    """What forcing all effects on has cost, and that it changed nothing."""
    few, many = (sum(i.convolutions for i in r.increments) for r in (planned, forced))
    yield "all effects", f"{many} convolutions; as planned {few}, a ratio of {many / few:.1f}"
    yield "difference", f"{largest_difference(planned, forced):.1e} of pressure and approach"


def outcome_columns(
    ends: Sequence[State], errors: Sequence[Errors] | None = None
) -> dict[str, list[str]]:
    """Headings and texts, one per loading step; effects that are off have no column.

    Of a long history the beginning and the end, with an ellipsis between them.

    errors  of the numbers of every step, to be shown beside them; a question mark where one has not
            converged
    """
    stated: Sequence[Errors] = errors if errors is not None else [{}] * len(ends)
    numbered, gap = _shown(list(enumerate(zip(ends, stated, strict=True), 1)))
    columns = {"step": [str(number) for number, _ in numbered]}
    shown = list(_columns([end for _, end in numbered], ends))
    for column in shown:
        alike = [other.entries for other in shown if other.like == column.like]
        sizes = [abs(value) for entries in alike for value, _ in entries if value is not None]
        scale = engineering_unit(float(np.max(sizes, initial=0.0)), column.unit)
        texts = [number_text(value, error, scale.size) for value, error in column.entries]
        columns[f"{column.heading}\n{scale.name}"] = texts
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


def _columns(steps: Sequence[tuple[State, Errors]], history: Sequence[State]) -> Iterator[_Column]:
    """A column for every key quantity that the steps have, and for the y component of a vector
    where there is one, without what is round-off in this history."""
    rows = [numbers(step) for step, _ in steps]
    for name, mark in SCALARS.items():
        parts = components(name)
        found = [[row[part] for row in rows] for part in parts]
        known = [abs(value) for values in found for value in values if value is not None]
        if not mark.key or not known:
            continue
        first, _, rest = name.partition("_")
        for axis, values in zip("xy", found, strict=False):
            vector = mark.kind is Kind.VECTOR
            least = NEGLIGIBLE * max(known) if vector else 0.0
            least = max(least, ROUND_OFF * natural_size(history, mark.unit))
            cut = [_cut(value, least) for value in values]
            if axis == "x" or any(cut):
                heading = f"{first}\n{rest}{f' {axis}' if vector else ''}"
                errors = [uncertainty(of_step.get(name), axis) for _, of_step in steps]
                like = measured_like(f"{name} {axis}" if vector else name)
                yield _Column(heading, like, mark.unit, list(zip(cut, errors, strict=True)))


def _cut(value: float | None, negligible: float) -> float | None:
    return 0.0 if value is not None and abs(value) <= negligible else value
