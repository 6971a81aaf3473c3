"""An advisory lock on a directory; the system drops it when its process ends, however it ends."""

import fcntl
import os
from pathlib import Path


def acquire(directory: Path, *, wait: bool) -> int | None:
    """Lock the directory and return the descriptor that holds the lock.

    wait     wait for another holder; otherwise give up at once
    returns  None if somebody else holds it, if the file system knows no locks, or for a link:
             whoever may write beside it could have put it there
    """
    try:
        descriptor = os.open(directory, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except OSError:
        os.close(descriptor)
        return None
    return descriptor


def release(descriptor: int | None) -> None:
    """Drop the lock; None is no lock."""
    if descriptor is not None:
        os.close(descriptor)
