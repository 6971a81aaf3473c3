"""CPU time of solvers with empty caches, so that no result of an earlier run shortens the time."""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypeVar

from contact_scene.disk_cache import without_cache

SOLVERS = ("contact_solver", "semi_analytical", "fem_reference", "radial")
ENOUGH_SECONDS = 1.0  # CPU time after which repetitions add no accuracy
MAX_REPEATS = 5

T = TypeVar("T")


@contextmanager
def cold_cache() -> Iterator[None]:
    """Run a block of code with empty caches of all solvers in memory, and without that on disk."""
    clear_caches(*SOLVERS)
    with without_cache():
        yield


def clear_caches(*packages: str) -> None:
    """Clear the caches of functions and methods in all loaded modules of the given packages.

    packages  beginnings of the module names
    """
    for name, module in list(sys.modules.items()):
        for value in list(vars(module).values()) if name.startswith(packages) else ():
            members = vars(value).items() if isinstance(value, type) else ()
            methods = [held for member, held in members if not member.startswith("__")]
            for held in (value, *methods):
                if hasattr(held, "cache_clear"):
                    held.cache_clear()


def timed(compute: Callable[[], T]) -> tuple[T, float, int]:
    """Measure the CPU time of a function with empty solver caches.

    The function is called repeatedly, until 5 calls or 1 s of CPU time in total. Returns the last
    result, the median CPU time [s] and the number of calls.
    """
    seconds: list[float] = []
    while True:
        with cold_cache():
            started = time.process_time()
            result = compute()
            seconds.append(time.process_time() - started)
        if len(seconds) == MAX_REPEATS or sum(seconds) >= ENOUGH_SECONDS:
            return result, statistics.median(seconds), len(seconds)
