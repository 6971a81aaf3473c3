"""Errors of the largest stresses: the same tractions on cells twice as wide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import sqrt

import numpy as np
from numpy.typing import NDArray

from contact_errors import estimate
from contact_errors.rules import INTERIOR, TENSION
from contact_results.stress.extremes import Extreme, extremes
from contact_results.stress.loaded_bodies import LoadedBodies
from contact_results.stress.on_cells import stress_on_cells
from contact_results.stress.points import StressField
from contact_scene.stated_error import Part, StatedError

Field = NDArray[np.float64]

# Cells from the surface within which a stress feels the edges of the tractions.
NEAR = 4.0


def stress_errors(
    state: LoadedBodies, field: StressField, found: Sequence[Extreme], *, indenter: bool = False
) -> tuple[StatedError, ...]:
    """Errors of the extremes that were found in a field; nothing can be said of those on rings.

    Of the tractions counts what increments leave wrong in them; what cells do is far less than what
    they leave wrong in the stress.
    """
    if state.on_rings:
        return (estimate.UNKNOWN,) * len(found)
    depths = np.unique(field.points.depth).tolist()
    wide = stress_on_cells(on_wide_cells(state), indenter=indenter, depths=depths)
    body = state.indenter if indenter else state.body
    there = {(e.region, e.measure): e.value for e in extremes(wide.points, body)}
    x, y = state.axes["x"], state.axes["y"]
    near = NEAR * sqrt((x[1] - x[0]) * (y[1] - y[0]))
    return tuple(
        _error(e, there.get((e.region, e.measure)), near, state.by_increments or 0.0) for e in found
    )


def on_wide_cells(state: LoadedBodies) -> LoadedBodies:
    """The same forces on cells twice as wide, whose tractions are the means of four."""
    pads = {axis: len(state.axes[axis]) % 2 for axis in ("x", "y")}
    axes = {axis: _pairs(state.axes[axis], pads[axis]) for axis in ("x", "y")}
    return replace(
        state,
        axes=axes,
        tractions={name: _means(field, *pads.values()) for name, field in state.tractions.items()},
    )


def _pairs(centres: Field, pad: int) -> Field:
    """Centres of pairs of cells; an odd one gets a partner behind it."""
    h = centres[1] - centres[0]
    return np.asarray(centres[::2] + h / 2 if pad else (centres[::2] + centres[1::2]) / 2)


def _means(field: Field, pad_x: int, pad_y: int) -> Field:
    lead = [(0, 0)] * (field.ndim - 2)
    even = np.pad(field, [*lead, (0, pad_x), (0, pad_y)])
    return np.asarray(
        (even[..., ::2, ::2] + even[..., 1::2, ::2] + even[..., ::2, 1::2] + even[..., 1::2, 1::2])
        / 4
    )


def _error(extreme: Extreme, wide: float | None, near: float, by_increments: float) -> StatedError:
    if wide is None:
        return estimate.UNKNOWN
    rule = TENSION if extreme.depth < near else INTERIOR
    change, largest = np.array([abs(extreme.value - wide)]), np.array([abs(extreme.value)])
    parts: dict[Part, Field] = {"cells": estimate.by_cells(rule, change, 2.0, np.zeros(1))}
    if by_increments:
        parts["increments"] = by_increments * largest
    apart = estimate.contradicts(change, largest, 0.0)
    return estimate.stated(parts, not (apart or extreme.at_window_edge))
