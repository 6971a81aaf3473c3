"""Properties of the machine: available memory, threads of BLAS, and files of trusted owners."""

import os
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from io import BufferedReader
from pathlib import Path

from threadpoolctl import ThreadpoolController

from contact_scene.solver_errors import ResourceRefused

MEMORY = Path("/proc/meminfo")
# Flags of some systems: do not wait for a named pipe, and read bytes instead of text.
NEITHER_WAITING_NOR_TEXT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def available_bytes() -> int:
    """Determine the memory of this machine that is available without swapping [byte]."""
    try:
        with MEMORY.open("rb") as lines:
            for line in lines:
                if line.startswith(b"MemAvailable:"):
                    return int(line.split()[1]) << 10
    except OSError:
        pass
    if not hasattr(os, "sysconf"):  # unknown on Windows
        return sys.maxsize
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")


def require_memory(needed: float, what: str, remedy: str) -> None:
    """Raise ResourceRefused if a solve needs more memory than is available on this machine.

    needed  memory that the solve needs [byte]
    what    subject of the error message, in the plural
    remedy  sentence that states a way to use less memory
    """
    available = available_bytes()
    if needed > available:
        raise ResourceRefused(
            f"{what} need about {needed / 2**30:.1f} GiB, {available / 2**30:.1f} GiB are "
            f"available. {remedy}"
        )


@contextmanager
def one_thread() -> Iterator[None]:
    """Limit the linear algebra of BLAS to one thread within a `with` block.

    Several threads sum in another order, which changes bits, and are slower for small systems.
    """
    with _threaded_libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _threaded_libraries(_imported: int) -> ThreadpoolController:
    """Find the loaded libraries with threads (BLAS, OpenMP). The number of imported
    modules is the key of the cache, because only an import loads libraries."""
    return ThreadpoolController()


def open_own(path: Path) -> BufferedReader:
    """Open a file for reading if its owner is this user or the administrator.

    Used for files of the cache and for checkpoints, which another user could have written. Raises
    OSError for files of other users, and for pipes and devices, which may not end.

    path  path of the file
    """
    descriptor = os.open(path, os.O_RDONLY | NEITHER_WAITING_NOR_TEXT)
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise OSError(0, "it is no plain file", str(path))
        if hasattr(os, "geteuid") and status.st_uid not in (os.geteuid(), 0):
            raise OSError(0, "it belongs to another user", str(path))
        return os.fdopen(descriptor, "rb")
    except BaseException:
        os.close(descriptor)
        raise
