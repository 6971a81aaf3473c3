"""Available memory of the machine."""

import os
import sys
from pathlib import Path

MEMORY = Path("/proc/meminfo")


def available_bytes() -> int:
    """Determine the memory that is available without swapping [byte]."""
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
