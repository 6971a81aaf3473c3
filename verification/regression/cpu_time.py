"""CPU time of commands over that of a calibrated loop, compared with stored ratios.

Each command is a new process with one thread and an empty disk cache, between two runs of the loop.
Other programs on the machine slow both, so that the ratio changes less than the times. A command is
repeated until one ratio is small enough: noise makes single ratios large, a slower program makes
all of them large.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from contact_results.blas_threads import ONE, VARIABLES
from contact_results.directory.atomic_file import Refused
from contact_results.directory.json_record import read_record, write_record
from contact_scene.reading.description import Description
from verification.judging.outcome import ChangeKind
from verification.regression.baseline import RecordedBy, recorded_by
from verification.regression.change_row import ChangeRow, rows_that_matter
from verification.running.provenance import Provenance

CPU_TIMES = Path(__file__).with_name("cpu_times.json")
Commands = Mapping[str, Sequence[str | Path]]
Measure = Callable[[Sequence[str | Path]], float]

# Imports, interpreted Python, Fourier transforms and a factorisation, as in a small solve.
LOOP = """
import numpy as np
from scipy.linalg import lu_factor

field, matrix = np.random.default_rng(0).random((128, 128)), np.eye(400) + 1 / 400
for _ in range(12):
    for _ in range(6):
        np.fft.irfft2(np.fft.rfft2(field), s=field.shape)
    lu_factor(matrix)
    sum(k * k % 7 for k in range(100_000))
"""
WARNING = 1.3  # largest ratio over the stored one without a warning
RED = 1.6  # largest ratio over the stored one that passes
REPEATS = 5
REMEDY = "store the times by slipstick maintain cpu --accept"


class CpuTimes(Description):
    """Accepted CPU times of commands, relative to the calibrated loop, with their origin."""

    by: RecordedBy
    processor: str
    loop_seconds: float
    """CPU time of the loop on this machine [s]: the calibration."""

    ratios: dict[str, float]
    """Smallest CPU time over that of the loop in 5 repeats, by name of the command."""


def cpu_seconds(words: Sequence[str | Path]) -> float:
    """Measure the CPU time of a Python process with one thread in an empty directory [s].

    Raises Refused if the process fails.

    words  arguments of the Python interpreter
    """
    with TemporaryDirectory() as folder:
        cache = {"SLIPSTICK_CACHE_DIR": str(Path(folder) / "cache")}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = subprocess.run(
            [sys.executable, *words],
            cwd=folder,
            env={**os.environ, **dict.fromkeys(VARIABLES, ONE), **cache},
            capture_output=True,
            text=True,
            check=False,
        )
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        command = " ".join(map(str, words))
        raise Refused(f"{command} ends with exit code {done.returncode}: {done.stderr[-300:]}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def ratio_to_loop(words: Sequence[str | Path]) -> float:
    """Measure the CPU time of a command over the mean of the loop before and after it [1].

    words  arguments of `slipstick`
    """
    before = cpu_seconds(["-c", LOOP])
    found = cpu_seconds(["-m", "slipstick", *words])
    return 2 * found / (before + cpu_seconds(["-c", LOOP]))


def smallest_ratio(
    words: Sequence[str | Path], enough: float = 0.0, measure: Measure = ratio_to_loop
) -> float:
    """Measure a command up to 5 times and return its smallest CPU time over that of the loop [1].

    words    arguments of `slipstick`
    enough   ratio at which no further repeat is made
    measure  function that measures a command once
    """
    smallest = measure(words)
    for _ in range(REPEATS - 1):
        if smallest <= enough:
            break
        smallest = min(smallest, measure(words))
    return smallest


def accept_cpu_times(commands: Commands, made: Provenance, because: str) -> None:
    """Store the CPU times of commands on this machine. Raises Refused without a reason.

    commands  arguments of `slipstick` by name
    made      version, machine and commit
    because   reason why the times are right
    """
    if not because.strip():
        raise Refused("CPU times need a reason: --because 'why these times are right'")
    loop = min(cpu_seconds(["-c", LOOP]) for _ in range(REPEATS))
    ratios = {name: round(smallest_ratio(words), 3) for name, words in commands.items()}
    found = CpuTimes(
        by=recorded_by(made, because),
        processor=str(made.machine["processor"]),
        loop_seconds=round(loop, 3),
        ratios=ratios,
    )
    write_record(CPU_TIMES, found)


def cpu_time_changes(
    commands: Commands, made: Provenance, known: CpuTimes, measure: Measure = ratio_to_loop
) -> list[ChangeRow]:
    """Measure commands, and return those whose CPU time over that of the loop has grown.

    Above 1.3 times the stored ratio the change is a drift. Above 1.6 times it is dearer, if the
    processor is that of the stored times. Raises Refused for commands without a stored time.

    made     version and machine
    known    stored times
    measure  function that measures a command once
    """
    if commands.keys() != known.ratios.keys():
        raise Refused(f"other commands have stored CPU times; {REMEDY}")
    elsewhere = made.machine["processor"] != known.processor
    rows = []
    for name, was in known.ratios.items():
        now = smallest_ratio(commands[name], WARNING * was, measure)
        if now <= WARNING * was:
            continue
        kind = ChangeKind.DRIFT if elsewhere or now <= RED * was else ChangeKind.DEARER
        remark = f"stored on {known.processor}" if elsewhere else ""
        texts = (f"{was:.3g} loops", f"{now:.3g} loops", f"{now / was:.2f} times")
        rows.append(ChangeRow("cpu", name, "", kind, *texts, known.by.date[:10], remark, now / was))
    return rows_that_matter(rows)


def read_cpu_times() -> CpuTimes:
    """Read the stored CPU times. Raises Refused for a missing or damaged file."""
    return read_record(CPU_TIMES, CpuTimes, "file of CPU times", f"restore it, or {REMEDY}")
