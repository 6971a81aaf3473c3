"""Cases on local processes; whatever happens to one, the others are finished.

Each of the pool's threads has one worker process of its own. A worker that dies therefore takes
exactly one case with it, which is known by name; the thread gets a new worker and goes on.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import dataclass

from contact_scene.description import Description
from verification.studies.running.case_store import CaseStore
from verification.studies.running.study import LostCase, StudyCase

# A fresh interpreter: no lock or thread of the parent's libraries is copied half-way.
START = "spawn"


@dataclass(frozen=True)
class CaseEnd:
    """How a case ended: with a record or with the reason why there is none.

    stored  whether the record was there before
    """

    case: StudyCase
    record: Description | None
    lost: LostCase | None = None
    stored: bool = False


Observer = Callable[[CaseEnd], None]


def run_cases(
    cases: Iterable[StudyCase], store: CaseStore, workers: int, observe: Observer
) -> tuple[CaseEnd, ...]:
    """Records of all cases, in their order: from the store, or computed and stored.

    workers  processes at a time, >= 1
    observe  called with every case that has ended, in this thread
    """
    cases = tuple(cases)
    ends: dict[str, CaseEnd] = {}

    def ended(end: CaseEnd) -> None:
        ends[end.case.name] = end
        observe(end)

    missing = []
    for case in cases:
        record = store.load(case)
        if record is None:
            missing.append(case)
        else:
            ended(CaseEnd(case, record, stored=True))
    pool = _Workers(store)
    threads = ThreadPoolExecutor(max_workers=max(1, min(workers, len(missing))))
    try:
        for future in as_completed([threads.submit(pool.compute, case) for case in missing]):
            ended(future.result())
    finally:
        threads.shutdown(cancel_futures=True)
        pool.close()
    return tuple(ends[case.name] for case in cases)


class _Workers:
    """One worker process per thread that asks."""

    def __init__(self, store: CaseStore) -> None:
        self._store = store
        self._own = threading.local()
        self._all: list[ProcessPoolExecutor] = []

    def compute(self, case: StudyCase) -> CaseEnd:
        try:
            record = self._worker().submit(_compute_and_store, case, self._store).result()
        except BrokenProcessPool:
            del self._own.worker
            return CaseEnd(case, None, LostCase(name=case.name, reason="its process died"))
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
            return CaseEnd(case, None, LostCase(name=case.name, reason=reason))
        return CaseEnd(case, record)

    def close(self) -> None:
        for worker in self._all:
            worker.shutdown()

    def _worker(self) -> ProcessPoolExecutor:
        if not hasattr(self._own, "worker"):
            context = multiprocessing.get_context(START)
            self._own.worker = ProcessPoolExecutor(1, context, initializer=_obey_parent)
            self._all.append(self._own.worker)
        worker: ProcessPoolExecutor = self._own.worker
        return worker


def _compute_and_store(case: StudyCase, store: CaseStore) -> Description:
    """In the worker: a record that is done is safe even if the parent dies now."""
    record = case.compute()
    store.save(case, record)
    return record


def _obey_parent() -> None:
    """End with the parent, however it ends; its terminal's interrupts are for it alone."""
    with suppress(ValueError):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def wait_for_its_end() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=wait_for_its_end, daemon=True).start()
