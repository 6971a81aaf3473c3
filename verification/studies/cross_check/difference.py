"""How far the solvers are apart, with what each of them owns up to."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from verification.judging.outcome import Status
from verification.studies.cross_check.contact_run import CrossCheckRecord, Side

Field = NDArray[np.float64]

REQUIRED = {"pressure": 5e-3, "shear": 2e-2, "approach": 1e-3}
COVERAGE = 2.0  # standard uncertainties
CELLS, ELEMENTS = "cells", "elements"  # the two sides


@dataclass(frozen=True)
class Difference:
    """One quantity of one contact, dimensionless.

    value            how far the solvers are apart
    semi_analytical  own error of that side; finite_elements likewise
    to_reference     errors of both sides against what neither of them made; None if there is none
    """

    value: float
    required: float
    semi_analytical: float
    finite_elements: float
    to_reference: tuple[float, float] | None

    @property
    def joint(self) -> float:
        """Standard uncertainty of the difference."""
        return hypot(self.semi_analytical, self.finite_elements)

    @property
    def is_explained(self) -> bool:
        """Whether the two own errors cover the difference."""
        return self.value <= COVERAGE * self.joint

    @property
    def status(self) -> Status:
        """Pass within what is required, inconclusive where the own errors may be the reason that it
        is not."""
        if self.value <= self.required:
            return Status.PASS
        return Status.INCONCLUSIVE if self.is_explained else Status.FAIL

    @property
    def nearer(self) -> str:
        """Which side is nearer to the reference."""
        if self.to_reference is None:
            return "–"
        ours, theirs = self.to_reference
        return CELLS if ours < theirs else ELEMENTS


def differences(record: CrossCheckRecord) -> dict[str, Difference]:
    """Of pressure, shear and approach; of the shear only where there is friction."""
    one, other = record.semi_analytical, record.finite_elements
    everywhere = np.ones(len(record.radii), dtype=bool)
    judged = np.array(record.shear_judged)
    found = {
        "pressure": Difference(
            _largest(one.pressure, other.pressure, everywhere),
            REQUIRED["pressure"],
            one.own_pressure,
            other.own_pressure,
            _to_reference(record.reference_pressure, one.pressure, other.pressure, everywhere),
        ),
        "approach": Difference(
            abs(_approach(one) / _approach(other) - 1),
            REQUIRED["approach"],
            one.own_approach,
            other.own_approach,
            _approach_to_reference(record),
        ),
    }
    if any(one.shear):
        found["shear"] = Difference(
            _largest(one.shear, other.shear, judged),
            REQUIRED["shear"],
            one.own_shear,
            other.own_shear,
            _to_reference(record.reference_shear, one.shear, other.shear, judged),
        )
    return found


def _approach(side: Side) -> float:
    return side.numbers["approach"]


def _approach_to_reference(record: CrossCheckRecord) -> tuple[float, float] | None:
    known = record.reference_approach
    if known is None:
        return None
    one, other = (
        abs(_approach(side) / known - 1)
        for side in (record.semi_analytical, record.finite_elements)
    )
    return one, other


def _largest(one: tuple[float, ...], other: tuple[float, ...], judged: NDArray[np.bool_]) -> float:
    apart = np.abs(np.array(one) - np.array(other))
    return float(np.max(apart, where=judged, initial=0.0))


def _to_reference(
    known: tuple[float, ...] | None,
    one: tuple[float, ...],
    other: tuple[float, ...],
    judged: NDArray[np.bool_],
) -> tuple[float, float] | None:
    if known is None:
        return None
    return _largest(one, known, judged), _largest(other, known, judged)
