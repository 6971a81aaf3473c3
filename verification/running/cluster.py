"""Workers of a dask.distributed cluster that is there already."""

from __future__ import annotations

import importlib
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from verification.running.case_pool import Answer
    from verification.running.study import StudyCase

SCHEMES = ("tcp://", "tls://")
SECONDS_TO_CONNECT = 10


class ClusterUnavailable(Exception):
    """There is no cluster at the address, or nothing installed that could speak to one."""


class ClusterWorkers:
    """The workers of the scheduler at an address, tcp://host:port or tls://host:port.

    They need slipstick of the same sources, and no common disk. Certificates for tls are those of
    dask's own configuration (`distributed.comm.tls`). Where a worker dies, dask gives its case to
    others, a few times. Raises ClusterUnavailable.
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

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        """Call the function in a worker."""
        future: Future[Answer] = self._executor.submit(compute, case)
        return future

    def lost(self) -> list[str]:
        """Return the addresses of workers that have left the cluster since the last call."""
        try:
            now = set(self._client.nthreads())
        except OSError:  # the scheduler has gone: every case that is left tells so
            return []
        gone, self._known = self._known - now, now
        return sorted(gone)

    def close(self) -> None:
        """Give up what has not ended, and leave the cluster as it is."""
        self._executor.shutdown(wait=False)
        self._client.close()
