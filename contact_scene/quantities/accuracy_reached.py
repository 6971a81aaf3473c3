"""How an accuracy that was asked for was met: part of the summary of a run."""

from typing import Annotated

from pydantic import Field

from contact_scene.quantities.stated_error import Size
from contact_scene.reading.description import Description


class AccuracySettings(Description):
    """How fine the run is that was kept."""

    cells: tuple[int, int] | None = None
    """Number of cells along x and y; null for finite elements."""

    elements_per_radius: int | None = None
    """Elements over the contact radius; null for cells."""

    ring_factor: float | None = None
    """Multiple of the rings (orders, points) that the radial solver chooses; null for others."""

    increments: tuple[int, ...]
    """Increments of every step."""

    tolerance: float
    """Bound of every residual."""


class AccuracyReached(Description):
    """What was asked for, and what came of it. Errors are relative to the largest value that a
    quantity has in the history."""

    asked: dict[str, Size]
    """Largest error of every quantity that is bound."""

    reached: dict[str, Size | None]
    """Largest stated error of each; null where nothing can be said."""

    met: bool
    """Whether all are met, with converged numbers."""

    settings: AccuracySettings
    """How fine the run is."""

    rounds: Annotated[int, Field(ge=1)]
    """How many runs were solved, ever finer ones."""

    left_out: dict[str, str]
    """Quantities that are not bound, and why."""

    stopped: str | None
    """Why it was not met; null where it was."""
