"""The contacts of the study, by modulus ratio, thickness and friction."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

from verification.cases.cross_check_contacts import FRICTIONS, RATIOS, THICKNESSES, CheckedContact
from verification.studies.cross_check.contact_run import CrossCheckRecord
from verification.studies.cross_check.difference import Difference

# E1/E2, h over a_H and µ, as of `CheckedContact`.
Key = tuple[float, float, float]
Found = Mapping[Key, CrossCheckRecord]
Apart = Mapping[Key, Mapping[str, Difference]]


ALIKE = 1.0  # E1/E2 of a coating that is none, whatever its thickness
STANDS_FOR_ALL = 1.0  # its h / a_H


def expected_contacts() -> tuple[Key, ...]:
    """Every contact once."""
    return tuple(
        (ratio, thickness, friction)
        for ratio, thickness, friction in product(RATIOS, THICKNESSES, FRICTIONS)
        if is_its_own(ratio, thickness)
    )


def is_its_own(ratio: float, thickness: float) -> bool:
    """Whether no other thickness makes the same body."""
    return ratio != ALIKE or thickness == STANDS_FOR_ALL


def coated_count() -> int:
    """Contacts whose coating differs from what is below."""
    return sum(ratio != ALIKE for ratio, _, _ in expected_contacts())


def contact_text(key: Key) -> str:
    """A contact, for people."""
    return CheckedContact(*key).name
