"""Common functions of the drivers of other codes: gap, approach, CPU time and exchange of data."""

from __future__ import annotations

import json
import os
import statistics
import sys
import time
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray

Request = Mapping[str, Any]
Answer = dict[str, Any]
Array = NDArray[np.float64]

ENOUGH_SECONDS = 1.0
MAX_REPEATS = 5
ABOVE = 1.0  # the gap beside a punch: far above any approach of small strains


class CannotDo(Exception):
    """The contact code cannot solve a problem of this kind, with the reason."""


def gap_of(request: Request) -> Array:
    """Compute the gap below the indenter at the cell centres (n, n) before loading [length].

    The indenter is a paraboloid, a cone if the request has a slope, or a flat punch if the request
    has a rim. A tilt of the indenter (slopes along y and x) is subtracted.
    """
    n, side = request["cells"], request["window"]
    x = (np.arange(n) + 0.5) * side / n - side / 2
    x, y = x[:, None], x[None, :]
    r = np.hypot(x, y)
    along_y, along_x = request.get("tilt", (0.0, 0.0))
    return _level_gap(request, x, y, r) - along_y * y - along_x * x


def _level_gap(request: Request, x: Array, y: Array, r: Array) -> Array:
    if request.get("rim"):
        return np.where(r <= request["rim"], 0.0, ABOVE)
    if request.get("slope"):
        return np.asarray(request["slope"] * r)
    radius = request["radius"]
    along, across = radius if isinstance(radius, list) else (radius, radius)
    return np.asarray(x**2 / (2 * along) + y**2 / (2 * across))


def approach_of(gap: Array, displacement: Array, pressure: Array) -> float:
    """Compute the rigid approach: mean of gap plus displacement, weighted by the pressure [length].

    gap           gap of the undeformed surfaces at the cells [length]
    displacement  normal surface displacement at the cells [length]
    """
    return float(np.sum(pressure * (displacement + gap)) / np.sum(pressure))


def answer(solve: Callable[[Request], Answer], *modules: str) -> None:
    """Read a JSON request, solve it repeatedly, and write the answer with the median CPU seconds.

    modules  modules that are imported before the time is measured
    """
    request = json.load(sys.stdin)
    with os.fdopen(os.dup(sys.stdout.fileno()), "w") as out:
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # prints of a code go to stderr
        for module in modules:
            import_module(module)
        json.dump(_answered(solve, request), out)


def _answered(solve: Callable[[Request], Answer], request: Request) -> Answer:
    seconds: list[float] = []
    try:
        while len(seconds) < MAX_REPEATS and sum(seconds) < ENOUGH_SECONDS:
            started = time.process_time()
            found = solve(request)
            seconds.append(time.process_time() - started)
    except CannotDo as error:
        return {"cannot": str(error)}
    tractions = {
        name: np.asarray(found[name], dtype=float).tolist()
        for name in ("pressure", "shear")
        if found[name] is not None
    }
    return {**found, **tractions, "seconds": statistics.median(seconds)}
