"""Error estimates of reported numbers, and the accuracy that a run reached."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from contact_scene.reading.description import Description

Size: TypeAlias = Annotated[float, Field(ge=0)]
# One number, or one for each component of a vector.
Amount: TypeAlias = Size | tuple[Size, Size]

# Sources of an error.
Part: TypeAlias = Literal[
    "cells",
    "increments",
    "tolerance",
    "elements",
    "section",
    "penalty",
    "harmonics",
    "quadrature",
    "map",
    "neglected",
]


class ErrorStatus(StrEnum):
    """Reliability of a stated error."""

    ESTIMATED = "estimated"
    # Refinement levels contradict each other, or the contact is too small for its grid: the error
    # is at best an order of magnitude.
    NOT_CONVERGED = "not converged"
    # The load prescribes the number.
    EXACT = "exact"


class StatedError(Description):
    """Error of one scalar at the end of a step, in the unit of the scalar."""

    error: Amount | None
    """Error bound, the sum of its parts: the true error is smaller in at least 95 of 100 cases. Two
    numbers for a vector; null without an estimate."""

    parts: dict[Part, Amount]
    """Contribution of each source: cells, increments, tolerance; elements, section, penalty,
    harmonics; quadrature; points of a measured indenter; neglected effects."""

    status: ErrorStatus
    """Status of the error: "estimated"; "not converged" for an unreliable number; "exact" for a
    number that the load prescribes."""

    reason: str | None = None
    """Reason why the error is "not converged"; null for other numbers."""


EXACT = StatedError.model_construct(error=0.0, parts={}, status=ErrorStatus.EXACT)


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
    """Error estimates of the scalars of a result, and the coarse solves behind the estimates.

    A coarse solve solves the same scene with fewer cells, elements, rings or increments.

    steps          errors of each load step, by the names of the scalars
    coarse_solves  coarse solves of the scene
    shear          error of the shear traction by the increments at the end of each load step: its
                   root mean square over the surface, relative to that of the shear; None if unknown
    """

    steps: tuple[Mapping[str, StatedError], ...]
    coarse_solves: tuple[CoarseSolveRecord, ...]
    shear: tuple[float | None, ...]


class AccuracySettings(Description):
    """Discretisation of a run."""

    cells: tuple[int, int] | None = None
    """Number of cells along x and y; null for finite elements."""

    elements_per_radius: int | None = None
    """Elements over the contact radius; null for cells."""

    ring_factor: float | None = None
    """Factor on the orders and points that the radial solver chooses; null for other solvers."""

    increments: tuple[int, ...]
    """Number of increments of every step."""

    tolerance: float
    """Limit of every residual."""


class AccuracyReached(Description):
    """Requested and reached accuracy. Errors are relative to the largest value of a quantity in the
    history."""

    asked: dict[str, Size]
    """Largest allowed error of every limited quantity."""

    reached: dict[str, Size | None]
    """Largest stated error of every limited quantity; null without an estimate."""

    met: bool
    """True if all errors are within their limits and all numbers have converged."""

    settings: AccuracySettings
    """Discretisation of the run."""

    rounds: Annotated[int, Field(ge=1)]
    """Number of refinement levels that were solved."""

    left_out: dict[str, str]
    """Quantities that `overall` does not limit, with the reason."""

    stopped: str | None
    """Reason why the accuracy was not met; null if it was met."""
