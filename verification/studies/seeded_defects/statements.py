"""What the study claims of the harness, and how the records judge it."""

from __future__ import annotations

from collections.abc import Sequence

from verification.cases.outcome import Status
from verification.seeded_defects.healthy_contacts import NOT_ASYMPTOTIC
from verification.seeded_defects.outputs import PLANTED
from verification.studies.running.study import Records, Settings, Statement
from verification.studies.seeded_defects.defect_run import GATE, HEALTHY
from verification.studies.seeded_defects.findings import (
    Seen,
    covered,
    defect_runs,
    derived,
    found,
    healthy,
    healthy_runs,
    judged_contacts,
    passes_gate,
)

COVERAGE = 0.95
LEAST_SAMPLES = 200
LEAST_HEALTHY = 30


def statements(
    settings: Settings, records: Records, all_seen: Sequence[Seen]
) -> tuple[Statement, ...]:
    """All of them, in the order of the page."""
    return (
        _all_caught(all_seen),
        _healthy_cases(settings, records),
        _planted(records),
        _false_alarms(records),
        _coverage(records),
        _not_asymptotic(records),
    )


def _all_caught(all_seen: Sequence[Seen]) -> Statement:
    missed = [one.defect.name for one in all_seen if one.complete and not one.sightings]
    open_ = sum(not one.complete and not one.sightings for one in all_seen)
    caught = sum(bool(one.sightings) for one in all_seen)
    text = f"{caught} of {len(all_seen)}"
    if missed:
        text += f"; missed: {', '.join(missed)}"
    if open_:
        text += f"; not yet judged: {open_}"
    return Statement(
        claim="the verification catches every seeded defect",
        outcome=_status(not missed, open_ == 0),
        measured=text,
        because="by a verdict that passes without it, judged as `slipstick verify` does",
    )


def _healthy_cases(settings: Settings, records: Records) -> Statement:
    runs = [run for run in defect_runs(settings) if run.defect == HEALTHY]
    there = [record for run in runs if (record := found(records, HEALTHY, run.case)) is not None]
    failed = sum(len(record.caught) for record in there)
    verdicts = sum(record.verdicts for record in there)
    return Statement(
        claim="without a defect the same cases pass",
        outcome=_status(failed == 0, len(there) == len(runs)),
        measured=f"{failed} of {verdicts} verdicts failed in {len(there)} of {len(runs)} cases",
    )


def _planted(records: Records) -> Statement:
    there = [
        record
        for defect in PLANTED
        for case in defect.cases
        if (record := found(records, defect.name, case)) is not None
    ]
    wanted = sum(len(defect.cases) for defect in PLANTED)
    both = sum(bool(record.caught) and passes_gate(record) for record in there)
    return Statement(
        claim=f"errors of first order, of a floor and of a bias fail, though a fixed gate of "
        f"{100 * GATE:g} % passes them",
        outcome=_status(both == len(there), len(there) == wanted),
        measured=f"{both} of {len(there)} pairs of an error and a case",
    )


def _false_alarms(records: Records) -> Statement:
    there = judged_contacts(records)
    wanted = sum(run.family not in NOT_ASYMPTOTIC for run in healthy_runs())
    alarms = sum(len(record.failed) for record in there)
    verdicts = sum(record.verdicts for record in there)
    return Statement(
        claim="healthy contacts raise no alarm",
        outcome=_status(alarms == 0, len(there) == wanted),
        measured=f"{alarms} of {verdicts} verdicts failed on {len(there)} contacts",
        because=f"at least {LEAST_HEALTHY} are asked for",
    )


def _coverage(records: Records) -> Statement:
    samples = derived(judged_contacts(records))
    inside = sum(map(covered, samples))
    share = inside / len(samples) if samples else 1.0
    return Statement(
        claim=f"error bars U = 2u contain the true error in at least {100 * COVERAGE:g} %",
        outcome=_status(share >= COVERAGE, len(samples) >= LEAST_SAMPLES),
        measured=f"{inside} of {len(samples)}" + (f": {100 * share:.1f} %" if samples else ""),
        because="of the tolerances that are derived from refinement, before they are capped",
    )


def _not_asymptotic(records: Records) -> Statement:
    there = [r for family in NOT_ASYMPTOTIC for r in healthy(records)[family]]
    samples = derived(there)
    alarms = sum(len(record.failed) for record in there)
    return Statement(
        claim="where the coarser grids do not resolve a layer, error bars are too short",
        outcome=None,
        measured=f"{sum(map(covered, samples))} of {len(samples)} within U; {alarms} false alarms "
        f"on {len(there)} contacts",
        because="the error is not of one order yet: such a refinement has no error bar to rely on",
    )


def _status(good: bool, complete: bool) -> Status:
    if not good:
        return Status.FAIL
    return Status.PASS if complete else Status.INCONCLUSIVE
