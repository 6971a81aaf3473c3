"""An advisory lock on a directory; the system drops it when its process ends, however it ends."""

import os
from pathlib import Path

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
