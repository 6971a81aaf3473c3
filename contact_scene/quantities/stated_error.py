"""How far a reported number may be from the exact answer of its scene."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_scene.reading.description import Description

Size: TypeAlias = Annotated[float, Field(ge=0)]
# One number, or one for x and one for y of a vector.
Amount: TypeAlias = Size | tuple[Size, Size]

# Where an error comes from.
Part: TypeAlias = Literal[
    "cells",
    "increments",
    "tolerance",
    "elements",
    "section",
    "penalty",
    "harmonics",
    "quadrature",
    "neglected",
]


class ErrorStatus(StrEnum):
    """What a stated error is worth."""

    ESTIMATED = "estimated"
    # The levels contradict one another, or the contact is too small for what it is computed on:
    # the error is an order of magnitude at best.
    NOT_CONVERGED = "not converged"
    # The load prescribes the number.
    EXACT = "exact"


class StatedError(Description):
    """Error of one scalar at the end of a step, in the unit of the scalar."""

    error: Amount | None
    """Bound that the true error keeps in at least 95 of 100 cases, the sum of its parts; two
    numbers for a vector; null where nothing can be said."""

    parts: dict[Part, Amount]
    """What cells, increments, tolerance; elements, section, penalty, harmonics; quadrature
    contribute."""

    status: ErrorStatus
    """Whether the error is estimated, the number has not converged, or it is exact because the
    load prescribes it."""


EXACT = StatedError(error=0.0, parts={}, status=ErrorStatus.EXACT)


class CoarseSolveRecord(Description):
    """Coarse solve of the same scene, for the error estimate alone. Its work is not part of the
    counts of any step."""

    differs: str
    """Difference from the run: half the cells, other increments."""

    cells: tuple[int, int] | None = None
    """Its number of cells along x and y; null for finite elements."""

    elements_per_radius: int | None = None
    """Its elements over the contact radius; null for cells."""

    ring_factor: float | None = None
    """Its multiple of the rings (orders, points) that the radial solver chooses; null for
    others."""

    increments: tuple[int, ...]
    """Its increments in every step."""

    iterations: int | None = None
    """Its iterations; null where it gave no result."""

    convolutions: int | None = None
    """Its convolutions; null for finite elements and where it gave no result."""

    refused: str | None = None
    """Why it gave no result; null where it gave one."""


@dataclass(frozen=True)
class StatedErrors:
    """Errors of every step of a result by the names of its scalars, and their coarse
    solves."""

    steps: tuple[Mapping[str, StatedError], ...]
    coarse_solves: tuple[CoarseSolveRecord, ...]


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
