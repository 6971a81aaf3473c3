"""Declarations of observed orders of convergence that a verification case judges.

A declaration names the quantity, the refinement levels, the expected order and its reason.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from verification.convergence.observed_order import ORDER_WIDTH


class Followed(StrEnum):
    """Quantities whose error is followed under refinement, to determine an order of convergence."""

    PRESSURE = "pressure"
    PEAK_PRESSURE = "peak pressure"
    APPROACH = "approach"
    CONTACT_RADIUS = "contact radius"
    SHEAR = "shear"
    SHIFT = "tangential shift"
    TWIST = "twist"
    ENERGY = "dissipated energy"


class Refinement(StrEnum):
    """Discretisation parameters that are refined from level to level: the mesh or the
    increments."""

    MESH = "mesh"
    INCREMENTS = "increments"


@dataclass(frozen=True)
class NotYetAsymptotic:
    """Allowance for an observed order of convergence on levels that are too coarse for the theory.

    allowance  accepted difference from the expected order
    because    cause of the difference

    The tolerance of the order is the larger of the allowance and the interval of the order, not
    their sum. Raises ValueError for an allowance that any order would meet.
    """

    allowance: float
    because: str

    def __post_init__(self) -> None:
        if not 0 < self.allowance < ORDER_WIDTH:
            raise ValueError(f"got {self.allowance}; an order judged to {ORDER_WIDTH} needs less")


@dataclass(frozen=True)
class OrderOfConvergence:
    """Order at which the error of a quantity falls with the cell or element size h, and its
    expectation.

    of        quantity whose order is determined
    meaning   description of the error
    levels    labels of the runs, coarse to fine; runs with cells of one size form one level, with
              the root mean square of their errors
    error     function from the result of a run to its error, of either sign
    expected  exponent p of h^p according to theory
    because   reason for the expected order
    not_yet   allowance for levels that are not asymptotic; None if there is no known reason
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
    """Order at which the differences between successive refinement levels fall, and its
    expectation.

    Used where the exact answer is not known, or contains the error of another kind of refinement.
    The differences fall with the order of the error.

    of        quantity whose order is determined
    refined   discretisation parameter that is refined
    meaning   description of the difference
    levels    labels of the runs, coarse to fine
    change    difference > 0 between the results of two levels; the ratio of their sizes is constant
    size      function from a result to its discretisation parameter h
    expected  exponent p of h^p according to theory
    because   reason for the expected order
    not_yet   allowance for levels that are not asymptotic; None if there is no known reason
    apart     distance between the two compared levels in the list of levels
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
