"""Key numbers of load steps and load cycles as texts, for tables, pages and figures.

Each number has a suitable unit and its stated error. Round-off is shown as zero.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

import numpy as np

from contact_results.number_text import (
    Uncertainty,
    doubt_texts,
    number_text,
    uncertainty,
    unit_group,
)
from contact_results.radial_method import radial_advice
from contact_results.result_report import ResultReport
from contact_scene.quantities.field_metadata import Kind
from contact_scene.quantities.increment import (
    SCALARS,
    State,
    components,
    numbers,
)
from contact_scene.quantities.per_length import shown_name, shown_unit
from contact_scene.quantities.round_off import ROUND_OFF, natural_size
from contact_scene.quantities.stated_error import StatedError
from contact_scene.quantities.summary import OF_CYCLES
from contact_scene.reading.engineering_units import EngineeringUnit, engineering_unit

# steps shown of a long history
FIRST = 10
LAST = 10

Errors = Mapping[str, StatedError]
Shown = TypeVar("Shown")


class _Column(NamedTuple):
    """Column of the table of key numbers: one scalar at the shown load steps, with its errors.

    heading  name of the scalar, with a line break
    like     group of the column; columns of one group share their engineering unit
    unit     SI unit of the entries
    entries  value and stated error at each shown load step
    """

    heading: str
    like: str  # columns with equal entries share their unit
    unit: str
    entries: list[tuple[float | None, Uncertainty | None]]


def outcome_columns(
    ends: Sequence[State], errors: Sequence[Errors] | None = None
) -> dict[str, list[str]]:
    """Return the table of key numbers with one row per load step, as columns by heading.

    An effect that is off has no column. A long history shows its first and last load steps.

    ends    states at the ends of the load steps
    errors  stated errors of every load step, by name; a question mark follows an error that has not
            converged
    """
    stated: Sequence[Errors] = errors if errors is not None else [{}] * len(ends)
    numbered, gap = _select_rows(list(enumerate(zip(ends, stated, strict=True), 1)))
    first = {"step": [str(number) for number, _ in numbered]}
    return _column_texts(first, _quantity_columns([end for _, end in numbered], ends), gap)


def _column_texts(
    first: dict[str, list[str]], columns: Iterable[_Column], gap: int | None
) -> dict[str, list[str]]:
    texts = first | {f"{heading}\n{unit}": texts for heading, unit, texts in _number_texts(columns)}
    if gap is not None:
        for column in texts.values():
            column.insert(gap, "…")
    return texts


def key_numbers(history: Sequence[State], errors: Errors | None) -> Iterator[tuple[str, str]]:
    """Yield name and text of each key number at the end of a load history.

    The text contains value, stated error and unit.

    history  states at the ends of the load steps
    errors   stated errors of the last load step, by name; None if they were not computed
    """
    for heading, unit, (text,) in _number_texts(
        _quantity_columns([(history[-1], errors or {})], history)
    ):
        yield heading.replace("\n", " ").strip(), f"{text} {unit}"


def _number_texts(columns: Iterable[_Column]) -> Iterator[tuple[str, str, list[str]]]:
    """Yield heading, unit and number texts of each column of a table."""
    shown = list(columns)
    for column in shown:
        alike = [other.entries for other in shown if other.like == column.like]
        sizes = [abs(value) for entries in alike for value, _ in entries if value is not None]
        size = float(np.max(sizes, initial=0.0))
        scale = PRODUCTS.get(column.unit) or engineering_unit(size, column.unit)
        texts = [number_text(value, error, scale.size) for value, error in column.entries]
        yield column.heading, scale.name, texts


def _select_rows(steps: Sequence[Shown]) -> tuple[list[Shown], int | None]:
    """Select the first FIRST and the last LAST rows; return them with the place of the gap."""
    if len(steps) <= FIRST + LAST + 1:
        return list(steps), None
    return [*steps[:FIRST], *steps[-LAST:]], FIRST


def _quantity_columns(
    steps: Sequence[tuple[State, Errors]], history: Sequence[State]
) -> Iterator[_Column]:
    """Yield the table column of each key quantity that has a value, with round-off replaced by 0.

    The y component of a vector has a column only if a shown load step has a non-zero value.

    steps    rows of the table: state at the end of a load step, and its stated errors
    history  states at the ends of all load steps, which determine the limit of round-off
    """
    rows = [numbers(step) for step, _ in steps]
    line = bool(history) and history[0].is_line
    for name, mark in SCALARS.items():
        parts = components(name)
        found = [[row[part] for row in rows] for part in parts]
        known = [abs(value) for values in found for value in values if value is not None]
        if not mark.key or not known:
            continue
        shown, unit = shown_name(name, line=line), shown_unit(mark.unit, line=line)
        first, *rest = shown.split("_")
        for axis, values in zip("xy", found, strict=False):
            vector = mark.kind is Kind.VECTOR
            least = ROUND_OFF * max(known) if vector else 0.0
            least = max(least, ROUND_OFF * natural_size(history, mark.unit))
            cut = [_without_round_off(value, least) for value in values]
            if axis == "x" or any(cut):
                heading = f"{first}\n{' '.join(rest)}{f' {axis}' if vector else ''}"
                errors = [uncertainty(of_step.get(name), axis) for _, of_step in steps]
                like = unit_group(f"{shown} {axis}" if vector else shown)
                yield _Column(heading, like, unit, list(zip(cut, errors, strict=True)))


def _without_round_off(value: float | None, negligible: float) -> float | None:
    return 0.0 if value is not None and abs(value) <= negligible else value


# Symbols of the numbers of load cycles in tables, and units of Ruiz's parameters and of areas.
SYMBOLS = {
    **{"energy_per_cycle": "E_d", "force_amplitude": "Q*", "actuator_amplitude": "δ*"},
    **{"shift_amplitude": "δ", "loop_opening": "δ_g", "energy_ratio": "A"},
    **{"energy_friction": "µ_e", "limit_share": "Q*/µW", "gross_slip_share": "to gross\nslip"},
    **{"slip_amplitude": "slip\namplitude", "ruiz_f1": "F1", "ruiz_f2": "F2"},
    "stick_centre": "centre of\nstick",
}
# Line below the table on a terminal. The page of a run explains all symbols.
LOOPS = "E_d: energy per cycle; δ_g: half opening of the loop; A = E_d/4Q*δ*; µ_e = E_d/4Wδ_g"
# Numbers in tables: those of load steps, and those of load cycles.
SHOWN = (*(name for name, mark in SCALARS.items() if mark.key), *SYMBOLS)
PRODUCTS = {
    "Pa m": EngineeringUnit(1e3, "MPa mm"),
    "Pa^2 m": EngineeringUnit(1e9, "MPa² mm"),
    "m^2": EngineeringUnit(1e-6, "mm²"),
}


def cycle_columns(report: ResultReport) -> dict[str, list[str]]:
    """Return the table of closed load cycles with one row per cycle, as columns by heading.

    A long history shows its first and last cycles. The table is empty without load cycles.
    """
    if not report.cycles:
        return {}
    shown, gap = _select_rows(report.cycles)
    rows = [cycle.numbers for cycle in shown]
    stated = [report.errors_of(cycle) for cycle in shown]
    first = {
        "cycle": [
            f"{cycle.cycle.start + 1}–{cycle.cycle.end}{' (first)' * row['from_virgin']}"
            for cycle, row in zip(shown, rows, strict=True)
        ],
        "regime": [str(row["regime"].value) for row in rows],
    }
    columns = []
    for name, symbol in SYMBOLS.items():
        mark, found = OF_CYCLES[name], [row.get(name) for row in rows]
        for axis in "xy" if mark.kind is Kind.VECTOR else " ":
            values = [v["xy".index(axis)] if isinstance(v, tuple) else v for v in found]
            known = [abs(value) for value in values if value is not None]
            if not known or (mark.kind is Kind.VECTOR and not any(known)):
                continue
            bars = [uncertainty(of_step.get(name), axis) for of_step in stated]
            heading = f"{symbol} {axis}".strip()
            unit = shown_unit(mark.unit, line=report.scene.indenter.is_line)
            columns.append(_Column(heading, heading, unit, [*zip(values, bars, strict=True)]))
    return _column_texts(first, columns, gap)


def doubts_of(report: ResultReport) -> list[str]:
    """Return the reasons of the question marks in the tables, and advice on another solver.

    The advice is given beside a question mark, or if a requested accuracy is not met.
    """
    doubts = doubt_texts(report.step_errors or (), SHOWN)
    doubted = bool(doubts) or (report.accuracy is not None and not report.accuracy.met)
    return [*doubts, *radial_advice(report.scene, report.result.solver, doubted=doubted)]
