"""What is compared of both solvers, how far they are apart, and what each of them owns up to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import hypot

from verification.cases.both_solvers.contacts import CheckedContact
from verification.cases.both_solvers.sides import (
    CELLS,
    ELEMENTS,
    SIDES,
    judged_radii,
    largest_apart,
    number,
    profiles,
)
from verification.judging.outcome import Status
from verification.running.row import CaseRecord

COVERAGE = 2.0  # standard uncertainties


@dataclass(frozen=True)
class Compared:
    """A quantity that both solvers are compared in.

    scale     what differences are over; empty for relative ones
    required  of two solvers that share nothing but the scene
    """

    name: str
    symbol: str
    scale: str
    required: float
    meaning: str


COMPARED = {
    one.name: one
    for one in (
        Compared("pressure", "p", "p₀", 5e-3, "pressure, r < 0.9 a, over p₀"),
        Compared("shear", "q", "µp₀", 2e-2, "shear, r < 0.9 a and away from its kinks, over µp₀"),
        Compared("approach", "δ", "", 1e-3, "approach, relative"),
    )
}


@dataclass(frozen=True)
class Difference:
    """One quantity of one contact, dimensionless.

    value         how far the solvers are apart
    cells         own error of that side; elements likewise
    to_reference  errors of both sides against what neither of them made; None if there is none
    """

    value: float
    required: float
    cells: float
    elements: float
    to_reference: tuple[float, float] | None

    @property
    def joint(self) -> float:
        """Standard uncertainty of the difference."""
        return hypot(self.cells, self.elements)

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


Found = Mapping[CheckedContact, CaseRecord]
Apart = Mapping[CheckedContact, Mapping[str, Difference]]


def differences(record: CaseRecord) -> dict[str, Difference]:
    """Of pressure, shear and approach; of the shear only where there is friction."""
    apart = _between(record, CELLS, ELEMENTS)
    known = "approach_reference" in record.measures
    errors = [_between(record, side, "reference") for side in SIDES] if known else None
    return {
        name: Difference(
            apart[name],
            compared.required,
            number(record, f"own_{name}_{CELLS}"),
            number(record, f"own_{name}_{ELEMENTS}"),
            None if errors is None else (errors[0][name], errors[1][name]),
        )
        for name, compared in COMPARED.items()
        if name != "shear" or record.parameters["friction"]
    }


def _between(record: CaseRecord, one: str, other: str) -> dict[str, float]:
    """How far a side is from another, or from the reference."""
    approach = number(record, f"approach_{one}") / number(record, f"approach_{other}")
    tractions = profiles(record, one), profiles(record, other)
    return {
        **largest_apart(*tractions, judged_radii(record)[1]),
        "approach": abs(approach - 1),
    }
