"""Selection of load steps for a figure, with texts of loads and axes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from contact_scene.array_types import Field
from contact_scene.quantities.increment import SCALARS
from contact_scene.quantities.per_length import shown_name, shown_unit
from contact_scene.reading.engineering_units import (
    engineering_unit,
    quantity,
)

if TYPE_CHECKING:
    from contact_results.surface import Increment

AT_MOST = 6  # load steps in a figure
SAME = 1e-6  # invisible difference, relative to the largest value

Step = TypeVar("Step")


def select_steps(steps: Sequence[Step]) -> list[Step]:
    """Select at most AT_MOST evenly spaced load steps, including the first and the last.

    steps  items of any type, one per load step
    """
    if len(steps) <= AT_MOST:
        return list(steps)
    positions = np.linspace(0, len(steps) - 1, AT_MOST).round().astype(int)
    return [steps[position] for position in positions]


def scale_for_axis(
    name: str, values: Field, which: str = "", *, line: bool = False
) -> tuple[Field, str]:
    """Return the values of a scalar for the axis of a figure, and the label of this axis.

    The values are in a suitable unit, which the label names.

    name    name of the scalar
    values  values in the SI unit
    which   further text for the label
    line    True for a line contact, whose forces are per length
    """
    si = shown_unit(SCALARS[name].unit, line=line)
    unit = engineering_unit(float(np.max(np.abs(values))), si)
    words = shown_name(name, line=line).replace("_", " ")
    return values / unit.size, unit.labelled(f"{words} {which}".rstrip())


def step_title(step: Increment) -> str:
    """Return the number of a load step and the forces at its end, as the title of a map."""
    title = f"step {step.step}: W = {quantity(step.normal_force, 'N', 3)}"
    force = np.zeros(2) if step.tangential_force is None else np.asarray(step.tangential_force)
    largest = float(np.max(np.abs(force)))
    if largest == 0.0:
        return title
    unit = engineering_unit(largest, "N")
    x, y = np.round(force / unit.size, 3) + 0.0
    return f"{title}\nT = ({x:.4g}, {y:.4g}) {unit.name}"
