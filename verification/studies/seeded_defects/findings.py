"""What the records say, put together by defect and by family."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from verification.cases.catalogue import CASES
from verification.defects.defect import Defect
from verification.defects.healthy_contacts import FAMILIES, THIN
from verification.defects.registry import DEFECTS
from verification.judging.case import Level
from verification.running.row import CaseRecord
from verification.running.study import Records, Settings
from verification.studies.seeded_defects.runs import (
    ERROR,
    GATE,
    HEALTHY,
    Caught,
    DefectRun,
    HealthyRun,
    Sample,
    caught,
    samples,
)

DRAWS = {
    "hertz": 60,
    "cone": 40,
    "partial_slip": 40,
    "coated": 30,
    "flat_punch": 20,
    "fem_hertz": 20,
    THIN: 30,
}


def seen_by(settings: Settings, defect: Defect) -> tuple[str, ...]:
    """The cases under a defect: those that ought to see it, or the whole quick catalogue."""
    if settings.level is Level.QUICK:
        return defect.cases
    return CASES


def defect_runs(settings: Settings) -> tuple[DefectRun, ...]:
    """All defects, and the same cases without any."""
    runs = [
        DefectRun(defect.name, case)
        for defect in DEFECTS.values()
        for case in seen_by(settings, defect)
    ]
    cases = dict.fromkeys(run.case for run in runs)
    return (*runs, *(DefectRun(HEALTHY, case) for case in cases))


def healthy_runs() -> tuple[HealthyRun, ...]:
    """All draws of all families."""
    return tuple(HealthyRun(family, draw) for family in FAMILIES for draw in range(DRAWS[family]))


@dataclass(frozen=True)
class Sighting:
    """A verdict that fails under a defect and not without it."""

    case: str
    verdict: Caught


@dataclass(frozen=True)
class Seen:
    """What the verification says of a defect.

    complete  whether all its cases have a record, and the healthy ones beside them
    """

    defect: Defect
    cases: tuple[str, ...]
    complete: bool
    sightings: tuple[Sighting, ...]

    @property
    def best(self) -> Sighting | None:
        """The verdict that misses by most; a number before an error without one."""
        return max(self.sightings, key=lambda s: s.verdict.clearance or -1.0, default=None)

    @property
    def by(self) -> tuple[str, ...]:
        """The cases that saw it."""
        return tuple(dict.fromkeys(sighting.case for sighting in self.sightings))


def seen(settings: Settings, records: Records, defect: Defect) -> Seen:
    """What the cases say of a defect. Without the healthy record a failure counts for nothing."""
    cases = seen_by(settings, defect)
    sightings, complete = [], True
    for case in cases:
        sick, well = found(records, defect.name, case), found(records, HEALTHY, case)
        if sick is None or well is None:
            complete = False
            continue
        before = {(verdict.quantity, verdict.run) for verdict in caught(well)}
        sightings += [
            Sighting(case, verdict)
            for verdict in caught(sick)
            if (verdict.quantity, verdict.run) not in before
        ]
    return Seen(defect, cases, complete, tuple(sightings))


def found(records: Records, defect: str, case: str) -> CaseRecord | None:
    """The record of a case under a defect."""
    record = records.get(DefectRun(defect, case).name)
    return record if isinstance(record, CaseRecord) else None


def healthy(records: Records) -> Mapping[str, list[CaseRecord]]:
    """Records of the healthy contacts, by family."""
    families: dict[str, list[CaseRecord]] = {family: [] for family in FAMILIES}
    for run in healthy_runs():
        record = records.get(run.name)
        if isinstance(record, CaseRecord):
            families[run.family].append(record)
    return families


def all_healthy(records: Records) -> list[CaseRecord]:
    """Records of the healthy contacts of all families."""
    return [record for there in healthy(records).values() for record in there]


def derived(records: list[CaseRecord]) -> list[Sample]:
    """The samples that have an error bar."""
    return [s for record in records for s in samples(record) if s.uncertainty is not None]


def covered(sample: Sample) -> bool:
    """Whether the error bar contains the true value."""
    if sample.error is None or sample.uncertainty is None:
        return False
    return sample.error <= sample.uncertainty


def caught_by_reference(record: CaseRecord) -> bool:
    """Whether a reference or an order sees the defect, and not the laws in the fields alone."""
    return any(not one.by_law for one in caught(record))


def passes_gate(record: CaseRecord) -> bool:
    """Whether a fixed gate of 1 % lets all quantities of the case pass."""
    error = record.measures[ERROR]
    return error is not None and error <= GATE
