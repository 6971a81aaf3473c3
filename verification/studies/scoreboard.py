"""Study that judges all codes, this program and others, on all challenges by the same bounds.

A challenge is a contact problem with a known solution.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import inf

from contact_results.directory.machine import program_version
from verification.adapters import own_solvers as own
from verification.challenge.cases import challenges
from verification.challenge.python_api import Judgement, judge
from verification.challenge.requested_quantities import Solver
from verification.challenge.solver_process import CannotDo
from verification.exhibits.chart import NONE, Table, plain
from verification.judging.case import Level
from verification.judging.outcome import Status
from verification.peers.environment import (
    PEERS,
    installed_version,
    make_answer_function,
)
from verification.running.study import (
    CaseRecord,
    Conclusion,
    Records,
    Row,
    Settings,
    Statement,
    Study,
)

OURS = {
    own.ON_CELLS.name: (own.ON_CELLS, own.answer_on_cells),
    own.WITH_EDGES.name: (own.WITH_EDGES, own.answer_with_edges),
    own.ON_ELEMENTS.name: (own.ON_ELEMENTS, own.answer_on_elements),
    own.ON_RADII.name: (own.ON_RADII, own.answer_on_radii),
}
NO_ANSWER = "–"
LEVELS = {Level.QUICK: 3, Level.STANDARD: 3, Level.FULL: 4}
CANNOT = "cannot"
LINE = "line"
GRADE = "grade"
VERSION = "version"


@dataclass(frozen=True)
class ScoredRun:
    """Judgement of one code on one challenge (a problem with a known solution), as a case of the
    study.

    code       name of this program's solver or of another code
    challenge  name of the challenge
    levels     number of refinement levels
    """

    code: str
    challenge: str
    levels: int

    @property
    def name(self) -> str:
        """File name of the record of the judgement: the code and the challenge."""
        return "".join(c if c.isalnum() else "-" for c in f"{self.code}-{self.challenge}")

    def compute(self) -> CaseRecord:
        """Solve the challenge by the code on all refinement levels and record the judgement of the
        answers.

        If the code cannot solve the challenge, the record has the reason instead.
        """
        asked: dict[str, str | bool | int | float | None] = {
            "code": self.code,
            "challenge": self.challenge,
            "levels": self.levels,
        }
        try:
            return _record_judgement(self._judge_code(), asked)
        except CannotDo as error:
            return CaseRecord(parameters=asked, words={CANNOT: str(error)})

    def _judge_code(self) -> Judgement:
        if self.code in OURS:
            solver, answer = OURS[self.code]
            solver = replace(solver, version=program_version())
            return judge(self.challenge, answer, self.levels, solver=solver, seconds=None)
        (peer,) = (peer for peer in PEERS if peer.name == self.code)
        described = Solver(peer.name, installed_version(peer.module))
        solve = make_answer_function(peer)
        return judge(self.challenge, solve, self.levels, solver=described, seconds=None)


def cases(settings: Settings) -> tuple[ScoredRun, ...]:
    """Return the cases of the study: each code on each challenge."""
    codes = (*OURS, *(peer.name for peer in PEERS))
    levels = settings.levels or LEVELS[settings.level]
    return tuple(ScoredRun(code, name, levels) for code in codes for name in challenges())


def conclude(settings: Settings, records: Records) -> Conclusion:
    """Compare all codes by tables: accuracy class, CPU time and largest errors on each benchmark
    problem."""
    runs = [(run, records[run.name]) for run in cases(settings) if run.name in records]
    done = Counter(run.code for run, record in runs if CANNOT not in record.words)
    codes = list(dict.fromkeys(run.code for run, _ in runs))
    found = {(run.challenge, run.code): record for run, record in runs}
    versions = {run.code: record.words[VERSION] for run, record in runs if VERSION in record.words}
    return Conclusion(
        statements=tuple(
            Statement(
                claim=f"{' '.join(filter(None, (code, versions.get(code))))} answers",
                outcome=None,
                measured=f"{done[code]} of {len(challenges())} challenges",
            )
            for code in codes
        ),
        answer=f"On {32 * 2 ** ((settings.levels or LEVELS[settings.level]) - 1)} cells a side all "
        "codes with cells of constant traction share one error; who differs is told below.",
        tables=(
            _table_by_code(
                "Classes by challenge and code",
                found,
                codes,
                _class_text,
                "Verdicts that pass of all; class A is 1e-4 of a stated scale, B 1e-3, C 1e-2, on "
                "the finest of the levels; partial: something required is not answered.",
            ),
            # As measured, or as the code itself reports.
            _table_by_code(
                "CPU seconds of all levels", found, codes, lambda record: plain(record.seconds, 2)
            ),
            Table(
                title="Largest errors",
                columns=("challenge", "quantity", *codes),
                rows=tuple(_largest_error_rows(found, codes)),
                units=NONE,
            ),
        ),
        remarks=tuple(
            f"{run.code} on {run.challenge}: {record.words[CANNOT]}."
            for run, record in runs
            if CANNOT in record.words
        ),
    )


def _record_judgement(
    judgement: Judgement, asked: dict[str, str | bool | int | float | None]
) -> CaseRecord:
    parts = tuple(
        Row(
            parameters={"quantity": row.quantity, "step": row.step, "level": row.level},
            measures={"error": row.error, "bound": row.bound},
            words={"status": row.status, "because": row.because},
        )
        for row in judgement.rows
    )
    counters = {status.value: judgement.count(status) for status in Status}
    counters["omitted"] = len(judgement.omitted)
    seconds = sum(answer.seconds or 0.0 for answer in judgement.answers)
    told = {LINE: judgement.line, GRADE: judgement.grade, VERSION: judgement.solver.version}
    return CaseRecord(
        parameters=asked,
        words=told,
        counters=counters,
        parts=parts,
        seconds=seconds,
    )


def _table_by_code(
    title: str,
    found: dict[tuple[str, str], CaseRecord],
    codes: list[str],
    text: Callable[[CaseRecord], str],
    note: str = "",
) -> Table:
    """Build a table with one row per challenge and one column per code.

    found  records by challenge and code
    codes  names of the codes
    text   function from the record of an answered challenge to the text of its cell
    """

    def cell(record: CaseRecord | None) -> str:
        return NO_ANSWER if record is None or CANNOT in record.words else text(record)

    rows = tuple(
        (name, *(cell(found.get((name, code))) for code in codes)) for name in challenges()
    )
    return Table(title=title, columns=("challenge", *codes), rows=rows, note=note, units=NONE)


def _class_text(record: CaseRecord) -> str:
    all_verdicts = sum(record.counters[status] for status in Status)
    return f"{record.words[GRADE]}, {record.counters[Status.PASS]} of {all_verdicts}"


def _largest_error_rows(
    found: dict[tuple[str, str], CaseRecord], codes: list[str]
) -> Iterator[tuple[str, ...]]:
    """Yield the rows of the table of largest errors: challenge, quantity, and one error per code.

    Each error is the largest of all load steps.

    found  records by challenge and code
    codes  names of the codes
    """
    for name in challenges():
        worst: dict[str, dict[str, float]] = {}
        for code in codes:
            record = found.get((name, code))
            for row in record.parts if record else ():
                error, quantity = row.measures["error"], str(row.parameters["quantity"])
                if row.measures["bound"] is not None:
                    of = worst.setdefault(quantity, {})
                    of[code] = max(of.get(code, 0.0), inf if error is None else error)
        for quantity, of in worst.items():
            texts = (plain(of[code], 2) if code in of else NO_ANSWER for code in codes)
            yield name, quantity, *texts


STUDY = Study(
    name="scoreboard",
    title="Codes on our challenges",
    question="How good are this and other codes on problems whose answer is known, all judged by "
    "the same bounds and by the same door?",
    cases=cases,
    conclude=conclude,
)
