"""Files that this program has kept for itself, in places where others may write as well."""

import os
import stat
from io import BufferedReader
from pathlib import Path

# Of systems that have either: a queue is not waited for, and bytes are not taken for text.
NEITHER_WAITING_NOR_TEXT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def open_own(path: Path) -> BufferedReader:
    """Open for reading what this user, or the system's administrator, has put there.

    Raises OSError, also for what is no plain file, which might never end, and for a file of
    another user, whose checksum says only that it is whole.
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
