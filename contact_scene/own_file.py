"""Files that this program has kept for itself, in places where others may write as well."""

import os
import stat
from pathlib import Path
from typing import BinaryIO


def open_own(path: Path) -> BinaryIO:
    """Open for reading what this user, or the system's administrator, has put there.

    Raises OSError, also for what is no plain file, which might never end, and for a file of
    another user, whose checksum says only that it is whole.
    """
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise OSError(0, "it is no plain file", str(path))
        if status.st_uid not in (os.geteuid(), 0):
            raise OSError(0, "it belongs to another user", str(path))
        return os.fdopen(descriptor, "rb")
    except BaseException:
        os.close(descriptor)
        raise
