"""CPU time in units of a loop of the same kind of work, run on the same core in the same minute:
what a machine is slower at, and what its other users take, goes into both."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

import numpy as np

SIDE, UNKNOWNS, STEPS = 256, 300, 20_000
REPEATS = 3

T = TypeVar("T")


def in_loops(compute: Callable[[], T]) -> tuple[T, float]:
    """What a function returns, and its CPU time over that of the loop before and after it."""
    before, started = _loop(), time.process_time()
    found = compute()
    spent = time.process_time() - started
    return found, spent / (0.5 * (before + _loop()))


def _loop() -> float:
    """CPU seconds of transforms, a dense system and plain Python, as solves are made of; the least
    of some repetitions, and not less than the clock resolves."""
    seconds = []
    field, matrix = np.ones((SIDE, SIDE)), np.eye(UNKNOWNS) + 1 / UNKNOWNS
    for _ in range(REPEATS):
        started = time.process_time()
        for _ in range(4):
            np.fft.irfft2(np.fft.rfft2(field))
        np.linalg.solve(matrix, matrix[0])
        sum(k * k for k in range(STEPS))
        seconds.append(time.process_time() - started)
    return max(min(seconds), time.get_clock_info("process_time").resolution)
