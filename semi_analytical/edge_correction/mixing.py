"""A fixed-point iteration by what it has learnt: Anderson's method with a short memory."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]

DEPTH = 3
# Of the first change, from which there is nothing to learn yet.
DAMPED = 0.8
# Squared part of a difference below which the others explain it.
DEPENDENT = 1e-13


class Mixing:
    """The next point of x -> x + r, as if r were linear in x (Anderson 1965)."""

    def __init__(self) -> None:
        self._points: list[Field] = []
        self._changes: list[Field] = []

    def next(self, x: Field, r: Field) -> Field:
        """The point after x, at which the answer was x + r; any shape."""
        self._points = [*self._points, x][-DEPTH - 1 :]
        self._changes = [*self._changes, r][-DEPTH - 1 :]
        if len(self._points) == 1:
            return np.asarray(x + DAMPED * r)
        d_x = np.diff(self._points, axis=0).reshape(len(self._points) - 1, -1)
        d_r = np.diff(self._changes, axis=0).reshape(len(self._points) - 1, -1)
        # Not by matrix products, whose rounding depends on the number of threads.
        products = np.einsum("ik,jk->ij", d_r, d_r)
        share = np.linalg.lstsq(products, np.einsum("ik,k->i", d_r, r.ravel()), DEPENDENT)[0]
        return np.asarray(x + r - np.einsum("i,ik->k", share, d_x + d_r).reshape(x.shape))
