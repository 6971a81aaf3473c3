"""Memory that can still be had on this machine."""

import os
import sys
from pathlib import Path


def available_bytes() -> int:
    """Memory that can be had without swapping, as far as the system tells [byte]."""
    try:
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) << 10
    except OSError:
        pass
    if not hasattr(os, "sysconf"):  # Windows does not tell
        return sys.maxsize
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
