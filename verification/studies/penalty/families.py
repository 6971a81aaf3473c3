"""The cases of the study, by what each varies."""

from __future__ import annotations

from collections.abc import Mapping

from verification.judging.case import Level
from verification.problems.indentation import FEW
from verification.running.row import CaseRecord
from verification.studies.penalty.case import FRICTIONAL, HERTZIAN, PenaltyCase

Found = Mapping[PenaltyCase, CaseRecord]

ELEMENTS = {Level.QUICK: 32, Level.STANDARD: 64, Level.FULL: 128}
FACTORS = (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0)  # c
DEFAULT = 10.0
UPDATES = (0, 1, 2, 3)
INCREMENTS = (5, 10, 20, 40, 80)
BOXES = (5.0, 10.0, 20.0, 50.0, 100.0, 200.0)
BOXED = (HERTZIAN, "coated")


def of_springs(level: Level) -> list[PenaltyCase]:
    """Hertz: stiffness of the springs, and augmentations."""
    n = ELEMENTS[level]
    return [PenaltyCase(HERTZIAN, n, c, updates) for updates in UPDATES for c in FACTORS]


def of_meshes(level: Level, updates: int) -> list[PenaltyCase]:
    """Hertz: elements per radius at the default stiffness, coarse to fine."""
    n = ELEMENTS[level]
    return [PenaltyCase(HERTZIAN, n // 2**k, DEFAULT, updates) for k in (2, 1, 0)]


def of_friction(level: Level, contact: str, updates: int) -> list[PenaltyCase]:
    """Pressing with friction: stiffness of the springs."""
    return [PenaltyCase(contact, ELEMENTS[level], c, updates) for c in FACTORS]


def of_increments(level: Level) -> list[PenaltyCase]:
    """Pressing with friction: increments, where they matter most."""
    return [
        PenaltyCase("strong", ELEMENTS[level], DEFAULT, 1, increments) for increments in INCREMENTS
    ]


def of_boxes(level: Level, contact: str) -> list[PenaltyCase]:
    """Size of the section, at the default penalty."""
    n = ELEMENTS[level]
    return [PenaltyCase(contact, n, DEFAULT, 1, FEW, box) for box in BOXES]


def all_cases(level: Level) -> tuple[PenaltyCase, ...]:
    """Of all families, each once."""
    families = [
        of_springs(level),
        *(of_meshes(level, updates) for updates in (0, 1)),
        *(of_friction(level, contact, updates) for contact in FRICTIONAL for updates in (0, 1)),
        of_increments(level),
        *(of_boxes(level, contact) for contact in BOXED),
    ]
    return tuple(dict.fromkeys(case for family in families for case in family))
