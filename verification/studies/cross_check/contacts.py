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


def expected_contacts() -> tuple[Key, ...]:
    """Every contact once."""
    return tuple(product(RATIOS, THICKNESSES, FRICTIONS))


def contact_text(key: Key) -> str:
    """A contact, for people."""
    return CheckedContact(*key).name
