"""Linear algebra with one thread, independent of the environment."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache

from threadpoolctl import ThreadpoolController


@contextmanager
def one_thread() -> Iterator[None]:
    """Limit BLAS to one thread in the block.

    Several threads sum in another order, which changes bits, and are slower for small systems.
    """
    with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _libraries(imported: int) -> ThreadpoolController:
    """Find the loaded libraries. The search is slow, and only an import can load another."""
    return ThreadpoolController()
