"""The settings that are tried, by contact and method."""

from __future__ import annotations

from collections.abc import Iterator

from verification.cases.case import Level
from verification.studies.work_precision.contacts import CATTANEO, CONTACTS, INDENTATION
from verification.studies.work_precision.setting import Method, PrecisionCase

CELLS = {
    Level.QUICK: (16, 32, 64, 128),
    Level.STANDARD: (16, 32, 64, 128, 256),
    Level.FULL: (16, 32, 64, 128, 256, 512),
}
ELEMENTS = {
    Level.QUICK: (8, 16, 32),
    Level.STANDARD: (8, 16, 32, 64),
    Level.FULL: (8, 16, 32, 64, 128),
}
LOOSE = {Level.QUICK: (1e-4,), Level.STANDARD: (1e-2, 1e-4), Level.FULL: (1e-2, 1e-4, 1e-6)}
PENALTIES = {Level.QUICK: (1.0, 10.0), Level.STANDARD: (1.0, 10.0, 100.0)}
SAMPLINGS = {Level.QUICK: ((1, 1), (2, 2)), Level.STANDARD: ((1, 1), (2, 1), (2, 2), (4, 4))}
INCREMENTS = {Level.QUICK: (5,), Level.STANDARD: (5, 10, 40)}  # beside the usual ones
FROZEN_STEPS = (10,)
MOST_SAMPLES = 2048  # along a side: more do not fit beside one another in memory


def all_cases(level: Level) -> tuple[PrecisionCase, ...]:
    """All settings, each once."""
    return tuple(case for contact in CONTACTS for case in of_contact(contact, level))


def of_contact(contact: str, level: Level) -> Iterator[PrecisionCase]:
    """The settings on one contact."""
    upper = min(level, Level.STANDARD)
    for n in CELLS[level]:
        for tolerance in (1e-8, *LOOSE[level]):
            yield PrecisionCase(contact, Method.SURFACE, n, tolerance)
        for sampling in SAMPLINGS[upper]:
            if 2 * n * sampling[0] * sampling[1] <= MOST_SAMPLES:
                yield PrecisionCase(contact, Method.SAMPLED, n, sampling=sampling)
    for n in ELEMENTS[level]:
        yield PrecisionCase(contact, Method.ELEMENTS, n)
        for penalty in PENALTIES[upper]:
            yield PrecisionCase(contact, Method.PENALTY, n, penalty=penalty)
    if contact == INDENTATION.name:
        yield from _of_increments(contact, level)
    if contact == CATTANEO.name:
        for n in CELLS[level][1:4]:
            for steps in FROZEN_STEPS:
                yield PrecisionCase(
                    contact, Method.FROZEN, n, sampling=SAMPLINGS[Level.QUICK][-1], increments=steps
                )


def _of_increments(contact: str, level: Level) -> Iterator[PrecisionCase]:
    for increments in INCREMENTS[min(level, Level.STANDARD)]:
        for n in CELLS[level]:
            yield PrecisionCase(contact, Method.SURFACE, n, increments=increments)
        for n in ELEMENTS[level]:
            yield PrecisionCase(contact, Method.ELEMENTS, n, increments=increments)
