"""Tolerances of the verdicts that follow the errors of the accepted results.

A case states a bound with its theoretical reason. Errors are usually far below the bound, so that a
defect that triples them would pass. The proposed tolerance of a number is about twice its largest
error over several BLAS kernels. It is proposed if the error is below a third of the present
tolerance. A proposal is accepted with a reason, in one file per level, and never exceeds the bound
of its case.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from contact_results.directory.json_record import read_record, write_record
from contact_scene.reading.description import Description
from verification.judging.outcome import Verdict, status_of_difference
from verification.regression.baseline import RESTORE, BaselineRefused, key_of

if TYPE_CHECKING:
    from verification.judging.outcome import CaseOutcome
    from verification.running.report_record import Report


TOLERANCES = Path(__file__).resolve().parents[1] / "tolerances"
SLACK = 3.0
TIMES = 2.0
# Over the scale of errors and the tolerance of a solve: by less an error depends on the iterate at
# which the solve ends, and with it on the processor. Numbers without a run are held to the
# tolerance of the radial solver.
LEAST = 10.0
WITHOUT_RUN = 1e-10
# Part of the last change Σ|Δp|/Σp of an edge correction that a number may move by, in addition to
# its error, which is 0.2 % to 2 % of this change. On 41 numbers of five cases the kernels Haswell
# and Katmai differ by at most 3e-6 of it.
MOVED = 0.01


class Tolerance(Description):
    """Accepted tolerance of one verification result, and its largest error at the time of
    acceptance.

    Both are relative to the error scale of the result.
    """

    allowed: float
    error: float


class Acceptance(Description):
    """Tolerances of verification results that were accepted together, with the reason.

    because     reason for the acceptance
    commit      commit of the source that computed the errors
    kernels     processors or BLAS kernels on which the errors were measured
    tolerances  accepted tolerances by case and key of the number
    """

    because: str
    commit: str | None
    kernels: tuple[str, ...]
    tolerances: dict[str, dict[str, Tolerance]]


class Tolerances(Description):
    """Accepted tolerances of all cases at one level (quick, standard or full): content of one
    file."""

    level: str
    accepted: tuple[Acceptance, ...] = ()

    def of(self, case: str) -> dict[str, tuple[Tolerance, Acceptance]]:
        """Return the accepted tolerances of a case, each with its acceptance, by key of the number.

        case  name of the verification case
        """
        return {
            key: (tolerance, acceptance)
            for acceptance in self.accepted
            for key, tolerance in acceptance.tolerances.get(case, {}).items()
        }


def read_tolerances(level: str, directory: Path = TOLERANCES) -> Tolerances:
    """Read the accepted tolerances of a level (quick, standard or full) from their file.

    The result has no tolerances if there is no file. Raises BaselineRefused for a damaged file.
    """
    path = directory / f"{level}.json"
    if not path.exists():
        return Tolerances(level=level)
    return read_record(path, Tolerances, "file of tolerances", RESTORE, BaselineRefused)


def held_to(cases: Sequence[CaseOutcome], tolerances: Tolerances) -> tuple[CaseOutcome, ...]:
    """Judge the results of verification cases again by the accepted tolerances.

    An accepted tolerance applies if it is smaller than the present tolerance of the verdict. It is
    at least the uncertainty of the reference: smaller errors cannot be distinguished from it.
    """
    return tuple(
        case.model_copy(
            update={
                "verdicts": tuple(
                    _judge_by_tolerance(v, known.get(text_of(v))) for v in case.verdicts
                )
            }
        )
        for case in cases
        for known in (tolerances.of(case.name),)
    )


def _judge_by_tolerance(verdict: Verdict, known: tuple[Tolerance, Acceptance] | None) -> Verdict:
    if known is None:
        return verdict
    tolerance, acceptance = known
    allowed = max(tolerance.allowed, verdict.least)
    if allowed >= verdict.allowed:
        return verdict
    error = math.nan if verdict.error is None else verdict.error
    return verdict.model_copy(
        update={
            "allowed": allowed,
            "bound": verdict.allowed,
            "status": status_of_difference(error, allowed, verdict.least),
            "because": f"{verdict.because}; of the bound {verdict.allowed:.2g} so much is allowed: "
            + (
                f"{TIMES:g} times the error {tolerance.error:.2g} ({acceptance.because})"
                if allowed == tolerance.allowed
                else "the uncertainty of the reference"
            ),
        }
    )


def proposed(
    reports: Sequence[Report], known: Tolerances | None = None
) -> dict[str, dict[str, Tolerance]]:
    """Propose tolerances of verification results from reports of one level on several BLAS kernels.

    A number gets a proposal if its tolerance exceeds three times the largest error, or if the error
    exceeds its tolerance, and the proposal is below the bound of its case. Returns the tolerances
    by case and key of the number.

    known  accepted tolerances, by which the reports are judged first
    """
    found: dict[str, dict[str, Tolerance]] = {}
    if known is not None:
        reports = [
            report.model_copy(update={"cases": held_to(report.cases, known)}) for report in reports
        ]
    for case, key, verdicts, floor in _common_numbers(reports):
        bound, held = (verdicts[0].bound or verdicts[0].allowed), verdicts[0].allowed
        error = max(verdict.error or 0.0 for verdict in verdicts)
        floor = max(floor, *(verdict.least for verdict in verdicts))
        allowed = float(f"{TIMES * error + floor:.2g}")
        slack = held > SLACK * max(error, floor) or error > held
        if slack and allowed < bound:
            found.setdefault(case, {})[key] = Tolerance(allowed=allowed, error=error)
    return found


def _common_numbers(reports: Sequence[Report]) -> Iterator[tuple[str, str, list[Verdict], float]]:
    """Yield each finite number that all reports have: case, key, its verdicts, and an allowance.

    The allowance is added to proposed tolerances, because an error depends on the iterate at which
    a solve ends. It is ten times the tolerance of the solve, plus 1 % of the last change of an edge
    correction. Convergence orders are left out.
    """
    levels = sorted({report.level for report in reports})
    if len(levels) != 1:
        raise BaselineRefused(f"the reports are of the levels {', '.join(levels)}; name one level")
    maps = [
        {(case.name, text_of(v)): v for case in report.cases for v in case.verdicts}
        for report in reports
    ]
    solved = {
        (case.name, run.label): LEAST * run.tolerance + MOVED * run.edge_change
        for case in reports[0].cases
        for run in case.runs
    }
    for key, verdict in maps[0].items():
        verdicts = [found[key] for found in maps if key in found]
        finite = all(v.error is not None for v in verdicts) and len(verdicts) == len(maps)
        if finite and verdict.tolerance_kind != "order":
            labels = verdict.runs or (verdict.run,)
            least = max(solved.get((key[0], label), LEAST * WITHOUT_RUN) for label in labels)
            yield *key, verdicts, least


def accept_tolerances(reports: Sequence[Report], because: str, directory: Path = TOLERANCES) -> int:
    """Store the tolerances proposed from reports in the file of their level; return their number.

    Raises BaselineRefused without a reason.

    because    reason for which the errors are correct
    directory  folder of the files of tolerances
    """
    because = " ".join(because.split())
    if not because:
        raise BaselineRefused("tolerances need a reason: --because 'why these errors are right'")
    level = reports[0].level
    earlier = read_tolerances(level, directory)
    new = proposed(reports, earlier)
    kept = tuple(
        acceptance.model_copy(update={"tolerances": rest})
        for acceptance in earlier.accepted
        if (rest := _remove_tolerances(acceptance.tolerances, new))
    )
    made = [report.provenance for report in reports]
    kernels = dict.fromkeys(str(one.machine.get("arithmetic", "unknown")) for one in made)
    accepted = Acceptance(
        because=because, commit=made[0].commit, kernels=tuple(kernels), tolerances=new
    )
    content = Tolerances(level=level, accepted=(*kept, *((accepted,) if new else ())))
    write_record(directory / f"{level}.json", content)
    return sum(map(len, new.values()))


def _remove_tolerances(
    tolerances: Mapping[str, Mapping[str, Tolerance]], new: Mapping[str, Mapping[str, Tolerance]]
) -> dict[str, dict[str, Tolerance]]:
    rest = {
        case: {key: one for key, one in keys.items() if key not in new.get(case, {})}
        for case, keys in tolerances.items()
    }
    return {case: keys for case, keys in rest.items() if keys}


def text_of(verdict: Verdict) -> str:
    """Return the key of a judged quantity in its case as text: name, run and kind of tolerance.

    Accepted tolerances are stored by this key.
    """
    name, run, kind = key_of(verdict)
    return f"{name} [{run}] {kind}"
