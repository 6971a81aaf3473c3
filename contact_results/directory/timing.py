"""`timing.json`: seconds of a run, counters of the solver, machine and versions."""

import json
import resource
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
    columns,
)


@dataclass
class Stopwatch:
    """Wall-clock and CPU seconds of the phases of a run, by the name of the phase."""

    wall_seconds: dict[str, float] = field(default_factory=dict)
    cpu_seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def phase(self, name: str) -> Iterator[None]:
        """Measure wall-clock and CPU time of the `with` block, added to the phase of this name."""
        wall, cpu = time.perf_counter(), time.process_time()
        try:
            yield
        finally:
            for seconds, spent in (
                (self.wall_seconds, time.perf_counter() - wall),
                (self.cpu_seconds, time.process_time() - cpu),
            ):
                seconds[name] = seconds.get(name, 0.0) + spent


def write_timing(
    stopwatch: Stopwatch, directory: Path, increments: Iterable[ReportedIncrement]
) -> None:
    """Write `timing.json`: times, peak memory, counters of the solver, machine, versions.

    stopwatch   measured times of the phases of the run
    increments  increments of the result, with the counters of the solver
    """
    record = {
        "program": "slipstick",
        "version": program_version(),
        "wall_seconds": stopwatch.wall_seconds,
        "cpu_seconds": stopwatch.cpu_seconds,
        "peak_memory_bytes": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
        "counters": _counters_by_step(increments),
        "machine": machine(),
        "libraries": library_versions(),
    }
    (directory / TIMING).write_text(json.dumps(record, indent=2) + "\n", encoding="utf-8")


def _counters_by_step(increments: Iterable[ReportedIncrement]) -> list[dict[str, int | None]]:
    """Sum the counters of the solver, such as iterations, over the increments of each load step.

    Returns one record per load step. A counter is None if the solver does not have it.
    """
    steps = []
    for number, of_step in groupby(increments, lambda increment: increment.step):
        within = list(of_step)
        sums = {
            name: None if None in counts else sum(counts)
            for name, counts in columns(within, COUNTERS).items()
        }
        steps.append({"step": number, "increments": len(within), **sums})
    return steps
