"""The key results of a run in the units of a person."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from contact_results.natural_sizes import ROUND_OFF, natural_size
from contact_results.number_text import Uncertainty, measured_like, number_text, uncertainty
from contact_scene.engineering_units import engineering_unit
from contact_scene.increment import SCALARS, State, components, numbers
from contact_scene.reported import Kind
from contact_scene.stated_error import StatedError, StatedErrors

if TYPE_CHECKING:
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
