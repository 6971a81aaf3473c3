"""Cases on several processes; whatever happens to one, the others are finished.

The processes are workers of this machine, or those of a cluster that is there already
(`cluster.py`). Only this process writes records, each as soon as its case has ended.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Future, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass, replace
from typing import Protocol

from contact_results.directory.code_digest import code_digest
from contact_scene.reading.description import Description
from verification.running.case_store import CaseStore, DamagedRecord
from verification.running.local_workers import LocalWorkers
from verification.running.row import CaseRecord
from verification.running.study import LostCase, StudyCase

KILLED = "its worker was killed, by somebody or for lack of memory"
OTHER_CODE = "its worker has other sources of slipstick, or other libraries: install the same there"


@dataclass(frozen=True)
class CaseEnd:
    """How a case ended: with a record or with the reason why there is none.

    stored   whether the record was there before
    damaged  what was there in its place and could not be used; empty if nothing was
    workers  addresses of workers that were found dead meanwhile; others compute their cases
    """

    case: StudyCase
    record: Description | None
    lost: LostCase | None = None
    stored: bool = False
    damaged: str = ""
    workers: tuple[str, ...] = ()

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences on what went wrong and cost nothing but time."""
        dead = (f"worker {one} has died: its cases go to other workers" for one in self.workers)
        return (*((f"{self.damaged}; computed again",) if self.damaged else ()), *dead)


Observer = Callable[[CaseEnd], None]


@dataclass(frozen=True)
class Answer:
    """What a worker sends back.

    record  of the case, or why there is none
    code    digest of the sources that were used
    """

    record: Description | str
    code: bytes


class Workers(Protocol):
    """Where cases are computed.

    elsewhere  whether the workers may have other sources than this process for good
    """

    @property
    def elsewhere(self) -> bool: ...

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        """Call the function in some other process."""

    def lost(self) -> Sequence[str]:
        """Return the addresses of workers that have died since the last call."""

    def close(self) -> None:
        """Give up what has not been begun, and let the workers go."""


def run_cases(
    cases: Iterable[StudyCase],
    store: CaseStore,
    workers: int | Workers,
    observe: Observer,
    *,
    fresh: bool = False,
) -> tuple[CaseEnd, ...]:
    """Records of all cases, in their order: from the store, or computed and stored.

    workers  processes of this machine, >= 1, or others; these are closed at the end too
    observe  called with every case that has ended, in this thread; first with those of the store
    fresh    take nothing from the store
    """
    cases = tuple(cases)
    ends: dict[str, CaseEnd] = {}

    def ended(end: CaseEnd) -> None:
        ends[end.case.name] = end
        observe(end)

    missing = {}
    for case in cases:
        end = CaseEnd(case, None) if fresh else _stored(case, store)
        if end.record is None:
            missing[case.name] = end
        else:
            ended(end)
    pool = LocalWorkers(max(1, min(workers, len(missing)))) if isinstance(workers, int) else workers
    try:
        futures = {pool.submit(_answer, end.case): end for end in missing.values()}
        for future in as_completed(futures):
            end = _ended(futures[future], _received(future, pool), store)
            ended(replace(end, workers=tuple(pool.lost())))
    finally:
        pool.close()
    return tuple(ends[case.name] for case in cases)


def _stored(case: StudyCase, store: CaseStore) -> CaseEnd:
    """With the record of the store, or without one."""
    try:
        record = store.load(case)
    except DamagedRecord as error:
        return CaseEnd(case, None, damaged=str(error))
    return CaseEnd(case, record, stored=record is not None)


def _received(future: Future[Answer], pool: Workers) -> Answer:
    """The answer, or one that says why none came."""
    try:
        answer = future.result()
    except BrokenProcessPool:
        return Answer(KILLED, code_digest())
    except Exception as error:  # of the way to the worker and back
        return Answer(_reason(error), code_digest())
    if pool.elsewhere and answer.code != code_digest():
        return replace(answer, record=OTHER_CODE)
    return answer


def _ended(end: CaseEnd, answer: Answer, store: CaseStore) -> CaseEnd:
    """With what became of the case; its record is stored as that of the sources that made it:
    a source may have been edited since this process was started."""
    if isinstance(answer.record, str):
        return replace(end, lost=LostCase(name=end.case.name, reason=answer.record))
    store.save(end.case, answer.record, answer.code)
    return replace(end, record=answer.record)


def _answer(case: StudyCase) -> Answer:
    """In a worker: the record of a case, or why there is none.

    An error is sent home as text: one that cannot be rebuilt there would look like a dead worker.
    """
    code, started = code_digest(), time.process_time()  # before the sources are used
    try:
        record = case.compute()
        if isinstance(record, CaseRecord) and not record.seconds:  # else it has measured them
            record = record.model_copy(update={"seconds": time.process_time() - started})
        return Answer(record, code)
    except Exception as error:
        return Answer(_reason(error), code)


def _reason(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"
