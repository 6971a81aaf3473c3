"""Study of seeded defects: the verification must detect each planted error, and pass without it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from verification.cases.catalogue import CASES, CaseToJudge, JudgedCase, case_of, choose, lost
from verification.defects.defect import Defect, planted
from verification.defects.registry import DEFECTS
from verification.exhibits.chart import NONE, Table, plain
from verification.judging.case import Level
from verification.judging.outcome import (
    IMBALANCE,
    RESIDUAL,
    SOLVED,
    VIOLATION,
    CaseOutcome,
    Status,
    Verdict,
)
from verification.running.case_pool import CaseStore
from verification.running.study import (
    CaseRecord,
    Conclusion,
    Records,
    Settings,
    Statement,
    Study,
    TypedRow,
    judged,
    parameters_of,
    total,
)

HEALTHY = ""
LAWS = {RESIDUAL: "residual", VIOLATION: "law", IMBALANCE: "law"}


class FailedVerdict(TypedRow):
    """Verdict of a verification case that failed: the judged quantity, the run and the reason."""

    quantity: str
    run: str
    how: str
    """Kind of check that failed, such as "residual", "law", "order" or a kind of reference."""

    clearance: float | None
    """Error divided by the allowed error; null if there is no number."""

    reason: str = ""
    """Reason why a case or a run has no result."""


def failed_verdicts(record: CaseRecord) -> tuple[FailedVerdict, ...]:
    """Return the failed verdicts that the stored record of a verification case contains."""
    return tuple(map(FailedVerdict.of, record.parts))


@dataclass(frozen=True)
class DefectRun:
    """Verification case that is solved under a seeded defect or, for comparison, without a defect.

    defect  name of the defect; empty for a run without a defect
    case    name of the case in the quick catalogue
    """

    defect: str
    case: str

    @property
    def name(self) -> str:
        """File name of the record: the defect ("healthy" without a defect) and the verification
        case."""
        return f"{self.defect or 'healthy'}--{self.case.replace('_', '-')}"

    def compute(self) -> CaseRecord:
        """Plant the defect in the solvers, solve and judge the verification case, and remove the
        defect.

        The record contains the failed verdicts.
        """
        _import_all_cases()
        if self.defect == HEALTHY:
            outcome = judge_case(self.case)
        else:
            with planted(DEFECTS[self.defect]):
                outcome = judge_case(self.case)
        failed = [verdict for verdict in outcome.verdicts if verdict.status is Status.FAIL]
        return CaseRecord(
            parameters=parameters_of(self),
            counters={
                "verdicts": len(outcome.verdicts),
                "failed": len(failed),
                "inconclusive": outcome.count(Status.INCONCLUSIVE),
            },
            parts=tuple(_describe_failure(verdict).row() for verdict in failed),
        )


@cache
def _import_all_cases() -> None:
    """Import all modules of the quick verification cases before a defect is planted in the solvers.

    Constants that a module computes when it is imported are then free of the defect.
    """
    choose(Level.QUICK)


def judge_case(name: str) -> CaseOutcome:
    """Solve and judge a verification case as `slipstick verify` does, possibly under a planted
    defect.

    The record is written to a file and read back, so that defects of files count. An exception
    becomes an outcome without results that names the exception. An AttributeError or a TypeError is
    raised.

    name  name of the case in the quick catalogue
    """
    case = CaseToJudge(name, Level.QUICK.name)
    try:
        with TemporaryDirectory() as directory:
            store = CaseStore(Path(directory), JudgedCase)
            store.save(case, case.compute())
            record = store.load(case)
    except (AttributeError, TypeError):
        raise  # the replacement does not fit the program, and plants no wrong result
    except Exception as error:  # reported by name, as in the pool of `verify`
        return lost(case_of(name, Level.QUICK), f"{type(error).__name__}: {error}")
    assert isinstance(record, JudgedCase)
    return record.outcome


def _describe_failure(verdict: Verdict) -> FailedVerdict:
    if verdict.name == SOLVED:
        how = "named error"
    elif verdict.name in LAWS:
        how = LAWS[verdict.name]
    elif verdict.tolerance_kind == "order":
        how = "order"
    else:
        how = f"{verdict.reference_kind}, {verdict.tolerance_kind} tolerance"
    return FailedVerdict(
        quantity=verdict.name,
        run=verdict.run,
        how=how,
        clearance=verdict.clearance,
        reason=verdict.meaning if verdict.name == SOLVED else "",
    )


def cases_under(settings: Settings, defect: Defect) -> tuple[str, ...]:
    """Return the names of the verification cases that are run under a seeded defect.

    At the quick level these are the cases that must detect the defect. At other levels these are
    all cases of the quick catalogue.
    """
    return defect.cases if settings.level is Level.QUICK else CASES


def cases(settings: Settings) -> tuple[DefectRun, ...]:
    """Return the cases of the study: verification cases under every seeded defect, and without a
    defect."""
    runs = [
        DefectRun(defect.name, case)
        for defect in DEFECTS.values()
        for case in cases_under(settings, defect)
    ]
    return (*runs, *dict.fromkeys(DefectRun(HEALTHY, run.case) for run in runs))


@dataclass(frozen=True)
class Detection:
    """Verdicts that detect one seeded defect: they fail under the defect and not without the
    defect.

    cases     cases that are run under the defect
    complete  True if all these cases have a record with the defect and a record without the defect
    verdicts  pairs of a case and a verdict
    """

    defect: Defect
    cases: tuple[str, ...]
    complete: bool
    verdicts: tuple[tuple[str, FailedVerdict], ...]

    @property
    def clearest(self) -> tuple[str, FailedVerdict] | None:
        """Case and verdict that detect the defect with the largest ratio of error to allowed error.

        Verdicts without a number come last. The value is None if no verdict detects the defect.
        """
        return max(self.verdicts, key=lambda one: one[1].clearance or -1.0, default=None)

    @property
    def missed(self) -> bool:
        """True if all cases are run and no verdict detects the seeded defect."""
        return self.complete and not self.verdicts


def detection(settings: Settings, records: Records, defect: Defect) -> Detection:
    """Collect the verdicts of all cases that fail under a seeded defect and not without the defect.

    A case counts only if it has a record with the defect and a record without the defect.
    """
    names = cases_under(settings, defect)
    runs = ((DefectRun(defect.name, case).name, DefectRun(HEALTHY, case).name) for case in names)
    pairs = {
        case: (records[sick], records[well])
        for case, (sick, well) in zip(names, runs, strict=True)
        if sick in records and well in records
    }
    verdicts = []
    for case, (sick, well) in pairs.items():
        before = {(verdict.quantity, verdict.run) for verdict in failed_verdicts(well)}
        verdicts += [
            (case, verdict)
            for verdict in failed_verdicts(sick)
            if (verdict.quantity, verdict.run) not in before
        ]
    return Detection(defect, names, len(pairs) == len(names), tuple(verdicts))


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Judge if the verification detects every seeded defect and passes without a defect.

    The table of the conclusion lists the clearest detection of each defect.
    """
    found = [detection(settings, records, defect) for defect in DEFECTS.values()]
    detected = sum(bool(one.verdicts) for one in found)
    missed = [one.defect.name for one in found if one.missed]
    healthy = [run for run in cases(settings) if run.defect == HEALTHY]
    passed = [records[run.name] for run in healthy if run.name in records]
    alarms = total(passed, "failed")
    return Conclusion(
        answer=f"The cases of the catalogue catch {detected} of {len(found)} defects.",
        statements=(
            Statement(
                claim="the verification catches every seeded defect",
                outcome=Status.FAIL if missed else judged(True, complete=detected == len(found)),
                measured=f"{detected} of {len(found)}"
                + (f"; missed: {', '.join(missed)}" if missed else ""),
                because="by a verdict that passes without it, judged as `slipstick verify` does",
            ),
            Statement(
                claim="without a defect the same cases pass",
                outcome=Status.FAIL
                if alarms
                else judged(True, complete=len(passed) == len(healthy)),
                measured=f"{alarms} of {total(passed, 'verdicts')} verdicts failed in "
                f"{len(passed)} of {len(healthy)} cases",
            ),
        ),
        tables=(_detection_table(found),),
        remarks=REMARKS,
    )


def _detection_table(found: list[Detection]) -> Table:
    return Table(
        title="Seeded defects",
        columns=("defect", "what is broken", "caught by", "how", "error / allowed", "cases"),
        rows=tuple(map(_detection_row, found)),
        note="The verdict that misses by most; an error in units of what is allowed.",
        units=NONE,
    )


def _detection_row(one: Detection) -> tuple[str, ...]:
    caught = how = error = "–"
    votes = "missed" if one.complete else "not judged"
    if one.clearest is not None:
        case, verdict = one.clearest
        caught, how = f"{case}/{verdict.quantity}", verdict.how
        error = "–" if verdict.clearance is None else plain(verdict.clearance, 2)
        votes = f"{len(dict(one.verdicts))} of {len(one.cases)}"
    return one.defect.name, one.defect.broken, caught, how, error, votes


REMARKS = (
    "A defect counts as caught by a verdict that fails under it and passes without it. No verdict "
    "here rests on a recorded baseline: reference, order, residual or a named error caught it.",
    "At the quick level each defect meets the cases that ought to see it; above, the whole quick "
    "catalogue.",
    "Defects are planted by replacing functions of the solvers in the worker process; nothing in "
    "the solvers knows of them.",
    "Three verdicts are what they are because a defect would pass otherwise: the slip in "
    "cattaneo_mindlin, the unlike ratios of compliant_bond, and the tolerance of the approach with "
    "a penalty in fem_hertz. Each judges a law, none looks for a defect.",
)


STUDY = Study(
    name="seeded-defects",
    title="The harness tested: seeded defects",
    question="A verification that cannot fail shows nothing. Which defects of the solvers does "
    "this one see, and do the same cases pass without them?",
    cases=cases,
    conclude=conclude,
)
