"""Worker processes of this machine.

Each of the pool's threads has one worker process of its own. A worker that dies therefore takes
exactly one case with it, which is known by name; the thread gets a new worker and goes on.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from multiprocessing import resource_tracker
from typing import TypeVar

from contact_results.blas_threads import one_thread

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
