"""Files written by this program, in places where other users may write."""

import os
import stat
from io import BufferedReader
from pathlib import Path

# Flags of some systems: do not wait for a named pipe, and read bytes instead of text.
NEITHER_WAITING_NOR_TEXT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def open_own(path: Path) -> BufferedReader:
    """Open a file of this user or of the administrator for reading.

    Raises OSError, also for pipes and devices, which may not end, and for files of other users.
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
