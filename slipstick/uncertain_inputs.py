"""Uncertainty of the results of a scene by its inputs, of which value and deviation are given.

A result Q changes by (Q(v + d) - Q(v - d))/2 with one deviation d of an input v, from two more
solves. Changes by independent inputs add as squares (JCGM 100:2008, 5.1.2).
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import hypot, inf
from pathlib import Path
from typing import Any

from contact_results.directory.atomic_file import atomic_file
from contact_results.key_numbers import PRODUCTS, SHOWN
from contact_results.number_text import Uncertainty, number_text, uncertainty
from contact_scene.quantities.field_metadata import Kind, reported
from contact_scene.quantities.per_length import shown_name, shown_unit
from contact_scene.quantities.summary import StepSummary
from contact_scene.reading.engineering_units import engineering_unit
from contact_scene.reading.scene_error import Problem, SceneError, shown

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_INPUT = re.compile(
    rf"\s*(?P<key>[^\s=]+)\s*=\s*(?P<value>{NUMBER})\s*(?:±|\+/?-)\s*(?P<deviation>{NUMBER})"
    r"\s*(?P<unit>[^\s\d.].*?)?\s*"
)
EXPECTED = "key=value±deviation, such as body.layers[1].thickness=388±20 um (or +-)"
DIGITS = 12  # of a changed value: 0.11 and not 0.11000000000000001


@dataclass(frozen=True)
class UncertainInput:
    """Value of one key of a scene with its standard deviation.

    key               key of the scene file
    value, deviation  numbers in the unit
    unit              unit; empty for a dimensionless key
    """

    key: str
    value: float
    deviation: float
    unit: str

    def override(self, deviations: int = 0) -> str:
        """Return the assignment of the value plus a number of deviations to the key."""
        return override_text(self.key, self.value + deviations * self.deviation, self.unit)


def override_text(key: str, value: float, unit: str) -> str:
    """Return the assignment of a value to a key; the unit is empty for pure numbers."""
    number = f"{value:.{DIGITS}g}"
    return f'{key}="{number} {unit}"' if unit else f"{key}={number}"


def read_inputs(text: str) -> tuple[UncertainInput, ...]:
    """Read the uncertain inputs in a text such as "friction.coefficient=.1±.01".

    text  inputs, separated by commas; each is a key, value, ± or +-, deviation, and unit

    Raises SceneError for another text, a deviation of 0 or less, an infinite number, and a repeated
    key.
    """
    found: dict[str, UncertainInput] = {}
    for item in text.split(","):
        match = _INPUT.fullmatch(item)
        if (
            match is None
            or not 0 < float(match["deviation"]) < inf
            or not abs(float(match["value"])) < inf
            or match["key"] in found
        ):
            raise SceneError([Problem(("--inputs",), f"got {shown(item.strip())}", EXPECTED)])
        value, deviation = float(match["value"]), float(match["deviation"])
        found[match["key"]] = UncertainInput(match["key"], value, deviation, match["unit"] or "")
    return tuple(found.values())


def changed_overrides(inputs: Sequence[UncertainInput]) -> list[tuple[list[str], list[str]]]:
    """Return the assignments for one deviation less and more of each input.

    The other inputs keep their values.
    """
    own = [one.override() for one in inputs]
    return [([*own, one.override(-1)], [*own, one.override(1)]) for one in inputs]


@dataclass(frozen=True)
class UncertainNumber:
    """Scalar result with its numerical error and its changes by uncertain inputs, in its SI unit.

    name     name of the scalar, with _x or _y for a component
    unit     SI unit
    value    value in the scene
    error    stated numerical error, of size None if it is unknown; None if the number is exact
    changes  change by one deviation of each input
    """

    name: str
    unit: str
    value: float
    error: Uncertainty | None
    changes: tuple[float, ...]

    @property
    def by_inputs(self) -> float:
        """Standard deviation by all inputs, which are independent."""
        return hypot(*self.changes)


def uncertain_numbers(
    own: StepSummary, changed: Sequence[tuple[StepSummary, StepSummary]], *, line: bool
) -> tuple[UncertainNumber, ...]:
    """Compute the uncertainty of the scalars that a run shows, as far as the inputs change them.

    own      last load step of the run
    changed  last load step with one deviation less and more of each input
    line     True for a line contact
    """
    found = []
    scalars = reported(StepSummary)
    for name, annotation in ((name, scalars[name]) for name in SHOWN if name in scalars):
        for axis in "xy" if annotation.kind is Kind.VECTOR else ("",):
            value, *others = (
                _component(getattr(step, name), axis) for step in (own, *sum(changed, ()))
            )
            if value is None or None in others:
                continue
            changes = tuple((b - a) / 2 for a, b in zip(others[::2], others[1::2], strict=True))
            if any(changes):
                label = shown_name(f"{name}_{axis}" if axis else name, line=line)
                unknown = Uncertainty(None, converged=False)
                stated = own.errors
                error = uncertainty(stated.get(name), axis or "x") if stated else unknown
                unit = shown_unit(annotation.unit, line=line)
                found.append(UncertainNumber(label, unit, value, error, changes))
    return tuple(found)


def _component(value: Any, axis: str) -> Any:
    return value["xy".index(axis)] if axis and value is not None else value


def uncertainty_columns(
    inputs: Sequence[UncertainInput], numbers: Sequence[UncertainNumber]
) -> Mapping[str, list[str]]:
    """Return the table of uncertain numbers, as columns by heading.

    The digits of a number follow from the larger of its two uncertainties.
    """
    heads = ["number", "value", "numerical", "by inputs", *(f"by {one.key}" for one in inputs)]
    rows = []
    for one in numbers:
        unit = PRODUCTS.get(one.unit) or engineering_unit(abs(one.value), one.unit)
        numerical = one.error.size if one.error else 0.0
        both = max(one.by_inputs, numerical or 0.0)
        value = number_text(one.value, Uncertainty(both, True), unit.size).partition(" ±")[0]
        name = one.name.replace("_", " ")
        row = [f"{name} ({unit.name})" if one.unit else name, value]
        row.append("?" if numerical is None else f"{numerical / unit.size:.2g}")
        row += [f"{change / unit.size:.2g}" for change in (one.by_inputs, *one.changes)]
        rows.append(row)
    return dict(zip(heads, map(list, zip(*rows, strict=True)), strict=True)) if rows else {}


def write_uncertainties(
    inputs: Sequence[UncertainInput], numbers: Sequence[UncertainNumber], path: Path
) -> None:
    """Write the inputs and the uncertain numbers in SI units as JSON."""
    record = {
        "inputs": [vars(one) for one in inputs],
        "numbers": {
            one.name: {
                "unit": one.unit,
                "value": one.value,
                "numerical": one.error.size if one.error else 0.0,
                "by_inputs": one.by_inputs,
                "changes": dict(zip((each.key for each in inputs), one.changes, strict=True)),
            }
            for one in numbers
        },
    }
    with atomic_file(path) as temporary:
        temporary.write_text(
            json.dumps(record, indent=1, ensure_ascii=False, allow_nan=False) + "\n",
            encoding="utf-8",
            newline="\n",
        )
