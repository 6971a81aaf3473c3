"""Memory that can still be had on this machine."""

import os
import sys
from pathlib import Path

MEMORY = Path("/proc/meminfo")


def available_bytes() -> int:
    """Memory that can be had without swapping, as far as the system tells [byte]."""
    try:
        with MEMORY.open("rb") as lines:  # of which it is one of the first
            for line in lines:
                if line.startswith(b"MemAvailable:"):
                    return int(line.split()[1]) << 10
    except OSError:
        pass
    if not hasattr(os, "sysconf"):  # Windows does not tell
        return sys.maxsize
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
