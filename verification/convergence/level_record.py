"""What one level of refinement gave, whoever solved it."""

from __future__ import annotations

from contact_scene.description import Description
from verification.convergence.stored_field import StoredField

PRESSURE, SHEAR = "pressure", "shear"


class LevelRecord(Description):
    """The end of the studied step on one level."""

    size: float
    """h: side of a cell [length], or dimensionless: what the level refines."""

    level: str
    """The grid, the mesh or what else is refined, in words."""

    increments: tuple[int, ...]
    values: dict[str, float]
    """Scalars by the names of `summary.json`, components with x or y; the undefined left out."""

    fields: dict[str, StoredField]
    """Tractions, by PRESSURE and SHEAR."""

    largest_residual: float
    work: dict[str, int]
    """Counted work, by what is counted."""

    seconds: float
