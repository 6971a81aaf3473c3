"""One thread of linear algebra, whatever the environment says."""

from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits


@contextmanager
def one_thread() -> Iterator[None]:
    """While a solver works: two threads add in another order, so that the bits would differ, and
    wait for one another over systems as small as those of a contact."""
    with threadpool_limits(1, "blas"):
        yield
