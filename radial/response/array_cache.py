"""Cache of arrays, limited in bytes.

The size of these arrays is proportional to the number of wavenumbers, about 1e5 for a thin film.
"""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")

MAX_CACHED = 24 << 20  # bytes of the results of one function


def cached_within(most: int) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Store the results of a function of hashable arguments: an array or a tuple of arrays.

    most  bytes; above it the least recently used results are removed before a new one is computed
    """

    def of(compute: Callable[P, R]) -> Callable[P, R]:
        found: OrderedDict[Hashable, Any] = OrderedDict()

        @wraps(compute)
        def remembered(*given: P.args, **named: P.kwargs) -> R:
            key = (given, *named.items())
            value = found.pop(key, None)
            if value is None:
                while found and sum(map(_size, found.values())) > most:
                    found.popitem(last=False)
                value = compute(*given, **named)
            found[key] = value
            return value

        remembered.cache_clear = found.clear  # type: ignore[attr-defined]  # as functools has it
        return remembered

    return of


def _size(value: Any) -> int:
    return sum(map(_size, value)) if isinstance(value, tuple) else int(value.nbytes)
