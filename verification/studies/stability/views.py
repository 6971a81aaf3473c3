"""Which cells the map has: two-dimensional views of it, each over two of the coordinates."""

from __future__ import annotations

from dataclasses import replace

from verification.judging.case import Level
from verification.studies.stability.cell import StabilityCell
from verification.studies.stability.section_views import section_views
from verification.studies.stability.surface_views import surface_views
from verification.studies.stability.view import View


def views(level: Level, cells: int) -> tuple[View, ...]:
    """The views of a level.

    cells  of a surface grid along each side; sections have as many elements as `pose` makes of it
    """
    made = surface_views(level) + section_views(level)
    return tuple(replace(v, cells=tuple(replace(c, cells=cells) for c in v.cells)) for v in made)


def study_cells(level: Level, cells: int) -> tuple[StabilityCell, ...]:
    """Every cell of a level, once."""
    found = {cell.name: cell for view in views(level, cells) for cell in view.cells}
    return tuple(found.values())
