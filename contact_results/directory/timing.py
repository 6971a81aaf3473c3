"""`timing.json`: seconds, counters of the solver, machine and versions."""

import json
import sys
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path

from contact_results.directory.file_names import TIMING
from contact_results.directory.machine import library_versions, machine, program_version
from contact_scene.quantities.increment import (
    COUNTERS,
    ReportedIncrement,
)


@dataclass
class Stopwatch:
    """Wall and CPU seconds of the phases of a run."""

    wall_seconds: dict[str, float] = field(default_factory=dict)
    cpu_seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def phase(self, name: str) -> Iterator[None]:
        """Measure the block under this name."""
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            yield
        finally:
            self.wall_seconds[name] = time.perf_counter() - wall
            self.cpu_seconds[name] = time.process_time() - cpu


def write_timing(
    stopwatch: Stopwatch, directory: Path, increments: Iterable[ReportedIncrement]
) -> None:
    """Write times, machine, versions, and the counters of the solver by load step."""
    record = {
        "program": "slipstick",
        "version": program_version(),
        "wall_seconds": stopwatch.wall_seconds,
        "cpu_seconds": stopwatch.cpu_seconds,
        "peak_memory_bytes": _peak_memory(),
        "counters": _counters(increments),
        "machine": machine(),
        "libraries": library_versions(),
    }
    (directory / TIMING).write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


def _counters(increments: Iterable[ReportedIncrement]) -> list[dict[str, int | None]]:
    """Sum the counters over the increments of each load step; None if the solver has none."""
    steps = []
    for number, of_step in groupby(increments, lambda increment: increment.step):
        within = list(of_step)
        sums = {
            name: None if None in (found := [getattr(i, name) for i in within]) else sum(found)
            for name in COUNTERS
        }
        steps.append({"step": number, "increments": len(within), **sums})
    return steps


def _peak_memory() -> int | None:
    try:
        import resource
    except ImportError:  # on Windows
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak if sys.platform == "darwin" else 1024 * peak  # macOS counts bytes, Linux kibibytes
