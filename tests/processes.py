"""Helpers of tests that run the command line in a new process and measure its time and memory."""

import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

# Told by the process itself: what the system says of a child begins with the memory of its parent.
# A worker ignores SIGINT and so would its children.
MAIN = """
import atexit, re, signal, sys, time
signal.signal(signal.SIGINT, signal.SIG_DFL)
def tell():
    peak = re.search(r"VmHWM:\\s*([0-9]+) kB", open("/proc/self/status").read())[1]
    print("took", time.process_time(), peak, file=sys.stderr)
atexit.register(tell)
from slipstick.cli import main
main()
"""
ENOUGH = 600.0  # seconds for any command
MIB = 1024.0  # kB


@dataclass(frozen=True)
class Ended:
    """How a command ended; CPU seconds and the largest memory [MiB], NaN if it was killed."""

    code: int
    out: str
    said: str
    seconds: float
    memory: float


def begun(
    directory: Path, *words: str, program: str = MAIN, threads: int = 1
) -> subprocess.Popen[str]:
    """A command in a directory, with no cache but what is in it."""
    own = {"SLIPSTICK_CACHE_DIR": str(directory / "cache"), "COLUMNS": "200"}
    own |= {name: str(threads) for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}
    path = os.pathsep.join(part for part in sys.path if part)
    return subprocess.Popen(
        [sys.executable, "-c", program, *words],
        cwd=directory,
        text=True,
        env=os.environ | own | {"PYTHONPATH": path},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )


def ended(process: subprocess.Popen[str]) -> Ended:
    """Its end, waited for."""
    out, err = process.communicate(timeout=ENOUGH)
    said, mark, took = err.rpartition("took ")
    seconds, memory = map(float, took.split()) if mark else (float("nan"), float("nan"))
    return Ended(process.returncode, out, said if mark else err, seconds, memory / MIB)


def run(directory: Path, *words: str, program: str = MAIN, threads: int = 1) -> Ended:
    """A command from its begin to its end."""
    return ended(begun(directory, *words, program=program, threads=threads))


def imported_after(script, *words, cwd):
    """Modules that a fresh process has imported after a script, with the words as its arguments."""
    program = script + "\nimport sys\nprint('\\nimported', *sys.modules)"
    ran = subprocess.run(
        [sys.executable, "-c", program, *map(str, words)],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=True,
    )
    return set(ran.stdout.rpartition("\nimported ")[2].split())


def has_ended(process: int) -> bool:
    """True if a process ends within ten seconds; one that nobody waits for has ended, too."""
    until = time.monotonic() + 10
    while time.monotonic() < until:
        try:
            state = Path(f"/proc/{process}/stat").read_text(encoding="ascii").rpartition(")")[2]
        except (FileNotFoundError, ProcessLookupError):
            return True
        if state.split()[0] == "Z":
            return True
        time.sleep(0.05)
    return False


def results(directory: Path) -> dict[str, bytes]:
    """All files of a run but the one that says how long it took, and what hides while it lasts."""
    paths = directory.iterdir() if directory.is_dir() else ()
    shown = (path for path in paths if not path.name.startswith("."))
    return {path.name: path.read_bytes() for path in shown if path.name != "timing.json"}
