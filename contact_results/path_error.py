"""What finite increments cost in a result, from one with twice as many.

An error C/n is twice the change by doubling, and errors of higher order are less. The order may
still be a little below 1 where increments are large, so the estimate takes two and a half changes:
it covers every order from 0.74 on (the safety factor 1.25 of Roache 1998). Richardson's value for
first order is uncertain by one change.

The edge of the stick zone goes from cell to cell, and doubling may leave it in its cell: where the
path matters its error takes the largest change of the history and a quarter of a cell.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import hypot
from typing import TYPE_CHECKING

import numpy as np

from contact_results.quantities import named_values, unit_of
from contact_scene.friction import FRICTIONLESS
from contact_scene.path_error import DoubledQuantity, PathError

if TYPE_CHECKING:
    from contact_scene import Scene
    from semi_analytical import Increment, Result


CHANGES = 2.5
STICK_CHANGES = 2.0
OF_A_CELL = 0.25


def compared(result: Result, finer: Result) -> tuple[PathError, ...]:
    """Errors of a result next to one of the same scene and grid with twice the increments."""
    ends = list(zip(result.steps, finer.steps, strict=True))
    quantities = [_quantities(named_values(end), named_values(fine)) for end, fine in ends]
    quantities = _with_stick_edge(result, quantities)
    return tuple(
        PathError(
            step=end.step,
            increments=end.increments_in_step,
            doubled_increments=fine.increments_in_step,
            pressure=CHANGES * _pressure_difference(end, fine),
            shear=_shear_error(result.scene, end, fine),
            quantities=found,
        )
        for (end, fine), found in zip(ends, quantities, strict=True)
    )


def shear_difference(scene: Scene, one: Increment, other: Increment) -> float | None:
    """Σ|q - q_other| / Σµp of the other; None without shear or where nothing can slip [1]."""
    if one.shear is None or other.shear is None:
        return None
    limit = float(np.sum((scene.friction or FRICTIONLESS).limit(other.pressure)))
    difference = one.shear - other.shear
    return float(np.sum(np.hypot(*difference)) / limit) if limit > 0 else None


def _shear_error(scene: Scene, end: Increment, fine: Increment) -> float | None:
    change = shear_difference(scene, end, fine)
    return None if change is None else CHANGES * change


def _pressure_difference(end: Increment, fine: Increment) -> float:
    return float(np.sum(np.abs(fine.pressure - end.pressure)) / np.sum(end.pressure))


def _quantities(
    values: Mapping[str, float], finer: Mapping[str, float]
) -> tuple[DoubledQuantity, ...]:
    """What is defined in both results."""
    return tuple(
        _doubled(name, value, finer[name]) for name, value in values.items() if name in finer
    )


def _with_stick_edge(
    result: Result, quantities: Sequence[tuple[DoubledQuantity, ...]]
) -> list[tuple[DoubledQuantity, ...]]:
    """With the error that the radius of a stick zone has, step after step."""
    judged, largest, matters = [], 0.0, False
    for step, found in zip(result.plan.path, quantities, strict=True):
        matters = matters or step.path_matters
        of_step = []
        for quantity in found:
            if quantity.name == "stick_radius" and matters:
                largest = max(largest, quantity.uncertainty)
                error = STICK_CHANGES * hypot(largest, OF_A_CELL * max(result.grid.spacing))
                quantity = quantity.model_copy(update={"error": error})
            of_step.append(quantity)
        judged.append(tuple(of_step))
    return judged


def _doubled(name: str, value: float, finer: float) -> DoubledQuantity:
    change = finer - value
    return DoubledQuantity(
        name=name,
        unit=unit_of(name),
        value=value,
        error=CHANGES * abs(change),
        extrapolated=finer + change,
        uncertainty=abs(change),
    )
