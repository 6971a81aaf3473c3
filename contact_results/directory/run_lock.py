"""Lock of a directory of results for one process.

A hidden file is locked and contains the name of the process. The system releases the lock at the
end of the process. The next process reuses the file of a killed process.
"""

import fcntl
import os
import socket
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from contact_results.directory.atomic_file import OutputRefused
from contact_results.directory.stop_signals import cleaned_up_when_stopped

LONGEST_NAME = 300


@contextmanager
def in_sole_use(target: Path) -> Iterator[None]:
    """Lock a directory of results for the duration of the `with` block.

    The lock file is in `target`, or next to `target` while `target` does not exist. Without locks
    in the file system, other processes are not excluded.

    target  directory of the results; its parent exists

    Raises OutputRefused if another process has the lock.
    """
    target = Path(os.path.realpath(target))
    places = [target.parent, target]
    home, other = reversed(places) if target.is_dir() else places
    name = f".{target.name}.in-use"
    with ExitStack() as locks:
        locks.enter_context(_hold_lock_file(home / name, target))
        # The order matters: of two processes that start at once, at least one finds the other.
        if os.path.lexists(other / name):
            locks.enter_context(_hold_lock_file(other / name, target))
        yield


@contextmanager
def _hold_lock_file(path: Path, target: Path) -> Iterator[None]:
    """Lock a lock file for the duration of the `with` block, and remove it at the end.

    path    path of the lock file
    target  directory of the results, for messages
    """
    descriptor = _create_lock_file(path, target)

    def remove() -> None:
        if descriptor is not None:  # before the release: afterwards another process may own it
            with suppress(OSError):  # an unlocked file excludes no process
                path.unlink()

    try:
        with cleaned_up_when_stopped(remove):
            yield
    finally:
        remove()
        if descriptor is not None:
            os.close(descriptor)


def _create_lock_file(path: Path, target: Path) -> int | None:
    """Create and lock a lock file, and return its descriptor; None if the file system has no locks.

    path    path of the lock file
    target  directory of the results, for messages

    Raises OutputRefused if another process has the lock.
    """
    while True:
        descriptor = _open_lock_file(path)
        if descriptor is None:
            return None
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = os.pread(descriptor, LONGEST_NAME, 0).decode(errors="replace").strip()
            os.close(descriptor)
            raise OutputRefused(
                f"{target} is in use by {holder or 'another process'}; wait for its end, or choose "
                "another directory with --output"
            ) from None
        except OSError:  # the file system has no locks
            os.close(descriptor)
            with suppress(OSError):
                path.unlink()
            return None
        if _is_same_file(descriptor, path):
            with suppress(OSError):
                os.ftruncate(descriptor, 0)
                os.pwrite(descriptor, _this_process().encode(), 0)
            return descriptor
        os.close(descriptor)  # another process has just removed the file


def _open_lock_file(path: Path) -> int | None:
    """Open or create a lock file; None if that fails. A file of another user is only read."""
    for access in (os.O_RDWR | os.O_CREAT, os.O_RDONLY | os.O_NONBLOCK):
        with suppress(OSError):
            return os.open(path, access | os.O_NOFOLLOW, 0o666)
    return None


def _this_process() -> str:
    return f"process {os.getpid()} on {socket.gethostname()}"


def _is_same_file(descriptor: int, path: Path) -> bool:
    """Return True unless another process has removed or replaced the open file."""
    try:
        there = os.stat(path)
    except FileNotFoundError:
        return False
    return os.path.samestat(os.fstat(descriptor), there)
