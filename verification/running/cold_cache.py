"""Measuring what a method costs: nothing may come from what an earlier run has left on disk or in
memory."""

from __future__ import annotations

import os
import statistics
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from tempfile import TemporaryDirectory
from typing import TypeVar

CACHE = "SLIPSTICK_CACHE_DIR"
SOLVERS = ("semi_analytical", "fem_reference", "radial")
ENOUGH_SECONDS = 1.0  # of CPU, from where one repetition more would say nothing
MAX_REPEATS = 5

T = TypeVar("T")


@contextmanager
def cold_cache() -> Iterator[None]:
    """Every solver finds an empty cache, which goes afterwards, and remembers nothing."""
    before = os.environ.get(CACHE)
    _forget()
    with TemporaryDirectory() as empty:
        os.environ[CACHE] = empty
        try:
            yield
        finally:
            if before is None:
                del os.environ[CACHE]
            else:
                os.environ[CACHE] = before


def _forget() -> None:
    for name, module in list(sys.modules.items()):
        if name.partition(".")[0] in SOLVERS:
            for value in list(vars(module).values()):
                if hasattr(value, "cache_clear"):
                    value.cache_clear()


def timed(compute: Callable[[], T]) -> tuple[T, float, int]:
    """What a function returns, the median of its CPU seconds in this process, and how often it was
    called: each time with an empty cache, until the sum says enough."""
    seconds: list[float] = []
    while True:
        with cold_cache():
            started = time.process_time()
            result = compute()
            seconds.append(time.process_time() - started)
        if len(seconds) == MAX_REPEATS or sum(seconds) >= ENOUGH_SECONDS:
            return result, statistics.median(seconds), len(seconds)
