"""Computation of the cases of a study on several processes.

An error or a killed process affects only its own case. The processes are workers of this machine or
of an existing cluster (`ClusterWorkers`). Only the parent process writes records, each as soon as
its case has ended.
"""

from __future__ import annotations

import hashlib
import importlib
import json
import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    CancelledError,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    wait,
)
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from multiprocessing import resource_tracker
from pathlib import Path
from typing import Any

from contact_results.blas_threads import one_thread
from contact_results.directory.atomic_file import atomic_file
from contact_results.directory.code_digest import code_digest
from contact_scene.reading.description import Description
from verification.running.study import CaseRecord, LostCase, StudyCase

DIGITS = 16
LARGEST_RECORD = 100_000_000  # bytes; those of full verifications have a few hundred thousand


class DamagedRecord(Exception):
    """Exception for a stored case record that is unreadable, damaged, or of another case."""


@dataclass(frozen=True)
class CaseStore:
    """Store of case records on disk: a directory with one file per case of a study.

    An interrupted study reads the records of its finished cases from the store.

    record_type  type of all records
    """

    directory: Path
    record_type: type[Description] = CaseRecord

    def path(self, case: StudyCase, code: bytes | None = None) -> Path:
        """Return the path of the stored record of a case.

        The file name contains a digest of the case and the source code, so that a changed case or
        code has another file.

        code  digest of the source code that computes the case; None for that of this process
        """
        return self.directory / f"{case.name}-{content_hash(case, code)}.json"

    def load(self, case: StudyCase) -> Description | None:
        """Read the stored record of a case; None if the store has no record of this case and source
        code.

        Raises DamagedRecord, which names the file, if the file cannot be used.
        """
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
            if document["sha256"] != _record_digest(values):
                raise DamagedRecord(f"{path} is damaged: its numbers have changed")
            return self.record_type.model_validate_json(json.dumps(values))
        except (ValueError, KeyError, TypeError, RecursionError) as error:
            raise DamagedRecord(f"{path} is damaged: no whole record of this version") from error

    def save(self, case: StudyCase, record: Description, code: bytes | None = None) -> None:
        """Write the record of a case to the store, as a complete file or none.

        code  digest of the source code that computed the record; None for that of this process
        """
        path, values = self.path(case, code), record.model_dump(mode="json")
        document = {"of": path.stem, "sha256": _record_digest(values), "record": values}
        with atomic_file(path) as temporary:
            temporary.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


def content_hash(case: StudyCase, code: bytes | None = None) -> str:
    """Compute a digest of the type and values of a case and of the source code.

    The digest is part of the name of the stored record.

    code  digest of the source code; None for that of this process
    """
    kind = type(case)
    asked: Any = asdict(case)  # type: ignore[call-overload]
    text = json.dumps([kind.__module__, kind.__qualname__, asked], sort_keys=True, default=repr)
    return hashlib.sha256(text.encode() + (code or code_digest())).hexdigest()[:DIGITS]


def _record_digest(values: Any) -> str:
    return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()


@dataclass(frozen=True)
class Answer:
    """Reply of a worker process for one case of a study.

    record  record of the case, or as text the reason why there is no record
    code    digest of the source code that the worker used
    """

    record: Description | str
    code: bytes


class Workers:
    """Pool of workers that compute the cases of a study.

    elsewhere  True if the workers may have other source code than this process
    """

    elsewhere = False

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        """Call a function with a case of a study in a worker and return the future of its reply.

        The future raises BrokenProcessPool if the worker dies.
        """
        raise NotImplementedError

    def lost(self) -> Sequence[str]:
        """Return the network addresses of workers of the pool that have died since the last call.

        A worker of this machine that dies is reported with its case instead.
        """
        return ()

    def deserted(self) -> str:
        """Return the reason why no case will be computed any more; empty as long as one may be."""
        return ""

    def close(self) -> None:
        """Cancel the calls that have not started, and release the worker processes of the pool."""


# A new interpreter inherits no locks or threads of the parent's libraries.
START = "spawn"


class LocalWorkers(Workers):
    """Pool of worker processes on this machine, which compute the cases of a study.

    A worker that is killed affects only its own case.

    processes  largest number of workers
    """

    def __init__(self, processes: int) -> None:
        # Workers inherit the environment. They share the cores, and a record must not depend on who
        # computes it.
        one_thread(always=True)
        _remove_semaphores_silently()
        self._threads = ThreadPoolExecutor(max_workers=processes)
        self._own = threading.local()
        self._all: list[ProcessPoolExecutor] = []

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        return self._threads.submit(self._call, compute, case)

    def close(self) -> None:
        self._threads.shutdown(cancel_futures=True)
        for worker in self._all:
            worker.shutdown()

    def _call(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Answer:
        try:
            return self._worker().submit(compute, case).result()
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


class ThisProcess(Workers):
    """Pool without worker processes, which calls functions in the current process.

    Used where starting workers would cost more than the computation.
    """

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        future: Future[Answer] = Future()
        future.set_result(compute(case))
        return future


def _remove_semaphores_silently() -> None:
    """Start Python's resource tracker with its warnings disabled, before worker processes are
    started.

    The tracker removes semaphores if this process is stopped. It would print a warning for each
    semaphore after the last message of a stopped command.
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
    """Return the number of processors that this process may use, for the number of worker
    processes."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1  # macOS and Windows


def _obey_parent() -> None:
    """Initialise a worker process, which ignores terminal interrupts and exits when its parent
    ends."""
    with suppress(ValueError):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    parent = multiprocessing.parent_process()
    assert parent is not None

    def wait_for_its_end() -> None:
        parent.join()
        os._exit(1)

    threading.Thread(target=wait_for_its_end, daemon=True).start()


SECONDS_BETWEEN_LOOKS = 1.0
KILLED = "its worker was killed, by somebody or for lack of memory"
CANCELLED = "the scheduler of its worker has ended, or has cancelled the case"
OTHER_CODE = "its worker has other sources of slipstick, or other libraries: install the same there"


@dataclass(frozen=True)
class CaseEnd:
    """Outcome of one case of a study: its record, or the reason why there is no record.

    case     case of the study
    record   record of the case; None if it was not computed
    lost     reason why there is no record; None if there is a record
    stored   True if the record was read from the store
    damaged  message on a stored file that could not be used; empty if there was none
    """

    case: StudyCase
    record: Description | None
    lost: LostCase | None = None
    stored: bool = False
    damaged: str = ""


Observer = Callable[[CaseEnd], None]


def run_cases(
    cases: Iterable[StudyCase],
    store: CaseStore,
    workers: int | Workers,
    observe: Observer,
    *,
    fresh: bool = False,
    warn: Callable[[str], None] = lambda text: None,
) -> tuple[CaseEnd, ...]:
    """Compute the cases of a study that have no stored record, and store their records.

    Returns the outcomes of all cases, in the order of the cases.

    store    store of case records
    workers  number of processes on this machine, >= 1, or a pool of workers, which is closed at the
             end
    observe  function called in this thread with the outcome of every case; stored cases come first
    fresh    if True, compute every case even if it has a stored record
    warn     function called in this thread with a message on a damaged file or a dead worker
    """
    cases = tuple(cases)
    ends: dict[str, CaseEnd] = {}

    def ended(end: CaseEnd) -> None:
        ends[end.case.name] = end
        if end.damaged:
            warn(f"{end.damaged}; computed again")
        observe(end)

    missing = {}
    for case in cases:
        end = CaseEnd(case, None) if fresh else _stored_end(case, store)
        if end.record is None:
            missing[case.name] = end
        else:
            ended(end)
    pool = LocalWorkers(max(1, min(workers, len(missing)))) if isinstance(workers, int) else workers
    try:
        futures = {pool.submit(_compute_case, end.case): end for end in missing.values()}
        while futures:
            done, _ = wait(futures, SECONDS_BETWEEN_LOOKS, FIRST_COMPLETED)
            for worker in pool.lost():
                warn(f"worker {worker} has died: its cases go to other workers")
            for future in [one for one in futures if one in done]:  # in the order of the cases
                answer = _received_answer(future, pool)
                ended(_computed_end(futures.pop(future), answer, store))
            if reason := pool.deserted():
                for end in futures.values():
                    ended(_computed_end(end, Answer(reason, code_digest()), store))
                break
    finally:
        pool.close()
    return tuple(ends[case.name] for case in cases)


def _stored_end(case: StudyCase, store: CaseStore) -> CaseEnd:
    """Read the stored record of a case and return the outcome of the case.

    The outcome has no record if none is stored, and a message if a stored file cannot be used.
    """
    try:
        record = store.load(case)
    except DamagedRecord as error:
        return CaseEnd(case, None, damaged=str(error))
    return CaseEnd(case, record, stored=record is not None)


def _received_answer(future: Future[Answer], pool: Workers) -> Answer:
    """Wait for the reply of a worker for a case, and return the reply.

    If no reply is received, or the worker has other source code, the returned reply contains the
    reason in place of the record.
    """
    try:
        answer = future.result()
    except BrokenProcessPool:
        return Answer(KILLED, code_digest())
    except CancelledError:
        return Answer(CANCELLED, code_digest())
    except Exception as error:  # raised by the communication with the worker
        return Answer(_error_text(error), code_digest())
    if pool.elsewhere and answer.code != code_digest():
        return replace(answer, record=OTHER_CODE)
    return answer


def _computed_end(end: CaseEnd, answer: Answer, store: CaseStore) -> CaseEnd:
    """Store the record that a worker has computed and return the completed outcome of the case.

    The record is stored under the digest of the source code that computed it, because a source file
    may have been edited since this process was started.

    end     outcome of the case, still without record
    answer  reply of the worker
    """
    if isinstance(answer.record, str):
        return replace(end, lost=LostCase(name=end.case.name, reason=answer.record))
    store.save(end.case, answer.record, answer.code)
    return replace(end, record=answer.record)


def _compute_case(case: StudyCase) -> Answer:
    """Compute a case in a worker process and return its record, or the error as text.

    Errors are returned as text, because an exception that cannot be unpickled in the parent process
    would look like a dead worker.
    """
    code, started = code_digest(), time.process_time()  # before the sources are used
    try:
        record = case.compute()
        if isinstance(record, CaseRecord) and not record.seconds:  # else it has measured them
            record = record.model_copy(update={"seconds": time.process_time() - started})
        return Answer(record, code)
    except Exception as error:
        return Answer(_error_text(error), code)


def _error_text(error: Exception) -> str:
    return f"{type(error).__name__}: {error}"


SCHEMES = ("tcp://", "tls://")
SECONDS_TO_CONNECT = 10
# A worker that is killed is replaced within seconds, by its nanny; a person needs minutes.
SECONDS_WITHOUT_WORKER = 300


class ClusterUnavailable(Exception):
    """Exception for a dask scheduler that does not answer, an invalid address, or missing
    dask.distributed.
    """


class ClusterWorkers(Workers):
    """Pool of the workers of a dask cluster, which compute the cases of a study.

    The workers must have the same sources of slipstick; they need no common disk. Certificates for
    tls are those of dask's configuration (`distributed.comm.tls`). If a worker dies, dask gives its
    case to another worker, a limited number of times. After all workers have died, new ones are
    awaited for 300 s. Raises ClusterUnavailable.

    address  address of the dask scheduler, tcp://host:port or tls://host:port
    """

    elsewhere = True

    def __init__(self, address: str) -> None:
        if not address.startswith(SCHEMES):
            raise ClusterUnavailable(
                f"got {address!r}; the address of a dask scheduler is tcp://host:port or "
                "tls://host:port"
            )
        try:
            distributed: Any = importlib.import_module("distributed")
        except ImportError as error:
            raise ClusterUnavailable(
                f"a cluster needs dask.distributed: pip install 'slipstick[cluster]' ({error})"
            ) from error
        try:
            self._client = distributed.Client(
                address, timeout=SECONDS_TO_CONNECT, set_as_default=False
            )
        except (OSError, ValueError, TypeError) as error:  # TypeError: tls without certificates
            raise ClusterUnavailable(f"no dask scheduler answers at {address}: {error}") from error
        self._executor = self._client.get_executor(pure=False, retries=0)
        self._known = set(self._client.nthreads())
        self._last_dead: list[str] = []
        self._last_seen = time.monotonic()  # a worker, or none was ever there

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        future: Future[Answer] = self._executor.submit(compute, case)
        return future

    def lost(self) -> list[str]:
        try:
            now = set(self._client.nthreads())
        except OSError:  # the scheduler has gone: every case that is left tells so
            return []
        gone, self._known = sorted(self._known - now), now
        self._last_dead = gone or self._last_dead
        if now or not self._last_dead:
            self._last_seen = time.monotonic()
        return gone

    def deserted(self) -> str:
        """Return a reason that names the last workers, if all have died and none has come since."""
        if not self._last_dead or time.monotonic() - self._last_seen < SECONDS_WITHOUT_WORKER:
            return ""
        return (
            f"no worker is left: {', '.join(self._last_dead)} died, and none came within "
            f"{SECONDS_WITHOUT_WORKER} s"
        )

    def close(self) -> None:
        self._executor.shutdown(wait=False)
        self._client.close()
