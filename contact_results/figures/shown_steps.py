"""Which loading steps a figure shows, and what it calls them."""

from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from contact_scene.engineering_units import engineering_unit, quantity
from semi_analytical import Increment

AT_MOST = 6
SAME = 1e-6  # relative to the largest value: what no eye tells apart in a figure

Field = Callable[[Increment], NDArray[np.float64]]
Step = TypeVar("Step")


def selected(steps: Sequence[Step]) -> list[Step]:
    """All steps if they are few, otherwise evenly spaced ones with the first and the last."""
    if len(steps) <= AT_MOST:
        return list(steps)
    positions = np.linspace(0, len(steps) - 1, AT_MOST).round().astype(int)
    return [steps[position] for position in positions]


def runs_of_equal(steps: Sequence[Increment], field: Field) -> list[list[Increment]]:
    """Neighbouring steps grouped while the field looks the same, e.g. pressure at constant load."""
    groups: list[list[Increment]] = []
    for step in steps:
        if groups and _looks_same(field(groups[-1][0]), field(step)):
            groups[-1].append(step)
        else:
            groups.append([step])
    return groups


def shear_of(step: Increment) -> NDArray[np.float64]:
    """The shear (2, nx, ny), zero where the scene calls for none."""
    return np.zeros((2, *step.pressure.shape)) if step.shear is None else step.shear


def sheared(steps: Sequence[Increment]) -> list[Increment]:
    """The steps that end with shear somewhere."""
    return [step for step in steps if np.any(shear_of(step))]


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


def _looks_same(one: NDArray[np.float64], other: NDArray[np.float64]) -> bool:
    largest = float(np.max(np.abs(one)))
    return bool(np.max(np.abs(one - other)) <= SAME * largest)
