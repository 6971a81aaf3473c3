"""Measuring what a method costs: nothing may come from what an earlier run has left on disk."""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from tempfile import TemporaryDirectory
from typing import TypeVar

CACHE = "SLIPSTICK_CACHE_DIR"
ENOUGH_SECONDS = 1.0  # of CPU, from where one repetition more would say nothing
MOST_REPEATS = 5

T = TypeVar("T")


@contextmanager
def cold_cache() -> Iterator[None]:
    """Both solvers find an empty cache, which goes afterwards."""
    before = os.environ.get(CACHE)
    with TemporaryDirectory() as empty:
        os.environ[CACHE] = empty
        try:
            yield
        finally:
            if before is None:
                del os.environ[CACHE]
            else:
                os.environ[CACHE] = before


def timed(compute: Callable[[], T]) -> tuple[T, float, int]:
    """What a function returns, the median of its CPU seconds in this process, and how often it was
    called: each time with an empty cache, until the sum says enough."""
    seconds: list[float] = []
    while True:
        with cold_cache():
            started = time.process_time()
            result = compute()
            seconds.append(time.process_time() - started)
        if len(seconds) == MOST_REPEATS or sum(seconds) >= ENOUGH_SECONDS:
            return result, statistics.median(seconds), len(seconds)
