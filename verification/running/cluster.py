"""Worker pool of an existing dask.distributed cluster, for the cases of a study."""

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
    """Exception for a dask scheduler that does not answer, an invalid address, or missing
    dask.distributed.
    """


class ClusterWorkers:
    """Pool of the workers of a dask cluster, which compute the cases of a study.

    The workers must have the same sources of slipstick; they need no common disk. Certificates for
    tls are those of dask's configuration (`distributed.comm.tls`). If a worker dies, dask gives its
    case to another worker, a limited number of times. Raises ClusterUnavailable.

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

    def submit(self, compute: Callable[[StudyCase], Answer], case: StudyCase) -> Future[Answer]:
        """Call a function with a case of a study in a worker of the cluster; return the future of
        its reply."""
        future: Future[Answer] = self._executor.submit(compute, case)
        return future

    def lost(self) -> list[str]:
        """Return the network addresses of workers that left the cluster since the last call."""
        try:
            now = set(self._client.nthreads())
        except OSError:  # the scheduler has gone: every case that is left tells so
            return []
        gone, self._known = self._known - now, now
        return sorted(gone)

    def close(self) -> None:
        """Cancel the cases that have not ended, and disconnect from the cluster, which continues to
        run."""
        self._executor.shutdown(wait=False)
        self._client.close()
