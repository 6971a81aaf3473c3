"""The datasets of `result.h5`: names, units and meanings, and where their values come from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import numpy as np

Increment = TypeVar("Increment")


@dataclass(frozen=True)
class Dataset(Generic[Increment]):
    """A field or a scalar of all increments of a result.

    of  the value at one increment; None where the effect is off
    """

    name: str
    unit: str
    meaning: str
    of: Callable[[Increment], Any]


# Of the increments of either solver.
LOADS_AND_MOTIONS: tuple[Dataset[Any], ...] = (
    Dataset("step", "", "loading step, from 1", lambda i: i.step),
    Dataset("increment", "", "increment within the step, from 1", lambda i: i.index),
    Dataset("normal_force", "N", "of the indenter on the body", lambda i: i.normal_force),
    Dataset("approach", "m", "of the bodies since first touch", lambda i: i.approach),
    Dataset("tangential_force", "N", "(x, y), of the indenter", lambda i: i.tangential_force),
    Dataset("tangential_shift", "m", "(x, y), of the indenter", lambda i: i.tangential_shift),
    Dataset("torque", "N m", "about z, of the indenter", lambda i: i.torque),
    Dataset("twist", "rad", "about z, of the indenter", lambda i: i.twist),
)


def write_scalars(
    group: Any,
    quantities: Sequence[Dataset[Increment]],
    increments: Sequence[Increment],
) -> None:
    """Write a dataset of each, NaN where an increment has none; nothing where none has."""
    for quantity in quantities:
        values = [quantity.of(increment) for increment in increments]
        if any(value is not None for value in values):
            write_dataset(group, quantity.name, _numbers(values), quantity.unit, quantity.meaning)


def write_dataset(group: Any, name: str, values: Any, unit: str, meaning: str) -> None:
    """Write an array or a text with its unit and meaning next to it."""
    describe(group.create_dataset(name, data=values, track_times=False), unit, meaning)


def describe(dataset: Any, unit: str, meaning: str) -> None:
    """Put unit and meaning next to the numbers."""
    dataset.attrs["unit"] = unit
    dataset.attrs["description"] = meaning


def _numbers(values: list[Any]) -> Any:
    shape = np.shape(next(value for value in values if value is not None))
    return np.array([np.full(shape, np.nan) if value is None else value for value in values])
