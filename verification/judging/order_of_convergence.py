"""An order of convergence that a case judges: what is followed, over which levels, and why."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from verification.convergence.observed_order import ORDER_WIDTH


class Followed(StrEnum):
    """Quantities compared under refinement."""

    PRESSURE = "pressure"
    PEAK_PRESSURE = "peak pressure"
    APPROACH = "approach"
    CONTACT_RADIUS = "contact radius"
    SHEAR = "shear"
    SHIFT = "tangential shift"
    TWIST = "twist"
    ENERGY = "dissipated energy"


class Refinement(StrEnum):
    """Discretisation parameter that is refined."""

    MESH = "mesh"
    INCREMENTS = "increments"


@dataclass(frozen=True)
class NotYetAsymptotic:
    """Allowed difference from the expected order on levels that are not asymptotic, with its cause.

    The larger of the allowance and the order's interval counts, not their sum. Raises ValueError
    for an allowance that any order would meet."""

    allowance: float
    because: str

    def __post_init__(self) -> None:
        if not 0 < self.allowance < ORDER_WIDTH:
            raise ValueError(f"got {self.allowance}; an order judged to {ORDER_WIDTH} needs less")


@dataclass(frozen=True)
class OrderOfConvergence:
    """The rate at which an error falls with the cell side, against the rate theory expects.

    of        the quantity that it is an order of
    levels    coarse to fine; runs with cells of one size are one level, and count by the root
              mean square of their errors
    error     error on one run, of either sign
    expected  order p of h^p
    because   why this order
    not_yet   what keeps these levels from it; None where nothing is known to
    """

    name: str
    of: Followed
    meaning: str
    levels: tuple[str, ...]
    error: Callable[[Any], float]
    expected: float
    because: str
    not_yet: NotYetAsymptotic | None = None


@dataclass(frozen=True)
class OrderOfChange:
    """The rate at which neighbouring levels approach each other, where the exact answer is not
    known or has the error of another kind of refinement: a change falls with the order of the
    error.

    of        the quantity that it is an order of
    refined   what the levels refine
    levels    coarse to fine
    change    from the first of two levels to the second, > 0; the second finer by one factor
    size      what is refined, h of a level
    expected  order p of h^p
    because   why this order
    not_yet   what keeps these levels from it; None where nothing is known to
    apart     levels from the first of a change to the second
    """

    name: str
    of: Followed
    refined: Refinement
    meaning: str
    levels: tuple[str, ...]
    change: Callable[[Any, Any], float]
    size: Callable[[Any], float]
    expected: float
    because: str
    not_yet: NotYetAsymptotic | None = None
    apart: int = 1
