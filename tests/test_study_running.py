"""Tests of the execution of studies: records are reused, and a lost case affects only itself."""

import html
import os
import re
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, replace
from pathlib import Path

import pytest
from study_cases import Dying, Killed, Number, Refusing, Square, Timed

from contact_results.blas_threads import VARIABLES
from slipstick.cli.commands.study import compute_study
from verification.judging.case import Level
from verification.report.files import set_aside, write_study
from verification.report.summary_text import stored_records
from verification.running.case_pool import (
    KILLED,
    Answer,
    CaseEnd,
    CaseStore,
    DamagedRecord,
    LocalWorkers,
    ThisProcess,
    run_cases,
)
from verification.running.provenance import provenance
from verification.running.study import (
    CaseRecord,
    Settings,
    StudyCase,
    StudyRecord,
    stored_studies,
)
from verification.studies.catalogue import STUDIES


@dataclass
class InThisProcess(ThisProcess):
    """Workers without a process; `code` is what they say their sources are."""

    elsewhere: bool = False
    code: bytes | None = None

    def lost(self) -> list[str]:
        return ["tcp://here:1"]

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        future = Future()
        answer = super().submit(compute, case).result()
        future.set_result(answer if self.code is None else replace(answer, code=self.code))
        return future


CASE = Square(3.0)
EARLIER = Number(value=9.0, process=1)


@pytest.fixture
def store(tmp_path):
    return CaseStore(tmp_path, Number)


def end_of(
    store: CaseStore, workers: InThisProcess | None = None, *, fresh: bool = False
) -> CaseEnd:
    """End of the case in this process, unless workers are given."""
    workers = workers or InThisProcess()
    (end,) = run_cases([CASE], store, workers, lambda end: None, fresh=fresh)
    return end


@pytest.mark.parametrize(
    ("damage", "problem"),
    [
        (lambda whole: whole[: len(whole) // 2], "is damaged"),
        (lambda whole: whole.replace(b"9.0", b"8.0"), "its numbers have changed"),
        (lambda whole: whole.replace(b"square-3", b"square-4"), "is the record of square-4"),
        (lambda whole: b'{"other": 1}', "is damaged"),
        (lambda whole: b"[" * 100_000, "is damaged"),
        (lambda whole: b"\xff\x00" * 20, "is damaged"),
        (lambda whole: b"", "is damaged"),
    ],
)
def test_file_that_is_not_the_record_is_named_and_computed_again(damage, problem, store):
    store.save(CASE, EARLIER)
    path = store.path(CASE)
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(DamagedRecord, match=problem) as error:
        store.load(CASE)
    assert str(path) in str(error.value)
    end = end_of(store)
    assert str(path) in end.damaged
    assert not end.stored
    assert store.load(CASE) == end.record == Number(value=9.0, process=os.getpid())


def test_record_of_other_sources_is_not_taken(store):
    store.save(CASE, EARLIER, b"other sources")
    assert store.load(CASE) is None
    store.save(CASE, EARLIER)
    assert len(list(store.path(CASE).parent.iterdir())) == 2
    assert store.load(CASE) == EARLIER


def test_fresh_takes_nothing_from_the_store(store):
    store.save(CASE, EARLIER)
    assert not end_of(store, fresh=True).stored
    assert store.load(CASE) == Number(value=9.0, process=os.getpid())


@pytest.mark.parametrize("elsewhere", [False, True])
def test_only_workers_elsewhere_must_have_the_same_sources(elsewhere, store):
    """A source that is edited during a run of hours does not stop it; nothing false is stored."""
    end = end_of(store, InThisProcess(elsewhere, b"edited"))
    assert (end.lost is None) is not elsewhere
    assert (end.record is None) is elsewhere
    assert store.load(CASE) is None


def test_failing_and_dying_cases_are_named_and_the_others_finish(tmp_path):
    seen = []
    cases = (
        Square(1.0),
        Dying(10.0),
        Square(2.0),
        Refusing(20.0),
        Square(3.0),
        Killed(30.0),
        Square(4.0),
    )
    ends = run_cases(cases, CaseStore(tmp_path, Number), 2, seen.append)
    assert [end.case for end in ends] == list(cases)
    assert {end.case.name for end in seen} == {case.name for case in cases}
    values = {end.case.name: end.record.value for end in ends if isinstance(end.record, Number)}
    assert values == {"square-1": 1.0, "square-2": 4.0, "square-3": 9.0, "square-4": 16.0}
    lost = {end.lost.name: end.lost.reason for end in ends if end.lost is not None}
    assert lost == {
        "square-10": KILLED,
        "square-20": "ArithmeticError: no square today",
        "square-30": KILLED,
    }

    again = run_cases(cases[:1] + cases[2:3], CaseStore(tmp_path, Number), 2, seen.append)
    assert all(end.stored for end in again)
    assert [end.record for end in again] == [ends[0].record, ends[2].record]


def test_a_worker_has_one_thread_whatever_was_asked_for(monkeypatch):
    for variable in VARIABLES:
        monkeypatch.setenv(variable, "2")
    workers = LocalWorkers(1)
    try:
        assert [workers.submit(os.getenv, name).result() for name in VARIABLES] == ["1"] * 3
    finally:
        workers.close()


def stored(directory: Path, name: str = "stability") -> StudyRecord:
    """A study without cases, stored as its command stores it."""
    chosen = STUDIES[name]
    record = StudyRecord(
        name=chosen.name,
        title=chosen.title,
        question="Is 1 < 2?",
        level="quick",
        conclusion=chosen.conclude(Settings(Level.QUICK), {}).model_copy(
            update={"answer": "Yes, 1 < 2."}
        ),
        lost=(),
        provenance=provenance("slipstick maintain study", {}),
    )
    write_study(record, {}, directory / name)
    return record


@pytest.mark.parametrize("name", STUDIES)
def test_stored_study_is_found_again_and_its_page_shows_the_answer(name, tmp_path):
    record = stored(tmp_path, name)
    assert stored_studies(tmp_path) == (record,)
    page = (tmp_path / name / "index.html").read_text(encoding="utf-8")
    assert "Yes, 1 &lt; 2." in page
    for statement in record.conclusion.statements:
        assert statement.claim in html.unescape(page)


def test_a_study_that_is_stopped_leaves_no_record_of_an_earlier_one(tmp_path, monkeypatch):
    """It waits aside until the new one is whole."""
    record = stored(tmp_path, "coated-tractions")
    directory = tmp_path / "coated-tractions"

    def stopped(*_, **__):
        assert stored_studies(tmp_path) == ()
        raise KeyboardInterrupt

    monkeypatch.setattr("verification.running.case_pool.run_cases", stopped)
    chosen = STUDIES["coated-tractions"]
    with pytest.raises(KeyboardInterrupt):
        compute_study(chosen, Settings(Level.QUICK, 16), "slipstick maintain study", directory, 1)
    set_aside(directory)  # finds what the stopped study has left
    assert stored_studies(tmp_path) == ()
    assert stored_studies(directory) == (record,)


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: text[:100],
        lambda text: re.sub(r'"schema_version": \d+', '"schema_version": 99', text),
    ],
    ids=["cut short", "of another version"],
)
def test_stored_study_that_cannot_be_read_is_named(damage, tmp_path):
    stored(tmp_path)
    path = tmp_path / "stability" / "study.json"
    path.write_text(damage(path.read_text(encoding="utf-8")), encoding="utf-8")
    with pytest.raises(ValueError, match=r"stability.study\.json"):
        stored_records([tmp_path])
    told = []
    assert stored_records([tmp_path], told.append) == ()
    assert [str(path) in problem for problem in told] == [True]


@pytest.mark.parametrize("said", [0.0, 9.0])
def test_seconds_are_the_workers_unless_the_case_measures_them(tmp_path, said):
    (end,) = run_cases([Timed(0.02, said)], CaseStore(tmp_path), InThisProcess(), lambda end: None)
    assert isinstance(end.record, CaseRecord)
    assert end.record.seconds == said if said else 0.02 <= end.record.seconds < 1.0
