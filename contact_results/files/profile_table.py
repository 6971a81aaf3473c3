"""`profiles.csv`: tractions, gap and slip along a line of the surface at the end of every step."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from contact_results.directory.file_names import PROFILES
from contact_results.files.csv_file import STEP, Column, write_table
from contact_results.surface import Rings, surface_of

if TYPE_CHECKING:
    from contact_results.surface import Increment, Result, Surface

LINE = "on the line y = 0 of cells; of rings on the line through the axis along the tangential load"
VECTORS = {
    "shear": ("Pa", "tangential traction on the lower body"),
    "slip": ("m", "slip of the lower body against the indenter since the start"),
}
SCALARS = {
    "pressure": ("Pa", "Normal traction, positive in compression."),
    "gap": ("m", "Distance of the deformed surfaces; empty where they never touch."),
    "in_stick": (
        "",
        "1 in contact and sticking, 0 slipping or out of contact; 0.5 if so on one side only of a "
        "line that runs between two rows of cells.",
    ),
    "dissipation": ("J/m^2", "Energy per area lost to friction since the start."),
}
COLUMNS = (
    STEP,
    Column("x", "m", f"Place {LINE}."),
    Column("y", "m", f"Place {LINE}."),
    *(
        Column(f"{name}_{axis}", unit, f"Component along {axis} of the {meaning}.")
        for name, (unit, meaning) in VECTORS.items()
        for axis in ("x", "y")
    ),
    *(Column(name, unit, meaning) for name, (unit, meaning) in SCALARS.items()),
)


def write_profiles(result: Result, directory: Path) -> None:
    """Write one row per place, the same columns for every solver; what an increment does not have
    is empty, and so is what is infinite."""
    surface = surface_of(result)
    if isinstance(surface, Rings):
        surface = surface.on_both_sides()
    rows = (row for step in result.steps for row in _rows(surface, step))
    write_table(directory / PROFILES, COLUMNS, rows)


def _rows(surface: Surface, step: Increment) -> Iterator[tuple[object, ...]]:
    places = surface.line.places
    parts: list[Any] = [places * along for along in surface.direction]
    for name in VECTORS:
        vector = surface.vector(step, name)
        parts.extend((None, None) if vector is None else surface.along(vector))
    for name in SCALARS:
        field = surface.scalar(step, name) if hasattr(step, name) else None
        parts.append(None if field is None else surface.along(field.astype(np.float64)))
    columns = [_shown(part, len(places)) for part in parts]
    # Both sides of rings have the axis.
    twice = places.size // 2 - 1 if np.count_nonzero(places == 0) == 2 else None
    for number, row in enumerate(zip(*columns, strict=True)):
        if number != twice:
            yield (step.step, *row)


def _shown(values: Any, size: int) -> list[float | None]:
    """Python's numbers, zeros without a sign; nothing for what is not there or not finite."""
    if values is None:
        return [None] * size
    return [v + 0.0 if np.isfinite(v) else None for v in values.tolist()]
