"""One thread of linear algebra, whatever the environment says."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache

from threadpoolctl import ThreadpoolController


@contextmanager
def one_thread() -> Iterator[None]:
    """While a solver works: two threads add in another order, so that the bits would differ, and
    wait for one another over systems as small as those of a contact."""
    with _libraries(len(sys.modules)).limit(limits=1, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _libraries(imported: int) -> ThreadpoolController:
    """All that are loaded. To find them takes as long as a contact on few cells, and only an import
    brings in another."""
    return ThreadpoolController()
