"""`profiles.csv`: tractions, gap and slip over the surface at the end of every step, in SI."""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.directory.file_names import PROFILES
from contact_results.surface import Cells, surface_of
from contact_scene.reported import Kind, reported

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result

Column = list[object]


def write_profiles(result: Result, directory: Path) -> None:
    """Write one row per cell of the line y = 0, or per ring and, where there are several, angle.

    Numbers have as many digits as it takes to read the same number again; what an increment does
    not have is empty, and so is what is infinite.
    """
    surface = surface_of(result)
    ends: Sequence[Increment] = result.steps
    with open(directory / PROFILES, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        for number, step in enumerate(ends):
            columns = _on_line(surface, step) if isinstance(surface, Cells) else _on_rings(step)
            if number == 0:
                table.writerow(("step", *columns))
            table.writerows((step.step, *row) for row in zip(*columns.values(), strict=True))


def _on_line(cells: Cells, step: Increment) -> dict[str, Column]:
    columns: dict[str, Column] = {"x": cells.x.tolist(), "y": [0.0] * len(cells.x)}
    for name, values in _fields(step):
        parts = ("",) if name not in VECTORS else ("_x", "_y")
        along = None if values is None else cells.along(values).reshape(len(parts), -1)
        for number, part in enumerate(parts):
            columns[name + part] = _shown(None if along is None else along[number], len(cells.x))
    return columns


def _on_rings(step: Any) -> dict[str, Column]:
    """Rings and angles as the step has them; no angle where a function of the radius says all."""
    shape = step.pressure.shape
    around = None if step.angles is None else np.broadcast_to(step.angles, shape).ravel()
    radii = np.broadcast_to(step.radii.reshape(-1, *[1] * (len(shape) - 1)), shape)
    columns = {"radius": radii.ravel().tolist(), "angle": _shown(around, radii.size)}
    return columns | {
        name: _shown(None if values is None else values.ravel(), radii.size)
        for name, values in _fields(step)
    }


VECTORS = ("shear", "slip")


def _fields(step: Increment) -> Iterator[tuple[str, Any]]:
    """The fields that a person looks at first."""
    for name, mark in reported(type(step)).items():
        if mark.kind is Kind.FIELD and mark.key:
            yield name, getattr(step, name)


def _shown(values: Any, size: int) -> Column:
    """Python's numbers; nothing for what is not there or not finite."""
    if values is None:
        return [None] * size
    whole = values.astype(int) if values.dtype == bool else values
    return [v if np.isfinite(v) else None for v in whole.tolist()]
