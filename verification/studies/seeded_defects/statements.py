"""What the study claims of the harness, and how the records judge it."""

from __future__ import annotations

from collections.abc import Sequence

from verification.defects.healthy_contacts import THIN
from verification.defects.outputs import PLANTED
from verification.judging.outcome import Status
from verification.running.rules import total
from verification.running.study import Records, Settings, Statement
from verification.studies.seeded_defects.findings import (
    Seen,
    all_healthy,
    caught_by_reference,
    covered,
    defect_runs,
    derived,
    found,
    healthy,
    healthy_runs,
    passes_gate,
)
from verification.studies.seeded_defects.runs import GATE, HEALTHY, Sample

COVERAGE = 0.95
LEAST_SAMPLES = 200
LEAST_THIN = 40
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
        _coverage_of_thin_layers(records),
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
    failed, verdicts = total(there, "failed"), total(there, "verdicts")
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
    both = sum(caught_by_reference(record) and passes_gate(record) for record in there)
    return Statement(
        claim=f"errors of first order, of a floor and of a bias fail, though a fixed gate of "
        f"{100 * GATE:g} % passes them",
        outcome=_status(both == len(there), len(there) == wanted),
        measured=f"{both} of {len(there)} pairs of an error and a case",
    )


def _false_alarms(records: Records) -> Statement:
    there = all_healthy(records)
    wanted = len(healthy_runs())
    alarms, verdicts = total(there, "failed"), total(there, "verdicts")
    return Statement(
        claim="healthy contacts raise no alarm",
        outcome=_status(alarms == 0, len(there) == wanted),
        measured=f"{alarms} of {verdicts} verdicts failed on {len(there)} contacts",
        because=f"at least {LEAST_HEALTHY} are asked for",
    )


def _coverage(records: Records) -> Statement:
    return _covered_by_bars(
        f"error bars U = 2u contain the true error in at least {100 * COVERAGE:g} %",
        derived(all_healthy(records)),
        LEAST_SAMPLES,
        "of the tolerances that are derived from refinement, before they are capped",
    )


def _coverage_of_thin_layers(records: Records) -> Statement:
    return _covered_by_bars(
        f"so they do where the coarser grids do not resolve a layer, in at least "
        f"{100 * COVERAGE:g} %",
        derived(healthy(records)[THIN]),
        LEAST_THIN,
        "the error is of one order on the finer grids alone; the bars take in by how much the "
        "limits of finer and coarser grids differ",
    )


def _covered_by_bars(claim: str, samples: list[Sample], least: int, because: str) -> Statement:
    inside = sum(map(covered, samples))
    share = inside / len(samples) if samples else 1.0
    return Statement(
        claim=claim,
        outcome=_status(share >= COVERAGE, len(samples) >= least),
        measured=f"{inside} of {len(samples)}" + (f": {100 * share:.1f} %" if samples else ""),
        because=because,
    )


def _status(good: bool, complete: bool) -> Status:
    """A miss counts even while cases are open."""
    if not good:
        return Status.FAIL
    return Status.PASS if complete else Status.INCONCLUSIVE
