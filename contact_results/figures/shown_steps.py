"""Which loading steps a figure shows, and what it calls them and their values."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_results.natural_sizes import SI, Units
from contact_scene.engineering_units import engineering_unit, quantity
from contact_scene.increment import SCALARS

if TYPE_CHECKING:
    from contact_results.surface import Increment

AT_MOST = 6
SAME = 1e-6  # relative to the largest value: what no eye tells apart in a figure

Field = NDArray[np.float64]
Step = TypeVar("Step")


def selected(steps: Sequence[Step]) -> list[Step]:
    """All steps if they are few, otherwise evenly spaced ones with the first and the last."""
    if len(steps) <= AT_MOST:
        return list(steps)
    positions = np.linspace(0, len(steps) - 1, AT_MOST).round().astype(int)
    return [steps[position] for position in positions]


def runs_of_equal(
    steps: Sequence[Increment], field: Callable[[Increment], Field]
) -> list[list[Increment]]:
    """Neighbouring steps grouped while the field looks the same, e.g. pressure at constant load."""
    groups: list[list[Increment]] = []
    for step in steps:
        if groups and _looks_same(field(groups[-1][0]), field(step)):
            groups[-1].append(step)
        else:
            groups.append([step])
    return groups


class HasVectors(Protocol):
    """A surface, or rings seen from above."""

    def vector(self, increment: Increment, name: str) -> Field | None:
        """Components along x and y of shear or slip; None where an increment has none."""


def vectors(
    surface: HasVectors, steps: Sequence[Increment], name: str
) -> list[tuple[Increment, Field]]:
    """The steps that end with shear or slip somewhere, with its x and y components (2, …)."""
    found = ((step, surface.vector(step, name)) for step in steps)
    return [(step, vector) for step, vector in found if vector is not None and np.any(vector)]


def on_axis(name: str, values: Field, which: str = "", units: Units = SI) -> tuple[Field, str]:
    """The values of a scalar in a readable unit, and what an axis says of them."""
    unit = units.of(name, float(np.max(np.abs(values))), SCALARS[name].unit)
    return values / unit.size, unit.labelled(f"{name.replace('_', ' ')} {which}".rstrip())


def span(group: Sequence[Increment]) -> str:
    """`step 3` or `steps 1–4`."""
    first, last = group[0].step, group[-1].step
    return f"step {first}" if first == last else f"steps {first}–{last}"


def normal_load(step: Increment) -> str:
    """The normal force at the end of a step, as a title shows it."""
    return f"W = {_typeset(quantity(step.normal_force, 'N', 3))}"


def tangential_load(step: Increment) -> str:
    """The tangential force at the end of a step, as a title shows it."""
    x, y = (0.0, 0.0) if step.tangential_force is None else map(float, step.tangential_force)
    largest = max(abs(x), abs(y))
    if largest == 0.0:
        return "T = 0"
    if abs(y) <= SAME * largest:
        return f"$T_x$ = {_typeset(quantity(x, 'N', 3))}"
    if abs(x) <= SAME * largest:
        return f"$T_y$ = {_typeset(quantity(y, 'N', 3))}"
    unit = engineering_unit(largest, "N")
    return _typeset(f"T = ({x / unit.size:.3g}, {y / unit.size:.3g}) {unit.name}")


def _typeset(number: str) -> str:
    return number.replace("-", "−")


def _looks_same(one: Field, other: Field) -> bool:
    largest = float(np.nanmax(np.abs(one)))
    if not np.array_equal(np.isnan(one), np.isnan(other)):
        return False
    return bool(np.nanmax(np.abs(one - other)) <= SAME * largest)
