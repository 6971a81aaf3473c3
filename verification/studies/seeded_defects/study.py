"""Study of the verification: defects that it misses, false alarms, and coverage of
its error bars."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from verification.cases.catalogue import CASES
from verification.defects.defect import Defect
from verification.defects.healthy_contacts import FAMILIES, THIN
from verification.defects.outputs import PLANTED
from verification.defects.registry import DEFECTS
from verification.exhibits.chart import Chart, Look, Panel, Table, curve, plain, stacked, table_of
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.running.study import (
    CaseRecord,
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    StudyCase,
    total,
)
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
    """Return the verification cases that are run under a seeded defect (an error planted in a
    solver).

    At the quick level these are the cases that should detect the defect. At other levels these are
    all cases of the quick catalogue.
    """
    if settings.level is Level.QUICK:
        return defect.cases
    return CASES


def defect_runs(settings: Settings) -> tuple[DefectRun, ...]:
    """Return the runs of the verification cases under every seeded defect, and of the same cases
    without.

    A seeded defect is an error that is planted in the solvers to test the verification.
    """
    runs = [
        DefectRun(defect.name, case)
        for defect in DEFECTS.values()
        for case in seen_by(settings, defect)
    ]
    cases = dict.fromkeys(run.case for run in runs)
    return (*runs, *(DefectRun(HEALTHY, case) for case in cases))


def healthy_runs() -> tuple[HealthyRun, ...]:
    """Return the runs of all random contacts of all families, without a planted defect."""
    return tuple(HealthyRun(family, draw) for family in FAMILIES for draw in range(DRAWS[family]))


@dataclass(frozen=True)
class Sighting:
    """A verdict of a case that fails under a defect and does not fail without the defect."""

    case: str
    verdict: Caught


@dataclass(frozen=True)
class Seen:
    """Collect the verdicts that detect one defect.

    cases      cases that are run under the defect
    complete   True if all these cases have a record with the defect and one without the defect
    sightings  verdicts that fail only under the defect
    """

    defect: Defect
    cases: tuple[str, ...]
    complete: bool
    sightings: tuple[Sighting, ...]

    @property
    def best(self) -> Sighting | None:
        """Verdict that detects the defect most clearly: with the largest ratio of error to allowed
        error.

        Verdicts without a number come last; None if no verdict detects the defect.
        """
        return max(self.sightings, key=lambda s: s.verdict.clearance or -1.0, default=None)

    @property
    def by(self) -> tuple[str, ...]:
        """Names of the verification cases that detected the defect."""
        return tuple(dict.fromkeys(sighting.case for sighting in self.sightings))


def seen(settings: Settings, records: Records, defect: Defect) -> Seen:
    """Collect the verdicts of all cases that fail under a defect and not without the defect.

    A case without a record of the healthy run is not counted.
    """
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
    """Return the record of a verification case under a planted defect; None if it is not computed.

    defect  name of the defect; empty for the case without a defect
    """
    record = records.get(DefectRun(defect, case).name)
    return record if isinstance(record, CaseRecord) else None


def healthy(records: Records) -> Mapping[str, list[CaseRecord]]:
    """Return the records of random contacts solved without a planted defect, grouped by family."""
    families: dict[str, list[CaseRecord]] = {family: [] for family in FAMILIES}
    for run in healthy_runs():
        record = records.get(run.name)
        if isinstance(record, CaseRecord):
            families[run.family].append(record)
    return families


def all_healthy(records: Records) -> list[CaseRecord]:
    """Return the records of all random contacts that were solved without a planted defect."""
    return [record for there in healthy(records).values() for record in there]


def derived(records: list[CaseRecord]) -> list[Sample]:
    """Select the samples with an expanded uncertainty: those whose tolerance is derived from
    refinement.
    """
    return [s for record in records for s in samples(record) if s.uncertainty is not None]


def covered(sample: Sample) -> bool:
    """Determine if the error of a quantity is at most its estimated expanded uncertainty U = 2u."""
    if sample.error is None or sample.uncertainty is None:
        return False
    return sample.error <= sample.uncertainty


def caught_by_reference(record: CaseRecord) -> bool:
    """Determine if a planted defect is detected by a reference solution or a convergence order.

    Verdicts that only check a law of the fields, such as the energy balance, do not count.
    """
    return any(not one.by_law for one in caught(record))


def passes_gate(record: CaseRecord) -> bool:
    """Determine if all quantities of a verification case have errors below 1 % of their scale.

    Compares the verification with a simple test by one fixed tolerance.
    """
    error = record.measures[ERROR]
    return error is not None and error <= GATE


COVERAGE = 0.95
LEAST_SAMPLES = 200
LEAST_THIN = 40
LEAST_HEALTHY = 30


def statements(
    settings: Settings, records: Records, all_seen: Sequence[Seen]
) -> tuple[Statement, ...]:
    """Judge detection of defects, false alarms and coverage of error bars, in the order of the
    report.
    """
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
    """Return FAIL for a violated claim even if cases are missing; otherwise PASS or INCONCLUSIVE.

    good      True if the available records fulfil the claim
    complete  True if enough records are available
    """
    if not good:
        return Status.FAIL
    return Status.PASS if complete else Status.INCONCLUSIVE


def tables(records: Records, all_seen: Sequence[Seen]) -> tuple[Table, ...]:
    """Return the tables of the seeded defects, of the planted errors and of the
    healthy contacts."""
    return (_defects(all_seen), _gates(records), _families(records))


def _defects(all_seen: Sequence[Seen]) -> Table:
    def of_best(text: Callable[[Sighting], str]) -> Callable[[Seen], str]:
        return lambda one: "–" if one.best is None else text(one.best)

    def clearance(best: Sighting) -> str:
        return "–" if best.verdict.clearance is None else plain(best.verdict.clearance, 2)

    return table_of(
        "Seeded defects",
        {
            "defect": lambda one: one.defect.name,
            "what is broken": lambda one: one.defect.broken,
            "caught by": of_best(lambda best: f"{best.case}/{best.verdict.quantity}"),
            "how": of_best(lambda best: best.verdict.how),
            "error / allowed": of_best(clearance),
            "cases": _votes,
        },
        all_seen,
        "The verdict that misses by most; an error in units of what is allowed.",
    )


def _votes(one: Seen) -> str:
    if one.best is None:
        return "missed" if one.complete else "not judged"
    return f"{len(one.by)} of {len(one.cases)}"


def _gates(records: Records) -> Table:
    pairs = [
        (defect.name, case, record)
        for defect in PLANTED
        for case in defect.cases
        if (record := found(records, defect.name, case)) is not None
    ]
    return table_of(
        "Planted errors under a fixed gate and under the harness",
        {
            "error": lambda of: of[0],
            "case": lambda of: of[1],
            "largest error": lambda of: _percent(of[2].measures[ERROR]),
            f"gate of {100 * GATE:g} %": lambda of: "passes" if passes_gate(of[2]) else "fails",
            "harness": lambda of: "{failed} of {verdicts} fail".format(**of[2].counters),
            "verdicts": lambda of: ", ".join(sorted({v.quantity for v in caught(of[2])})) or "–",
        },
        pairs,
        "The largest error of any quantity of the case, relative to its scale.",
    )


def _percent(error: float | None) -> str:
    return "–" if error is None else f"{100 * error:.3f} %"


def _families(records: Records) -> Table:
    families = healthy(records)
    bars = {family: derived(there) for family, there in families.items()}
    return table_of(
        "Healthy contacts",
        {
            "family": str,
            "contacts": lambda of: str(len(families[of])),
            "verdicts": lambda of: str(total(families[of], "verdicts")),
            "false alarms": lambda of: str(total(families[of], "failed")),
            "within U": lambda of: (
                f"{sum(map(covered, bars[of]))} of {len(bars[of])}" if bars[of] else "–"
            ),
            "largest error / U": lambda of: (
                plain(max(_parts(bars[of]), default=0.0), 2) if bars[of] else "–"
            ),
        },
        families,
        "Tolerances of flat punches are not derived: their rim is a staircase of cells.",
    )


def _parts(samples: Iterable[Sample]) -> list[float]:
    """Return the ratios of error to expanded uncertainty U = 2u of the samples that have both."""
    return [s.error / s.uncertainty for s in samples if s.error is not None and s.uncertainty]


def charts(records: Records) -> tuple[Chart, ...]:
    """Draw the distribution of the true errors over their error bars; return no chart without
    samples.
    """
    curves = []
    for number, (family, there) in enumerate(healthy(records).items()):
        parts = sorted(_parts(derived(there)))
        if parts:
            shares = [(k + 1) / len(parts) for k in range(len(parts))]
            curves.append(curve(family, parts, shares, series=number))
    if not curves:
        return ()
    bound = curve("U", [1.0, 1.0], [0.0, 1.0], Look.BOUND)
    panel = Panel(
        x_label="error / U", y_label="share of samples below", curves=(*curves, bound), height=2.2
    )
    return (
        stacked(
            "error_bars",
            "True errors in units of their error bars",
            "Share of the healthy samples whose true error is below a part of U = 2u. "
            "What lies right of 1 is not covered.",
            panel,
        ),
    )


REMARKS = (
    "A defect counts as caught by a verdict that fails under it and passes without it. No verdict "
    "here rests on a recorded baseline: reference, order, residual or a named error caught it.",
    "At the quick level each defect meets the cases that ought to see it; above, the whole quick "
    "catalogue.",
    "Defects are planted by replacing functions of the solvers in the worker process; nothing in "
    "the solvers knows of them.",
    "Healthy contacts differ in materials, radii, loads, friction, thickness, window and in where "
    "the axis falls in a cell, on every grid anew.",
    "Four verdicts are what they are because a defect would pass otherwise: the slip in "
    "cattaneo_mindlin, the case coated_unlike_ratios, consistent_tangent in "
    "fem_penalty_indentation, and the tolerance of the approach in fem_penalty_hertz. Each "
    "judges a law, none looks for a defect.",
)


def cases(settings: Settings) -> tuple[StudyCase, ...]:
    """Return all runs of the study: cases with and without defects, and random healthy contacts."""
    return (*defect_runs(settings), *healthy_runs())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Judge the records of the study and return its statements, tables and figure."""
    all_seen = [seen(settings, records, defect) for defect in DEFECTS.values()]
    caught = sum(bool(one.sightings) for one in all_seen)
    return Conclusion(
        answer=f"The cases of the catalogue catch {caught} of {len(all_seen)} defects.",
        statements=statements(settings, records, all_seen),
        tables=tables(records, all_seen),
        charts=charts(records),
        remarks=REMARKS,
    )


STUDY = Study(
    name="seeded-defects",
    title="The harness tested: seeded defects, healthy contacts, error bars",
    question="A verification that cannot fail shows nothing. Which defects of the solvers does "
    "this one see, does it cry out where nothing is wrong, and do its error bars hold?",
    cases=cases,
    conclude=conclude,
)
