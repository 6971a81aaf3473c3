"""Cache of the arrays that a function returns, limited in bytes.

The arrays hold transforms at all wavenumbers. Their size is proportional to the number of
wavenumbers, about 1e5 for a thin film.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")

MAX_CACHED = 24 << 20  # limit of the cached results of a function [byte]


def cache_within_bytes(most: int) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Return a decorator that caches the results of a function, up to a limit in bytes.

    The decorated function has hashable arguments and returns an array or a tuple of arrays. Above
    the limit, the least recently used results are removed before a new result is computed.

    most  limit of the cached results of one function [byte]
    """

    def decorate(compute: Callable[P, R]) -> Callable[P, R]:
        """Return a function that computes as the given function does and caches the results.

        The cache is limited in bytes.

        compute  function with hashable arguments that returns an array or a tuple of arrays
        """
        found: OrderedDict[Hashable, Any] = OrderedDict()

        @wraps(compute)
        def cached_call(*given: P.args, **named: P.kwargs) -> R:
            """Return the cached result of a function, computed at the first call.

            given, named  positional and keyword arguments of the function, all hashable
            """
            key = (given, *named.items())
            value = found.pop(key, None)
            if value is None:
                while found and sum(map(_array_bytes, found.values())) > most:
                    found.popitem(last=False)
                value = compute(*given, **named)
            found[key] = value
            return value

        cached_call.cache_clear = found.clear  # type: ignore[attr-defined]  # as functools has it
        return cached_call

    return decorate


def _array_bytes(value: Any) -> int:
    return sum(map(_array_bytes, value)) if isinstance(value, tuple) else int(value.nbytes)
