"""Cases on several processes; whatever happens to one, the others are finished.

The processes are workers of this machine, or those of a cluster that is there already
(`cluster.py`). Only this process writes records, each as soon as its case has ended.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from multiprocessing import resource_tracker
from pathlib import Path
from typing import Any, Protocol, TypeVar

from contact_results.blas_threads import one_thread
from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.code_digest import code_digest
from contact_scene.reading.description import Description
from verification.running.study import CaseRecord, LostCase, StudyCase

DIGITS = 16
LARGEST_RECORD = 100_000_000  # bytes; those of full verifications have a few hundred thousand


class DamagedRecord(Exception):
    """A file stands in a record's place and is not that record."""


@dataclass(frozen=True)
class CaseStore:
    """A directory of records of one type."""

    directory: Path
    record_type: type[Description] = CaseRecord

    def path(self, case: StudyCase, code: bytes | None = None) -> Path:
        """Where the record of a case is or will be, by the code of this digest or by ours."""
        return self.directory / f"{case.name}-{content_hash(case, code)}.json"

    def load(self, case: StudyCase) -> Description | None:
        """The record; None if there is none. Raises DamagedRecord, which names the file."""
        path = self.path(case)
        try:
            if path.stat().st_size > LARGEST_RECORD:
                raise DamagedRecord(f"{path} is damaged: larger than any record")
            content = path.read_bytes()
        except FileNotFoundError:
            return None
        except OSError as error:
            raise DamagedRecord(f"{path} cannot be read: {error.strerror}") from error
        try:
            document = json.loads(content)
            values = document["record"]
            if document["of"] != path.stem:
                raise DamagedRecord(f"{path} is the record of {document['of']}")
            if document["sha256"] != _digest(values):
                raise DamagedRecord(f"{path} is damaged: its numbers have changed")
            return self.record_type.model_validate_json(json.dumps(values))
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise DamagedRecord(f"{path} is damaged: no whole record of this version") from error

    def save(self, case: StudyCase, record: Description, code: bytes | None = None) -> None:
        """Write the record that code of this digest has made, or ours; whole or not at all."""
        path, values = self.path(case, code), record.model_dump(mode="json")
        document = {"of": path.stem, "sha256": _digest(values), "record": values}
        with atomic_file(path) as temporary:
            temporary.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def content_hash(case: StudyCase, code: bytes | None = None) -> str:
    """Digest of the case's kind and values, and of the code that computes it, if not ours."""
    kind = type(case)
    asked: Any = asdict(case)  # type: ignore[call-overload]
    text = json.dumps([kind.__module__, kind.__qualname__, asked], sort_keys=True)
    return hashlib.sha256(text.encode() + (code or code_digest())).hexdigest()[:DIGITS]


def _digest(values: Any) -> str:
    return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()


# A fresh interpreter: no lock or thread of the parent's libraries is copied half-way.
START = "spawn"

T = TypeVar("T")


class LocalWorkers:
    """So many processes at a time."""

    elsewhere = False

    def __init__(self, processes: int) -> None:
        # Workers inherit the environment. They share the cores, and a record must not depend on who
        # computes it.
        one_thread(always=True)
        _remove_semaphores_silently()
        self._threads = ThreadPoolExecutor(max_workers=processes)
        self._own = threading.local()
        self._all: list[ProcessPoolExecutor] = []

    def submit(self, compute: Callable[..., T], *arguments: object) -> Future[T]:
        """Call the function in a worker; BrokenProcessPool if that dies meanwhile."""
        return self._threads.submit(self._call, compute, *arguments)

    def lost(self) -> list[str]:
        """Return none: a worker that dies takes its case with it, which is named."""
        return []

    def close(self) -> None:
        """Give up what has not been begun, and let the workers go."""
        self._threads.shutdown(cancel_futures=True)
        for worker in self._all:
            worker.shutdown()

    def _call(self, compute: Callable[..., T], *arguments: object) -> T:
        try:
            return self._worker().submit(compute, *arguments).result()
        except BrokenProcessPool:
            del self._own.worker
            raise

    def _worker(self) -> ProcessPoolExecutor:
        if not hasattr(self._own, "worker"):
            context = multiprocessing.get_context(START)
            self._own.worker = ProcessPoolExecutor(1, context, initializer=_obey_parent)
            self._all.append(self._own.worker)
        worker: ProcessPoolExecutor = self._own.worker
        return worker


class ThisProcess:
    """No worker: what is alone has no others to be kept from harm, and pays for no second start."""

    elsewhere = False

    def submit(self, compute: Callable[..., T], *arguments: object) -> Future[T]:
        """Call the function now."""
        future: Future[T] = Future()
        try:
            future.set_result(compute(*arguments))
        except Exception as error:
            future.set_exception(error)
        return future

    def lost(self) -> list[str]:
        """Return none."""
        return []

    def close(self) -> None:
        """Nothing was begun."""


def _remove_semaphores_silently() -> None:
    """Start the process that removes our semaphores if we are stopped; it warns of each as leaked.

    What a person is told at the end of a stopped command shall stand alone.
    """
    if os.name == "nt":
        return  # the system removes them
    before = os.environ.get("PYTHONWARNINGS")
    ignored = "ignore:resource_tracker:UserWarning"
    os.environ["PYTHONWARNINGS"] = ignored if before is None else f"{before},{ignored}"
    try:
        resource_tracker.ensure_running()
    finally:
        if before is None:
            del os.environ["PYTHONWARNINGS"]
        else:
            os.environ["PYTHONWARNINGS"] = before


def cores() -> int:
    """Processors that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1  # macOS and Windows


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
