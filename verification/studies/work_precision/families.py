"""The settings that are tried, by contact and method."""

from __future__ import annotations

from collections.abc import Iterator

from verification.judging.case import Level
from verification.studies.work_precision.contacts import (
    CATTANEO,
    COATING,
    CONTACTS,
    HERTZIAN,
    INDENTATION,
)
from verification.studies.work_precision.setting import OWN, Method, PrecisionCase

CELLS = {
    Level.QUICK: (16, 32, 64, 128),
    Level.STANDARD: (16, 32, 64, 128, 256),
    Level.FULL: (16, 32, 64, 128, 256),
}
# More where a norm of the field means the edge, which takes the finest grids to reach 0.1 %.
TO_THE_EDGE: dict[str, dict[Level, tuple[int, ...]]] = {
    HERTZIAN.name: {Level.QUICK: (256, 512), Level.STANDARD: (512,), Level.FULL: (512, 1024)},
    COATING.name: {Level.QUICK: (256, 512), Level.STANDARD: (512,), Level.FULL: (512, 1024)},
    CATTANEO.name: {Level.QUICK: (256,), Level.STANDARD: (512,), Level.FULL: (512,)},
}
ELEMENTS = {
    Level.QUICK: (8, 16, 32),
    Level.STANDARD: (8, 16, 32, 64),
    Level.FULL: (8, 16, 32, 64, 128),
}
LOOSE = {Level.QUICK: (1e-4,), Level.STANDARD: (1e-2, 1e-4), Level.FULL: (1e-2, 1e-4)}
PENALTIES = {Level.QUICK: (1.0, 10.0), Level.STANDARD: (1.0, 10.0, 100.0)}
# Of the closed form below a ball the radial solver makes none; of a coated one it has round-off.
RINGS = {
    Level.QUICK: (OWN // 2, OWN),
    Level.STANDARD: (OWN // 2, OWN, 3 * OWN // 2),
    Level.FULL: (OWN // 2, OWN, 3 * OWN // 2, 2 * OWN),
}
# Energies and shifts of a loop stay those of cells without edges.
WITH_EDGES = (HERTZIAN.name, CATTANEO.name, COATING.name, INDENTATION.name)
INCREMENTS = {Level.QUICK: (5,), Level.STANDARD: (5, 10, 40)}  # beside the usual ones
MOST_SPRINGS = 64  # elements: finer with springs takes longer than all the rest


def all_cases(level: Level) -> tuple[PrecisionCase, ...]:
    """All settings, each once."""
    return tuple(case for contact in CONTACTS for case in of_contact(contact, level))


def of_contact(contact: str, level: Level) -> Iterator[PrecisionCase]:
    """The settings on one contact."""
    upper = min(level, Level.STANDARD)
    for n in CELLS[level]:
        for tolerance in (1e-8, *LOOSE[level]):
            yield PrecisionCase(contact, Method.SURFACE, n, tolerance)
        if contact in WITH_EDGES:
            yield PrecisionCase(contact, Method.EDGES, n)
    if contact != HERTZIAN.name:
        for n in (OWN,) if contact == COATING.name else RINGS[level]:
            yield PrecisionCase(contact, Method.RADIAL, n)
    for n in ELEMENTS[level]:
        yield PrecisionCase(contact, Method.ELEMENTS, n)
        for penalty in PENALTIES[upper] if n <= MOST_SPRINGS else ():
            yield PrecisionCase(contact, Method.PENALTY, n, penalty=penalty)
    if contact == INDENTATION.name:
        yield from _of_increments(contact, level)
    for n in TO_THE_EDGE.get(contact, {}).get(level, ()):
        yield PrecisionCase(contact, Method.SURFACE, n)


def _of_increments(contact: str, level: Level) -> Iterator[PrecisionCase]:
    for increments in INCREMENTS[min(level, Level.STANDARD)]:
        for n in CELLS[level]:
            yield PrecisionCase(contact, Method.SURFACE, n, increments=increments)
        for n in ELEMENTS[max(level, Level.STANDARD)]:
            yield PrecisionCase(contact, Method.ELEMENTS, n, increments=increments)
        yield PrecisionCase(contact, Method.RADIAL, OWN, increments=increments)
