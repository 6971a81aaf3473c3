"""What is compared of the solvers, how far they are apart, and what each of them owns up to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from math import hypot, isnan

from verification.cases.both_solvers.contacts import CheckedContact
from verification.cases.both_solvers.sides import (
    judged_radii,
    largest_apart,
    number,
    profiles,
    sides_of,
)
from verification.judging.outcome import Status
from verification.running.row import CaseRecord

COVERAGE = 2.0  # standard uncertainties


@dataclass(frozen=True)
class Compared:
    """A quantity that solvers are compared in.

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


Pair = tuple[str, str]


@dataclass(frozen=True)
class Difference:
    """One quantity of one contact, dimensionless.

    apart         how far two sides are apart
    own           error that a side owns up to
    to_reference  errors of the sides against what none of them made; None if there is none
    """

    apart: Mapping[Pair, float]
    required: float
    own: Mapping[str, float]
    to_reference: Mapping[str, float] | None

    @property
    def value(self) -> float:
        """How far those are apart that are furthest."""
        return self.apart[self.furthest]

    @property
    def joint(self) -> float:
        """Its standard uncertainty."""
        return self.uncertainty(self.furthest)

    @cached_property
    def furthest(self) -> Pair:
        """The pair that differs most; first one of which a number is none."""
        return max(self.apart, key=lambda pair: (isnan(self.apart[pair]), self.apart[pair]))

    def uncertainty(self, pair: Pair) -> float:
        """Standard uncertainty of a difference."""
        return hypot(*(self.own[side] for side in pair))

    def explains(self, pair: Pair) -> bool:
        """Whether the two own errors cover the difference."""
        return self.apart[pair] <= COVERAGE * self.uncertainty(pair)

    @property
    def is_explained(self) -> bool:
        """Whether own errors cover every difference."""
        return all(map(self.explains, self.apart))

    @property
    def status(self) -> Status:
        """Pass where all are within what is required, inconclusive where own errors may be the
        reason that some are not."""
        beyond = [pair for pair, value in self.apart.items() if not value <= self.required]
        if not beyond:
            return Status.PASS
        return Status.INCONCLUSIVE if all(map(self.explains, beyond)) else Status.FAIL

    @property
    def odd(self) -> str | None:
        """Of three sides the one that the two nearest to each other are without."""
        if len(self.own) < 3:
            return None
        nearest = min(self.apart, key=lambda pair: self.apart[pair])
        return next(side for side in self.own if side not in nearest)

    @property
    def nearer(self) -> str:
        """Which side is nearest to the reference."""
        known = self.to_reference
        return "–" if known is None else min(known, key=lambda side: known[side])


Found = Mapping[CheckedContact, CaseRecord]
Apart = Mapping[CheckedContact, Mapping[str, Difference]]


def differences(record: CaseRecord) -> dict[str, Difference]:
    """Of pressure, shear and approach; of the shear only where there is friction."""
    sides = sides_of(record)
    apart = {pair: _between(record, *pair) for pair in combinations(sides, 2)}
    known = "approach_reference" in record.measures
    errors = {side: _between(record, side, "reference") for side in sides if known}
    return {
        name: Difference(
            {pair: value[name] for pair, value in apart.items()},
            compared.required,
            {side: number(record, f"own_{name}_{side}") for side in sides},
            {side: error[name] for side, error in errors.items()} or None,
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
