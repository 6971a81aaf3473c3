"""One process at a time makes the results of a directory; another one is told which it is.

A hidden file is locked and names the process. The system drops the lock when the process ends,
however it ends: the file that a killed one leaves is taken over by the next.
"""

import os
import socket
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from contact_results.directory.refusal import OutputRefused
from contact_results.directory.stop_signals import cleaned_up_when_stopped

# Where a system has none of these, as Windows, it has no locks either.
DIRECTORY, NO_LINK, NO_WAITING = (
    getattr(os, flag, 0) for flag in ("O_DIRECTORY", "O_NOFOLLOW", "O_NONBLOCK")
)


def lock(descriptor: int, *, wait: bool) -> None:
    """Lock an open file; raises BlockingIOError if it shall not wait for another holder, and
    OSError where the system or the file system knows no locks."""
    try:
        from fcntl import LOCK_EX, LOCK_NB, flock
    except ImportError as error:
        raise OSError("this system has no locks") from error
    flock(descriptor, LOCK_EX | (0 if wait else LOCK_NB))


def acquire(directory: Path, *, wait: bool) -> int | None:
    """Lock the directory and return the descriptor that holds the lock.

    wait     wait for another holder; otherwise give up at once
    returns  None if somebody else holds it, where there are no locks, or for a link: whoever may
             write beside it could have put it there
    """
    try:
        descriptor = os.open(directory, os.O_RDONLY | DIRECTORY | NO_LINK)
    except OSError:
        return None
    try:
        lock(descriptor, wait=wait)
    except OSError:
        os.close(descriptor)
        return None
    return descriptor


def release(descriptor: int | None) -> None:
    """Drop the lock; None is no lock."""
    if descriptor is not None:
        os.close(descriptor)


LONGEST_NAME = 300


@contextmanager
def in_sole_use(target: Path) -> Iterator[None]:
    """Keep others out of a directory of results.

    target  may not be there yet; its parent is

    The lock is in `target`, which may be a mount point of its own or the only place that may be
    written, or beside it while it is not there. Raises OutputRefused if another process holds it.
    Where nothing can be locked, nobody is kept out.
    """
    target = Path(os.path.realpath(target))
    places = [target.parent, target]
    home, other = reversed(places) if target.is_dir() else places
    name = f".{target.name}.in-use"
    with ExitStack() as held:
        held.enter_context(_locked(home / name, target))
        # Only now: of two that begin at once, each at its own place, one at least sees the other.
        if os.path.lexists(other / name):
            held.enter_context(_locked(other / name, target))
        yield


@contextmanager
def _locked(path: Path, target: Path) -> Iterator[None]:
    descriptor = _lock(path, target)

    def remove() -> None:
        if descriptor is not None:  # before it is unlocked: later it may be somebody else's
            with suppress(OSError):  # without a lock the file keeps nobody out
                path.unlink()

    try:
        with cleaned_up_when_stopped(remove):
            yield
    finally:
        remove()
        if descriptor is not None:
            os.close(descriptor)


def _lock(path: Path, target: Path) -> int | None:
    """The descriptor that holds the lock; None where there can be none."""
    while True:
        descriptor = _opened(path)
        if descriptor is None:
            return None
        try:
            lock(descriptor, wait=False)
        except BlockingIOError:
            holder = os.pread(descriptor, LONGEST_NAME, 0).decode(errors="replace").strip()
            os.close(descriptor)
            raise OutputRefused(
                f"{target} is in use by {holder or 'another process'}; wait for its end, or choose "
                "another directory with --output"
            ) from None
        except OSError:  # there are no locks
            os.close(descriptor)
            with suppress(OSError):
                path.unlink()
            return None
        if _is_at(descriptor, path):
            with suppress(OSError):
                os.ftruncate(descriptor, 0)
                os.pwrite(descriptor, _this_process().encode(), 0)
            return descriptor
        os.close(descriptor)  # its holder has just removed it


def _opened(path: Path) -> int | None:
    """The file, made if need be; for reading alone where it is another user's. None without one:
    of a directory that cannot be written others speak."""
    for access in (os.O_RDWR | os.O_CREAT, os.O_RDONLY | NO_WAITING):
        with suppress(OSError):
            return os.open(path, access | NO_LINK, 0o666)
    return None


def _this_process() -> str:
    return f"process {os.getpid()} on {socket.gethostname()}"


def _is_at(descriptor: int, path: Path) -> bool:
    """Whether the file is still the one of that name."""
    try:
        there = os.stat(path)
    except FileNotFoundError:
        return False
    return os.path.samestat(os.fstat(descriptor), there)
